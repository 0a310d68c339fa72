"""What `grainfront effort` promises, and what packings of the whole scenes then give."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from scenes import scene_and_shapes
from table import Spread, Table

from grainfront import api
from grainfront.laws import Constant, Law, Lognormal, Uniform
from grainfront.particles import Rectangle
from grainfront.scene import Scene
from grainfront.shapes.sources import (
    FourierGrains,
    RandomConvexPolygons,
    Rectangles,
    RegularPolygon,
    ShapeSource,
)
from grainfront.studies.effort import recommend

SEEDS = 5
# Seeds of the pilots count from 0.
FIRST_SEED = 1001
# Edge of a domain of some thousand grains.
QUICK_EDGE = 45.0


class Case(NamedTuple):
    """A scene and the volume fraction wanted, in the middle or upper part of what it can reach."""

    name: str
    target: float
    shapes: ShapeSource
    size: Law = Uniform(0.5, 2.0)
    width: float = 100.0
    height: float = 100.0
    orientation: Law = Uniform(0.0, 180.0)


WIDE = Lognormal(0.6, 0.8, minimum=0.15, maximum=5.0)
CASES = (
    Case("rectangles, λ = 1.5", 0.80, Rectangles((1.5, 1.5), 1)),
    Case("rectangles, λ = 4", 0.75, Rectangles((4.0, 4.0), 1), width=160.0, height=160.0),
    Case("squares", 0.82, RegularPolygon(4)),
    Case("triangles", 0.75, RegularPolygon(3)),
    Case("regular hexagons", 0.83, RegularPolygon(6)),
    Case("random convex polygons", 0.84, RandomConvexPolygons(vertices=12, count=200)),
    Case("Fourier grains", 0.83, FourierGrains(count=200, d2=0.15, d3=0.1)),
    Case("wide lognormal sizes", 0.84, Rectangles((1.0, 2.0), 21), WIDE),
    Case("one size", 0.80, Rectangles((1.5, 1.5), 1), Constant(1.2)),
    Case("orientations within 30°", 0.80, Rectangles((2.0, 2.0), 1), orientation=Uniform(75, 105)),
    Case("narrow, 15 × 500", 0.78, Rectangles((1.5, 1.5), 1), width=15.0, height=500.0),
)
# The photograph's outlines, which replace their hulls, without the scene's regions.
GRAVEL = "river_gravel", 0.80


def tables(quick: bool) -> list[Table]:
    """One table: a row a scene."""
    cases = [
        (case.name, _scene(case, quick), case.target) for case in CASES[: 1 if quick else None]
    ]
    if not quick:
        name, target = GRAVEL
        # pilots leave regions out
        cases.append((name, replace(scene_and_shapes(name)[0], arrangement=None), target))
    note = (
        "Each target is handed to `grainfront effort`, and the whole scene is then packed with the "
        "pair recommended, for several seeds: median (least–largest). Promised are the volume "
        "fraction ± two standard deviations, and the seconds of the kernel. Kept: packings whose "
        "volume fraction is as promised."
    )
    header = (
        "scene", "target", "n_angle", "n_loc", "φ promised", "φ", "kept", "grains",
        "s promised", "s", "ratio of s", "s of pilots",
    )  # fmt: skip
    seeds = range(FIRST_SEED, FIRST_SEED + (1 if quick else SEEDS))
    return [Table("Effort", note, header, [_row(*case, seeds) for case in cases])]


def _scene(case: Case, quick: bool) -> Scene:
    width, height = (QUICK_EDGE, QUICK_EDGE) if quick else (case.width, case.height)
    return replace(
        scene_and_shapes("oafm_rectangles")[0],
        name=case.name,
        domain=Rectangle(0.0, 0.0, width, height),
        shapes=case.shapes,
        matched=None,
        size=case.size,
        orientation=case.orientation,
    )


def _row(name: str, scene: Scene, target: float, seeds: Iterable[int]) -> tuple[str, ...]:
    database = api.build_shapes(scene)
    promised = recommend(scene, database, target)
    effort = replace(scene.packing, n_angle=promised.n_angle, n_loc=promised.n_loc)
    fractions, seconds, grains = [], [], []
    for seed in seeds:
        packing, run_time = api.pack(replace(scene, packing=effort), database, seed)
        seconds.append(run_time.kernel_s)
        grains.append(packing.x.size)
        if scene.replacement:
            packing = api.replace(packing, database)
        fractions.append(api.volume_fractions(packing)[0])
    kept = sum(abs(found - promised.volume_fraction) <= promised.spread for found in fractions)
    return (
        name,
        f"{target:g}",
        str(promised.n_angle),
        str(promised.n_loc),
        f"{promised.volume_fraction:.4f} ± {promised.spread:.4f}",
        Spread.of(fractions).text(".4f"),
        f"{kept} of {len(fractions)}",
        Spread.of(grains).text(",.0f"),
        f"{promised.kernel_s:.3g}",
        Spread.of(seconds).text(".3g"),
        f"{Spread.of(seconds).median / promised.kernel_s:.2f}",
        f"{promised.pilot_s:.1f}",
    )
