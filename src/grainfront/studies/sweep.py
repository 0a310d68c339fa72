"""Packings of a scene at many efforts, whose fractions make a contour map (paper, Figs. 16, 18)."""

from __future__ import annotations

import dataclasses
import heapq
from collections.abc import Generator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

from grainfront import api
from grainfront.packing import search_of
from grainfront.scene import PackingEffort, Scene, Sweep

if TYPE_CHECKING:
    from grainfront.shapes.database import ShapeDatabase

# Seconds of one core, measured for rectangles (benchmarks/results.md); hulls of 30 nodes take up
# to four times as long. They decide how packings are grouped, never what comes out.
SECONDS_A_TRIAL = {"exhaustive": 0.2e-6, "pruned": 0.066e-6}
SECONDS_A_GRAIN = 1e-6
SECONDS_A_PACKING = 5e-3  # drawing and measuring a thousand grains
# ASSUME of the grains, before there is any: area of a hull over its size squared, and the volume
# fraction.
AREA_OF_HULL = 1.2
VOLUME_FRACTION = 0.8


class Point(NamedTuple):
    """One packing of a sweep."""

    n_angle: int
    n_loc: int
    seed: int


def sweep_of(scene: Scene) -> Sweep:
    """The sweep of a scene that is known to have one, its efforts in ascending order."""
    assert scene.sweep is not None, "no sweep is planned for scenes without"
    n_angle, n_loc = sorted(scene.sweep.n_angle), sorted(scene.sweep.n_loc)
    return dataclasses.replace(scene.sweep, n_angle=tuple(n_angle), n_loc=tuple(n_loc))


def seeds(scene: Scene) -> tuple[int, ...]:
    """The seeds of each pair of efforts: they count up from the scene's first."""
    return tuple(range(scene.seeds[0], scene.seeds[0] + sweep_of(scene).seeds))


def points(scene: Scene) -> list[Point]:
    """All packings of a sweep: every n_angle with every n_loc, and every seed for each pair."""
    sweep = sweep_of(scene)
    return [Point(*point) for point in product(sweep.n_angle, sweep.n_loc, seeds(scene))]


def searches(scene: Scene) -> list[str]:
    """The searches that the pairs of a sweep need, each with kernels of its own."""
    sweep = sweep_of(scene)
    pairs = product(sweep.n_angle, sweep.n_loc)
    return sorted({s for pair in pairs for s in api.searches(_with_effort(scene, *pair))})


def _with_effort(scene: Scene, n_angle: int, n_loc: int) -> Scene:
    """The scene at a pair of efforts, its target left out of account."""
    effort = PackingEffort(n_angle, n_loc, scene.packing.n_bin)
    return dataclasses.replace(scene, packing=effort, target=None)


def estimated_seconds(scene: Scene, point: Point) -> float:
    """How long a packing of the sweep is likely to take on one core."""
    grains = VOLUME_FRACTION * scene.domain.area / (AREA_OF_HULL * scene.size.moment(2))
    front = scene.domain.width / scene.size.moment(1)
    trials = point.n_angle * min(2 * point.n_loc - 1, front)
    trial = SECONDS_A_TRIAL[search_of(point.n_angle, point.n_loc)]
    return SECONDS_A_PACKING + grains * (SECONDS_A_GRAIN + trial * trials)


def chunk_count(scene: Scene, core_seconds: float) -> int:
    """How many chunks a sweep makes if each is to take so many seconds of one core, or more."""
    seconds = [estimated_seconds(scene, point) for point in points(scene)]
    return min(max(int(sum(seconds) / core_seconds), 1), len(seconds))


def chunks(scene: Scene, count: int) -> list[list[Point]]:
    """The packings of a sweep in `count` chunks of about equal estimated cost.

    The longest packings are dealt out first, each to the chunk that has least so far (Graham 1969,
    doi 10.1137/0117039), and come first in their chunk, so that threads end together.
    """
    parts: list[list[Point]] = [[] for _ in range(count)]
    filled = [(0.0, part) for part in range(count)]
    cost = {point: estimated_seconds(scene, point) for point in points(scene)}
    for point in sorted(cost, key=lambda point: -cost[point]):
        seconds, part = heapq.heappop(filled)
        parts[part].append(point)
        heapq.heappush(filled, (seconds + cost[point], part))
    return parts


def pack_points(
    scene: Scene, database: ShapeDatabase, wanted: Sequence[Point], threads: int
) -> Generator[tuple[Point, dict[str, float]], None, None]:
    """Pack and measure points of a sweep, several at a time; each comes as soon as it is there.

    What comes with a point are the numbers that `measure_point` gives.
    """
    executor = ThreadPoolExecutor(threads)  # kernels run side by side in threads
    try:
        jobs = {executor.submit(measure_point, scene, database, each): each for each in wanted}
        for job in as_completed(jobs):
            yield jobs[job], job.result()
    finally:
        executor.shutdown(cancel_futures=True)


def measure_point(scene: Scene, database: ShapeDatabase, point: Point) -> dict[str, float]:
    """Pack one point of a sweep and measure it: a number each, under the names of contour.nc.

    Beside them `kernel_s`, the seconds of one core spent packing. A prescribed volume fraction is
    left out of account: the map shows what the efforts give. Raises InputError as `api.pack` does.
    """
    at_point = _with_effort(scene, point.n_angle, point.n_loc)
    packing, run_time = api.pack(at_point, database, point.seed)
    measured = api.measure(at_point, database, packing)
    numbers: dict[str, float] = {
        "volume_fraction": measured.volume_fraction,
        "volume_fraction_bulk": measured.volume_fraction_bulk,
        "coordination_number": measured.coordination_number,
        "particles": measured.particles,
        "left_over": measured.left_over,
        "kernel_s": run_time.kernel_s,
    }
    if scene.replacement:
        numbers["volume_fraction_outlines"] = api.volume_fraction_of_outlines(packing, database)
    for law, placed in measured.distributions.items():
        numbers[f"{law}_l2_error"] = placed.l2_error
        numbers[f"{law}_noise_level"] = placed.noise_level
    return numbers
