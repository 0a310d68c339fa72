"""What proofs, statistics and files cost beside shapes and packing."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import ParamSpec, TypeVar

import numpy as np

from grainfront import api
from grainfront.particles import Packing
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import find_contacts
from grainfront.studies.error_vs_time.record import AxisRecord
from grainfront.studies.error_vs_time.runs import without_target

P = ParamSpec("P")
T = TypeVar("T")


def measure_checks(
    scene: Scene, database: ShapeDatabase, seeds: Sequence[int], repeats: int
) -> AxisRecord:
    """Take the CPU time of every step from the scene to a certified packing and its files.

    Each step is run once beforehand, so that no compilation is counted. With replacement, the
    steps after it count the hulls and the outlines. The share of a step is that of the times added
    up, the shapes counted with each packing, although one scene needs them once. Of the repeats
    the median counts.
    """
    scene = without_target(scene)
    _steps(scene, database, seeds[0])
    runs = [[_steps(scene, database, seed) for seed in seeds] for _ in range(repeats)]
    names = list(runs[0][0])
    cpu_s = np.array([[[one[name] for one in row] for row in runs] for name in names])
    cpu_s = np.moveaxis(cpu_s, 1, 2)
    median = np.median(cpu_s, axis=2)
    return AxisRecord(
        settings={"step": np.array(names, dtype=object)},
        results={"share": median / median.sum(axis=0)},
        seconds={"cpu_s": cpu_s},
    )


@dataclass
class _Clock:
    """CPU seconds of this process, added up by step."""

    seconds: dict[str, float] = field(default_factory=dict)

    def __call__(self, step: str, work: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        start = time.process_time()
        done = work(*args, **kwargs)
        passed = time.process_time() - start
        self.seconds[step] = self.seconds.get(step, 0.0) + passed
        return done


def _steps(scene: Scene, database: ShapeDatabase, seed: int) -> dict[str, float]:
    """CPU seconds of every step of one packing."""
    clock = _Clock()
    clock("shapes", api.build_shapes, scene)
    packing, _ = clock("packing", api.pack, scene, database, seed)
    packings = [packing]
    if scene.replacement:
        packings.append(clock("replacement", api.replace, packing, database))
    for one in packings:
        clock("certificate", api.certify, one)
        clock("contacts", find_contacts, one)
        clock("statistics", api.measure, scene, database, one)
        clock("writing", _write, scene, one, seed)
    return clock.seconds


def _write(scene: Scene, packing: Packing, seed: int) -> None:
    with TemporaryDirectory() as folder:
        api.write_packing(Path(folder) / "packing.nc", packing, scene, seed)
