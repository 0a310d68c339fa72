"""L2 errors of the laws against the way of drawing, and against the orientation bins."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

import numpy as np

from grainfront.draw import closest_shapes
from grainfront.laws import Law, stratified
from grainfront.particles import Packing
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import N_BIN, l2_error
from grainfront.statistics.distributions import wrap_orientation
from grainfront.studies.error_vs_time.record import Arrays, AxisRecord, pareto_front
from grainfront.studies.error_vs_time.runs import Point, run, with_effort

# Bins whose deficits steer: coarser than those of the measure, as fine, and finer.
BINS = (6, 12, N_BIN, 2 * N_BIN, 4 * N_BIN)
LAWS = ("size", "descriptor", "orientation")
Draw = Callable[[Law, int, np.random.Generator], np.ndarray]


def measure_drawing(
    scene: Scene, database: ShapeDatabase, seeds: Sequence[int], repeats: int
) -> AxisRecord:
    """Draw sizes, descriptors and orientations in several ways, and pack with several bins.

    Values drawn alone, as many as the packing of each seed places: independent, stratified, and
    controlled by the deficits of `n_bin` bins (0: no bins). Packings, of the scene's own `n_angle`
    and of 1: their orientations are controlled by the deficits of `n_bin` bins (Du et al. 2023,
    Pseudocode 9), where 1 bin controls nothing. Errors are E2 in N_BIN bins, and NaN without a law
    of a descriptor; `cpu_s` is the time of the drawing, or of the kernel.
    """
    packed = _packings(scene, database, seeds, repeats)
    particles = packed.results["particles"]
    drawn = _drawings(scene, database, particles[0], seeds, repeats)
    settings = _joined(drawn.settings, packed.settings)
    results = _joined(drawn.results, packed.results)
    cpu_s = _joined(drawn.seconds, packed.seconds)["cpu_s"]
    return AxisRecord(settings, results, {"cpu_s": cpu_s}, _fronts(settings, results, cpu_s))


def independent(law: Law, n: int, rng: np.random.Generator) -> np.ndarray:
    """Draw `n` values of `law`, (n,), each without regard to the others."""
    return law.quantile(rng.random(n))


def deficit_controlled(law: Law, n: int, rng: np.random.Generator, n_bin: int) -> np.ndarray:
    """Draw `n` values of `law`, (n,), each in a bin that still lacks some (Pseudocode 9).

    The bin is drawn by what each of `n_bin` equal bins of the support lacks once one more value is
    there; the value within it follows the law.
    """
    edges, probability = law.bins(n_bin)
    probability = probability / probability.sum()
    cumulative = np.concatenate([[0.0], np.cumsum(probability)])
    drawn = np.zeros(probability.size)
    u = np.empty(n)
    for i, (choice, within) in enumerate(rng.random((n, 2))):
        lacking = np.cumsum(np.maximum(probability * (i + 1) - drawn, 0.0))
        chosen = int(np.searchsorted(lacking, choice * lacking[-1], side="right"))
        drawn[chosen] += 1.0
        u[i] = cumulative[chosen] + within * probability[chosen]
    low, high = law.cdf(edges[[0, -1]]) if edges[0] < edges[-1] else (0.0, 1.0)
    return law.quantile(low + u * (high - low))


def _drawings(
    scene: Scene, database: ShapeDatabase, numbers: np.ndarray, seeds: Sequence[int], repeats: int
) -> AxisRecord:
    ways: list[tuple[str, int, Draw]] = [
        ("independent", 0, independent),
        ("stratified", 0, stratified),
    ]
    for n_bin in BINS:
        ways.append(("deficit-controlled", n_bin, _with_bins(n_bin)))
    errors = {f"{name}_l2_error": np.empty((len(ways), len(seeds))) for name in LAWS}
    cpu_s = np.empty((len(ways), len(seeds), repeats))
    for repeat in range(repeats):
        for i, (_, _, draw) in enumerate(ways):
            for j, seed in enumerate(seeds):
                start = time.process_time()
                values = _draw_all(scene, database, draw, int(numbers[j]), seed)
                cpu_s[i, j, repeat] = time.process_time() - start
                for name, error in _l2_errors(scene, *values).items():
                    errors[name][i, j] = error
    return AxisRecord(
        settings={
            "method": np.array([method for method, _, _ in ways], dtype=object),
            "n_bin": np.array([n_bin for _, n_bin, _ in ways], dtype=np.int64),
            "n_angle": np.zeros(len(ways), dtype=np.int64),
        },
        results=errors | {"particles": np.tile(numbers, (len(ways), 1))},
        seconds={"cpu_s": cpu_s},
    )


def _packings(
    scene: Scene, database: ShapeDatabase, seeds: Sequence[int], repeats: int
) -> AxisRecord:
    settings = [(n_bin, a) for a in sorted({1, scene.packing.n_angle}) for n_bin in (1, *BINS)]

    def observe(_: Point, packing: Packing) -> dict[str, float]:
        descriptor = None
        if scene.matched is not None:
            descriptor = database.descriptors[scene.matched[0]][packing.shape]
        errors = _l2_errors(scene, packing.size, descriptor, packing.orientation)
        return errors | {"particles": packing.x.size}

    points = [
        Point(with_effort(scene, a, scene.packing.n_loc, n_bin), database) for n_bin, a in settings
    ]
    found = run(points, seeds, repeats, observe)
    n_bin, n_angle = np.array(settings, dtype=np.int64).T
    return AxisRecord(
        settings={
            "method": np.full(len(settings), "packing", dtype=object),
            "n_bin": n_bin,
            "n_angle": n_angle,
        },
        results=found.numbers,
        seconds={"cpu_s": found.kernel_s},
    )


def _with_bins(n_bin: int) -> Draw:
    return lambda law, n, rng: deficit_controlled(law, n, rng, n_bin)


def _draw_all(
    scene: Scene, database: ShapeDatabase, draw: Draw, n: int, seed: int
) -> tuple[np.ndarray, np.ndarray | None, np.ndarray]:
    """Sizes, values of the descriptor of the shapes chosen, and orientations, each (n,)."""
    rng = np.random.default_rng(seed)
    size = draw(scene.size, n, rng)
    descriptor = None
    if scene.matched is not None:
        name, law = scene.matched
        found = database.descriptors[name]
        edges, _ = law.bins(N_BIN)
        descriptor = found[closest_shapes(found, draw(law, n, rng), edges, rng)]
    return size, descriptor, draw(scene.orientation, n, rng)


def _l2_errors(
    scene: Scene, size: np.ndarray, descriptor: np.ndarray | None, orientation: np.ndarray
) -> dict[str, float]:
    """E2 of the three laws, in N_BIN bins; NaN without a law of a descriptor."""
    edges, probability = scene.orientation.bins(N_BIN)
    of_descriptor = float("nan")
    if scene.matched is not None and descriptor is not None:
        of_descriptor = l2_error(descriptor, *scene.matched[1].bins(N_BIN))[0]
    return {
        "size_l2_error": l2_error(size, *scene.size.bins(N_BIN))[0],
        "descriptor_l2_error": of_descriptor,
        "orientation_l2_error": l2_error(wrap_orientation(orientation, edges), edges, probability)[
            0
        ],
    }


def _joined(first: Arrays, second: Arrays) -> Arrays:
    """The points of two axes of the same quantities."""
    return {name: np.concatenate([first[name], second[name]]) for name in first}


def _fronts(settings: Arrays, results: Arrays, cpu_s: np.ndarray) -> np.ndarray:
    """The Pareto fronts of values drawn alone, by their largest error, and of packings.

    Bins cost nothing that could be measured, so points that differ by bins alone share the median
    of their times.
    """
    packed = settings["method"] == "packing"
    time = np.empty(packed.size)
    for i, (method, n_angle) in enumerate(
        zip(settings["method"], settings["n_angle"], strict=True)
    ):
        alike = (settings["method"] == method) & (settings["n_angle"] == n_angle)
        time[i] = np.median(cpu_s[alike])
    largest = np.nanmax([results[f"{law}_l2_error"] for law in LAWS], axis=0)
    error = np.where(packed[:, None], results["orientation_l2_error"], largest)
    pareto = np.zeros(packed.size, dtype=np.int64)
    for group in (packed, ~packed):
        pareto[group] = pareto_front(time[group], error[group])
    return pareto
