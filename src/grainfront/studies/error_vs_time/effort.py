"""Volume fraction against effort: plain advancing front, boundary, orientation, both."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from grainfront.particles import Packing
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import volume_fraction
from grainfront.studies.error_vs_time.record import AxisRecord, over_points, pareto_front
from grainfront.studies.error_vs_time.runs import Point, run, with_effort

# Shares of the scene's own effort, up to twice as much, where φ still rises.
LEVELS = (1 / 8, 1 / 4, 1 / 2, 1, 2)


def measure_effort(
    scene: Scene, database: ShapeDatabase, seeds: Sequence[int], repeats: int
) -> AxisRecord:
    """Pack at all pairs of `n_angle` and `n_loc` from 1 to twice the scene's own.

    Their families are those of Du et al. (2023), Fig. 15: plain advancing front (both 1), boundary
    only (n_angle = 1), orientation only (n_loc = 1), both. The error is the deficit of the volume
    fraction of the hulls to the largest median of all pairs.
    """
    effort = scene.packing
    pairs = [(a, b) for a in _levels(effort.n_angle) for b in _levels(effort.n_loc)]
    found = run(
        [Point(with_effort(scene, *pair), database) for pair in pairs], seeds, repeats, _observe
    )
    fraction = found.numbers["volume_fraction"]
    deficit = over_points(fraction).max() - fraction
    n_angle, n_loc = np.array(pairs, dtype=np.int64).T
    return AxisRecord(
        settings={"n_angle": n_angle, "n_loc": n_loc},
        results=found.numbers | {"deficit": deficit},
        seconds={"kernel_s": found.kernel_s},
        pareto=pareto_front(found.kernel_s, deficit),
    )


def _levels(own: int) -> list[int]:
    return sorted({1, *(max(1, round(own * level)) for level in LEVELS)})


def _observe(_: Point, packing: Packing) -> dict[str, float]:
    return {"particles": packing.x.size, "volume_fraction": volume_fraction(packing)}
