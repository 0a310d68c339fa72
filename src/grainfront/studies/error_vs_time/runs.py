"""Packings of several settings, each for several seeds, the time of each measured repeatedly."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from grainfront import api
from grainfront.particles import Packing, Rectangle
from grainfront.scene import PackingEffort, Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import volume_fraction


class Point(NamedTuple):
    """What one point of an axis packs."""

    scene: Scene
    database: ShapeDatabase


@dataclass(frozen=True)
class Runs:
    """Numbers found in the packings, each of shape (n_points, n_seeds), and their kernel seconds.

    `kernel_s` has the shape (n_points, n_seeds, n_repeats) and is CPU time of one core.
    """

    numbers: dict[str, np.ndarray]
    kernel_s: np.ndarray


def run(
    points: Sequence[Point],
    seeds: Sequence[int],
    repeats: int,
    observe: Callable[[Point, Packing], dict[str, float]],
) -> Runs:
    """Pack every point for every seed, and again for each repeat, whose times alone are kept.

    `observe` takes a packing's numbers. A repeat goes round all points, so that a machine that
    slows down for a while slows down all of them alike.
    """
    kernel_s = np.empty((len(points), len(seeds), repeats))
    rows: list[list[dict[str, float]]] = [[] for _ in points]
    for repeat in range(repeats):
        for i, point in enumerate(points):
            for j, seed in enumerate(seeds):
                packing, run_time = api.pack(point.scene, point.database, seed)
                kernel_s[i, j, repeat] = run_time.kernel_s
                if repeat == 0:
                    rows[i].append(observe(point, packing))
    names = rows[0][0]
    return Runs({n: np.array([[one[n] for one in row] for row in rows]) for n in names}, kernel_s)


def without_target(scene: Scene) -> Scene:
    """The scene packed at its own effort, without a target that would change it."""
    return replace(scene, target=None)


def with_effort(scene: Scene, n_angle: int, n_loc: int, n_bin: int | None = None) -> Scene:
    """The scene at another effort, and with other orientation bins if they are given."""
    n_bin = n_bin or scene.packing.n_bin
    return replace(without_target(scene), packing=PackingEffort(n_angle, n_loc, n_bin))


def delivered_fraction(point: Point, packing: Packing) -> float:
    """Volume fraction of the outlines, where the scene replaces hulls, or else of the hulls."""
    if point.scene.replacement:
        packing = api.replace(packing, point.database)
    return volume_fraction(packing)


def scaled_domain(domain: Rectangle, factor: float) -> Rectangle:
    """A domain of the same proportions from the same origin, its sides `factor` times as long."""
    return Rectangle(
        domain.x_min,
        domain.y_min,
        domain.x_min + factor * domain.width,
        domain.y_min + factor * domain.height,
    )
