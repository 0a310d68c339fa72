"""Errors against the run time they cost, in the sense of work-precision diagrams, for any scene.

Each axis is a module with one function from a scene to an `AxisRecord`. Errors repeat bit for bit;
times are CPU seconds of one core, and do not.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.studies.error_vs_time.checks import measure_checks
from grainfront.studies.error_vs_time.domain import measure_domain
from grainfront.studies.error_vs_time.drawing import measure_drawing
from grainfront.studies.error_vs_time.effort import measure_effort
from grainfront.studies.error_vs_time.outlines import measure_outlines
from grainfront.studies.error_vs_time.record import AxisRecord
from grainfront.studies.error_vs_time.target import measure_target

AXES: dict[str, Callable[[Scene, ShapeDatabase, Sequence[int], int], AxisRecord]] = {
    "effort": measure_effort,
    "outlines": measure_outlines,
    "drawing": measure_drawing,
    "domain": measure_domain,
    "target": measure_target,
    "checks": measure_checks,
}


def measure_axes(scene: Scene, database: ShapeDatabase) -> tuple[list[int], dict[str, AxisRecord]]:
    """Seeds, counting up from the scene's first, and the record of each axis that the scene lists.

    Raises InputError where a packing of the scene is impossible.
    """
    asked = scene.error_vs_time
    assert asked is not None, "no study is planned for scenes that list no axes"
    seeds = [scene.seeds[0] + i for i in range(asked.seeds)]
    return seeds, {axis: AXES[axis](scene, database, seeds, asked.repeats) for axis in asked.axes}
