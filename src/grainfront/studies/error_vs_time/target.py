"""Packings and time that it takes to reach a volume fraction, against the tolerance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from grainfront import api
from grainfront.scene import Scene, Target
from grainfront.shapes.database import ShapeDatabase
from grainfront.studies.error_vs_time.record import AxisRecord, pareto_front
from grainfront.studies.error_vs_time.runs import (
    Point,
    delivered_fraction,
    with_effort,
    without_target,
)

# The default of a scene, 0.001, is among them.
TOLERANCES = (0.01, 0.003, 0.001, 0.0003)


def measure_target(
    scene: Scene, database: ShapeDatabase, seeds: Sequence[int], repeats: int
) -> AxisRecord:
    """Pack to one volume fraction with ever finer tolerances.

    The fraction is the scene's target or, without one, half way between what the plain advancing
    front and the scene's own effort reach. Tolerances finer than the share of a mean grain in the
    domain are left out, as meeting them is luck. Raises InputError where a target is not reached.
    """
    prescribed, grain = _half_way(scene, database, seeds[0])
    if scene.target is not None:
        prescribed = scene.target.volume_fraction
    tolerances = [t for t in TOLERANCES if t >= grain] or [TOLERANCES[0]]
    shape = (len(tolerances), len(seeds))
    fraction, packings, particles = np.empty(shape), np.empty(shape), np.empty(shape, np.int64)
    kernel_s = np.empty((*shape, repeats))
    for repeat in range(repeats):
        for i, tolerance in enumerate(tolerances):
            aimed = replace(scene, target=Target(prescribed, tolerance))
            for j, seed in enumerate(seeds):
                packing, run_time, attempts = api.pack_to_target(aimed, database, seed)
                kernel_s[i, j, repeat] = run_time.kernel_s
                fraction[i, j] = delivered_fraction(Point(aimed, database), packing)
                packings[i, j], particles[i, j] = attempts.packings, packing.x.size
    deviation = np.abs(fraction - prescribed)
    return AxisRecord(
        settings={
            "tolerance": np.array(tolerances),
            "prescribed": np.full(len(tolerances), prescribed),
        },
        results={
            "particles": particles,
            "packings": packings,
            "volume_fraction": fraction,
            "deviation": deviation,
        },
        seconds={"kernel_s": kernel_s},
        pareto=pareto_front(kernel_s, deviation),
    )


def _half_way(scene: Scene, database: ShapeDatabase, seed: int) -> tuple[float, float]:
    """The fraction between the ends of the effort, to three digits, and a mean grain's share."""
    ends = [with_effort(scene, 1, 1), without_target(scene)]
    packings = [api.pack(end, database, seed)[0] for end in ends]
    fractions = [delivered_fraction(Point(scene, database), packing) for packing in packings]
    return round(float(np.mean(fractions)), 3), fractions[-1] / packings[-1].x.size
