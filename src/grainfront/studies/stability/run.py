"""One case at one effort: packed for all its seeds, certified, counted and compared."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from grainfront import api
from grainfront.errors import InputError
from grainfront.packing.pack import fill
from grainfront.packing.turns import N_FAILED
from grainfront.packing.under_way import State
from grainfront.particles import Packing
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import N_BIN, l2_error, volume_fraction
from grainfront.statistics.distributions import wrap_orientation
from grainfront.studies.stability.case import Case, Effort
from grainfront.studies.stability.rounding import contact_gaps, departure, lost_to_clearance
from grainfront.studies.stability.variants import mirrored, scaled

# Every scene is packed again with its lengths multiplied by this, a power of two.
POWER_OF_TWO = 2.0**30
# No packing of a case takes as long, on any machine; one that does is taken not to end.
MOST_SECONDS = 300.0
# Gaps are found of packings of so many particles at most: memory for the contacts of a million is
# nothing that every machine has.
MOST_FOR_GAPS = 200_000
GAP_QUANTILES = (0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0)


@dataclass(frozen=True)
class Found:
    """What was found in the packings of a case at one effort; arrays have shape (n_seeds,).

    `unaccounted` counts particles drawn from the supply that are neither placed nor left over, or
    more than once; `scaled_differently` the coordinates that are not the same bits after scaling by
    a power of two. `gaps`, (n_seeds, n_quantiles), are the contact gaps at GAP_QUANTILES, in
    clearances; NaN where there is no contact, or where they were not looked for.
    """

    refusal: str
    particles: np.ndarray
    drawn: np.ndarray
    left_over: np.ndarray
    failed: np.ndarray
    unaccounted: np.ndarray
    overlaps: np.ndarray
    across_wall: np.ndarray
    pairs_exact: np.ndarray
    scaled_differently: np.ndarray
    volume_fraction: np.ndarray
    volume_fraction_mirrored: np.ndarray
    size_l2_error: np.ndarray
    size_noise_level: np.ndarray
    orientation_l2_error: np.ndarray
    orientation_noise_level: np.ndarray
    kernel_s: np.ndarray
    departure: np.ndarray
    gaps: np.ndarray
    lost: np.ndarray


def run(case: Case, effort: Effort) -> Found:
    """Pack a case at one effort, for all its seeds."""
    scene, database = case.scene(effort), case.database()
    rows: list[dict[str, Any]] = []
    refusal = ""
    with ending(f"{case.name} ({effort[0]}/{effort[1]})"):
        try:
            rows = [_row(scene, database, seed) for seed in scene.seeds]
        except InputError as error:
            refusal = str(error)
    names = [name for name in Found.__dataclass_fields__ if name != "refusal"]
    return Found(refusal, **{name: np.array([row[name] for row in rows]) for name in names})


@contextmanager
def ending(name: str, seconds: float = MOST_SECONDS) -> Iterator[None]:
    """End the process with one sentence where the block takes longer than `seconds`.

    A thread does so, as kernels answer no signals.
    """

    def give_up() -> None:
        print(
            f"grainfront: stability: {name} must end, but has not after {seconds:g} s.",
            file=sys.stderr, flush=True,
        )  # fmt: skip
        os._exit(1)

    timer = threading.Timer(seconds, give_up)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def _row(scene: Scene, database: ShapeDatabase, seed: int) -> dict[str, Any]:
    """All that is found in one packing and its variants."""
    state, packing, kernel_s = _pack(scene, database, seed)
    _, larger, _ = _pack(scaled(scene, POWER_OF_TWO), database, seed)
    _, reflected, _ = _pack(*mirrored(scene, database), seed)
    certificate = api.certify(packing)
    few = packing.x.size <= MOST_FOR_GAPS
    gaps = contact_gaps(packing) if few else np.empty(0)
    edges, probabilities = scene.orientation.bins(N_BIN)
    turned = wrap_orientation(packing.orientation, edges)
    orientation_e2, orientation_noise = l2_error(turned, edges, probabilities)
    size_e2, size_noise = l2_error(packing.size, *scene.size.bins(N_BIN))
    return {
        "particles": packing.x.size,
        "drawn": int(state.queues.drawn[0]),
        "left_over": packing.left_over,
        "failed": int(state.counters[N_FAILED]),
        "unaccounted": unaccounted(state, packing.left_over),
        "overlaps": certificate.overlaps,
        "across_wall": certificate.across_wall,
        "pairs_exact": certificate.pairs_exact,
        "scaled_differently": _different(packing, larger),
        "volume_fraction": volume_fraction(packing),
        "volume_fraction_mirrored": volume_fraction(reflected),
        "size_l2_error": size_e2,
        "size_noise_level": size_noise,
        "orientation_l2_error": orientation_e2,
        "orientation_noise_level": orientation_noise,
        "kernel_s": kernel_s,
        "departure": departure(packing, database),
        "gaps": np.quantile(gaps if gaps.size else [np.nan], GAP_QUANTILES),
        "lost": lost_to_clearance(packing, database),
    }


def _pack(scene: Scene, database: ShapeDatabase, seed: int) -> tuple[State, Packing, float]:
    """As `api.pack`, with the state in which it ends, and its kernel seconds."""
    state = api.empty_packing(scene, database, seed)
    packing, run_time = fill(state, database.descriptors["aspect_ratio"])
    if packing.x.size == 0:
        api.pack(scene, database, seed)  # tells why
    return state, packing, run_time.kernel_s


def unaccounted(state: State, left_over: int) -> int:
    """Particles drawn that are neither placed once nor left over, or left over but not drawn."""
    drawn = int(state.queues.drawn[0])
    times = np.bincount(state.placed.source[: state.n_placed], minlength=drawn)
    miscounted = abs(left_over - int(np.sum(times[:drawn] == 0)))
    return int(np.sum(times > 1) + times[drawn:].sum() + miscounted)


def _different(packing: Packing, larger: Packing) -> int:
    """Coordinates of nodes that scaling by the power of two has changed by more than that."""
    here, there = packing.polygons.nodes * POWER_OF_TWO, larger.polygons.nodes
    if here.shape != there.shape:
        return max(here.size, there.size)
    return int(np.sum(here != there))
