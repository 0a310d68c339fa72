"""Prescribed volume fractions across what a scene reaches: how close, at what cost, how even."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scenes import SMALL, scene_and_shapes
from table import Spread, Table

from grainfront import api
from grainfront.laws import Constant
from grainfront.particles import Packing, Rectangle
from grainfront.scene import PackingEffort, Scene, Target
from grainfront.shapes.database import ShapeDatabase
from grainfront.shapes.sources import Rectangles
from grainfront.statistics import volume_fraction_between

TARGETS, TOLERANCE = 30, 0.001
# The ends of what is reached differ by seed; targets keep this far inside.
MARGIN = 0.003
# Untargeted packings for comparison, from the plain method to the scene's own effort.
STEPS, STEP_SEEDS = 6, 3
SLICES = 5
# A hundred grains are not to be had closer: one is a hundredth of them.
QUICK_TOLERANCE = 0.02
# As many long rectangles as there are short ones in the scene oafm_rectangles.
EDGE_OF_LONG = 330.0


class Even(NamedTuple):
    """How far the volume fractions of slices across x, and across y, lie apart."""

    x: float
    y: float


class Reached(NamedTuple):
    """One target and the packing that came of it."""

    difference: float
    packings: float
    finishes: int
    seconds: float
    l2_error: float
    even: Even
    volume_fraction: float


def tables(quick: bool) -> list[Table]:
    """One table: a row a scene."""
    note = (
        f"{TARGETS} volume fractions across all that each scene reaches, each with a seed of its "
        f"own; tolerance {TOLERANCE:g}. Packings: as many as would have taken as many placements. "
        "E2: the largest of size, aspect ratio and orientation. Slices: how far the volume "
        f"fractions of {SLICES} slices of the domain, across x and across y, lie apart; beyond "
        "untargeted packings of the same volume fraction. Cost: seconds of the kernel over those "
        "of one untargeted packing at the scene's own effort. Median (least–largest)."
    )
    header = (
        "scene", "grains", "φ reached", "within", "largest difference", "packings, mean",
        "packings", "finishes", "cost", "E2 %", "slices x", "beyond", "slices y", "beyond",
    )  # fmt: skip
    names = ("rectangles, λ = 1.5", "rectangles, λ = 4", "gravel hulls")
    return [
        Table("Targets", note, header, [_row(name, quick) for name in names[: 1 if quick else 3]])
    ]


def _scene(name: str, quick: bool) -> tuple[Scene, ShapeDatabase]:
    if name == "gravel hulls":
        scene, database = scene_and_shapes("river_gravel")
        return replace(scene, replacement=False), database
    scene, database = scene_and_shapes("oafm_rectangles", SMALL if quick else None)
    if name == "rectangles, λ = 1.5":
        return scene, database
    scene = replace(
        scene,
        domain=Rectangle(0.0, 0.0, EDGE_OF_LONG, EDGE_OF_LONG),
        shapes=Rectangles((4.0, 4.0), 1),
        matched=("aspect_ratio", Constant(4.0)),
    )
    return scene, api.build_shapes(scene)


def _row(name: str, quick: bool) -> tuple[str, ...]:
    scene, database = _scene(name, quick)
    fraction, x, y, seconds = _untargeted(scene, database, 1 if quick else STEP_SEEDS)
    tolerance = QUICK_TOLERANCE if quick else TOLERANCE
    low, high = fraction[0] + MARGIN, fraction[-1] - MARGIN
    targets = [0.5 * (low + high)] if quick else np.linspace(low, high, TARGETS)
    found = [
        _reach(replace(scene, target=Target(float(target), tolerance)), database, seed)
        for seed, target in enumerate(targets, start=1)
    ]
    grains = [scene.domain.area * f.volume_fraction for f in found]
    beyond_x = max(f.even.x - np.interp(f.volume_fraction, fraction, x) for f in found)
    beyond_y = max(f.even.y - np.interp(f.volume_fraction, fraction, y) for f in found)
    mean_area = float(database.descriptors["hull_area"].mean()) * scene.size.moment(2)
    return (
        name,
        Spread.of(g / mean_area for g in grains).text(",.0f"),
        f"{fraction[0]:.3f}–{fraction[-1]:.3f}",
        f"{sum(abs(f.difference) <= tolerance for f in found)} of {len(found)}",
        f"{max(abs(f.difference) for f in found):.5f}",
        f"{np.mean([f.packings for f in found]):.2f}",
        Spread.of(f.packings for f in found).text(".2f"),
        Spread.of(f.finishes for f in found).text(".0f"),
        Spread.of(f.seconds / seconds for f in found).text(".2g"),
        Spread.of(100 * f.l2_error for f in found).text(".2g"),
        Spread.of(f.even.x for f in found).text(".3f"),
        f"{beyond_x:.3f}",
        Spread.of(f.even.y for f in found).text(".3f"),
        f"{beyond_y:.3f}",
    )


def _reach(scene: Scene, database: ShapeDatabase, seed: int) -> Reached:
    assert scene.target is not None
    packing, run_time, attempts = api.pack_to_target(scene, database, seed)
    measured = api.measure(scene, database, packing)
    return Reached(
        measured.volume_fraction - scene.target.volume_fraction,
        attempts.packings,
        len(attempts.finishes),
        run_time.kernel_s,
        max(law.l2_error for law in measured.distributions.values()),
        evenness(packing),
        measured.volume_fraction,
    )


def _untargeted(
    scene: Scene, database: ShapeDatabase, seeds: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Volume fraction and evenness along the efforts, means over seeds; seconds of the last."""
    rows = []
    for effort in np.linspace(0.0, 1.0, STEPS):
        pair = (round(n**effort) for n in (scene.packing.n_angle, scene.packing.n_loc))
        at_effort = replace(scene, packing=PackingEffort(*pair, scene.packing.n_bin))
        for seed in range(seeds):
            packing, run_time = api.pack(at_effort, database, seed)
            fraction = float(packing.area.sum() / packing.domain.area)
            rows.append((fraction, *evenness(packing), run_time.kernel_s))
    means = np.array(rows).reshape(STEPS, seeds, 4).mean(axis=1)
    return means[:, 0], means[:, 1], means[:, 2], float(means[-1, 3])


def evenness(packing: Packing) -> Even:
    """How far the volume fractions of SLICES slices across each axis lie apart."""
    domain = packing.domain
    apart = []
    for axis, (low, high) in enumerate(
        ((domain.x_min, domain.x_max), (domain.y_min, domain.y_max))
    ):
        edges = np.linspace(low, high, SLICES + 1)
        slices = [volume_fraction_between(packing, axis, a, b) for a, b in pairwise(edges)]
        apart.append(float(np.ptp(slices)))
    return Even(*apart)
