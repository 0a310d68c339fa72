"""Contact, overlap and tangent: nanoseconds a call."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from numba import njit
from table import Spread, Table

from grainfront.geometry.contact import contact_with_polygons
from grainfront.geometry.overlap import overlapping
from grainfront.geometry.tangent import common_tangent

EDGES = (4, 30, 100)
# So many different pairs that the processor cannot learn them by heart, so few that they stay in
# its cache, as a local front does.
PAIRS = 200


@njit
def find_tangents(nodes, centres, n, tangents):
    for k in range(tangents.shape[0]):
        a, b = 2 * k, 2 * k + 1
        tangents[k] = common_tangent(
            nodes, a * n, n, centres[a, 0], centres[a, 1],
            b * n, n, centres[b, 0], centres[b, 1],
        )  # fmt: skip


@njit
def find_contacts(nodes, n, tangents, trials, places):
    found = 0
    for k in range(tangents.shape[0]):
        contact = contact_with_polygons(
            nodes, 2 * k * n, n, tangents[k, 0], (2 * k + 1) * n, n, tangents[k, 1],
            trials, k * n, n,
        )  # fmt: skip
        found += contact[0]
        places[k, 0] = contact[1]
        places[k, 1] = contact[2]
    return found


@njit
def count_overlaps(nodes, centres, n, trials, places):
    overlaps = 0
    for k in range(places.shape[0]):
        overlaps += overlapping(
            nodes, 2 * k * n, n, centres[2 * k, 0], centres[2 * k, 1],
            trials, k * n, n, places[k, 0], places[k, 1], 0.0,
        )  # fmt: skip
    return overlaps


def tables(quick: bool) -> list[Table]:
    """One table: a row a kernel, a column a number of edges."""
    columns = [_times(n, rounds=2 if quick else 500, repeats=3 if quick else 15) for n in EDGES]
    rows = [(kernel, *(column[kernel].text(".1f") for column in columns)) for kernel in columns[0]]
    note = (
        "Nanoseconds a call, median (least–largest). All three polygons have so many edges; "
        "contact starts from the tangent, which is found once a pair; about half of the overlap "
        "tests find one."
    )
    return [Table("Kernels", note, ("kernel", *(f"{n} edges" for n in EDGES)), rows)]


def _times(n: int, rounds: int, repeats: int) -> dict[str, Spread]:
    rng = np.random.default_rng(n)
    nodes, centres, trials = _neighbours(n, rng)
    tangents = np.empty((PAIRS, 2), dtype=np.int64)
    places = np.empty((PAIRS, 2))
    find_tangents(nodes, centres, n, tangents)
    if find_contacts(nodes, n, tangents, trials, places) != PAIRS:
        raise AssertionError("some pair has no contact: the timing would be of early exits")
    # towards A or away from it, by less than A's radius: near misses and near hits
    tried = places + rng.uniform(-0.2, 0.2, (PAIRS, 1)) * (places - centres[::2])
    return {
        "tangent": _per_call(lambda: find_tangents(nodes, centres, n, tangents), rounds, repeats),
        "contact": _per_call(
            lambda: find_contacts(nodes, n, tangents, trials, places), rounds, repeats
        ),
        "overlap": _per_call(
            lambda: count_overlaps(nodes, centres, n, trials, tried), rounds, repeats
        ),
    }


def _neighbours(n: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs of neighbours on a front, their centres, and the particles to come upon them."""
    polygons = _ellipses(3 * PAIRS, n, rng)
    centres = np.zeros((2 * PAIRS, 2))
    centres[1::2, 0] = rng.uniform(2.0, 2.1, PAIRS)
    centres[1::2, 1] = rng.uniform(-0.5, 0.5, PAIRS)
    nodes = polygons[: 2 * PAIRS] + centres[:, None]
    # twice as large, so that none falls through between its neighbours
    trials = 2.0 * polygons[2 * PAIRS :]
    return nodes.reshape(-1, 2), centres, trials.reshape(-1, 2)


def _ellipses(count: int, n: int, rng: np.random.Generator) -> np.ndarray:
    """Polygons inscribed in ellipses of aspect ratio 1.5, turned at random: (count, n, 2)."""
    spacing = (np.arange(n) + rng.uniform(-0.3, 0.3, (count, n))) * 2 * np.pi / n
    turn = rng.uniform(0, 2 * np.pi, (count, 1))
    x, y = np.cos(spacing), np.sin(spacing) / 1.5
    return np.stack(
        [x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)], axis=2
    )


def _per_call(run: Callable[[], object], rounds: int, repeats: int) -> Spread:
    run()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        for _ in range(rounds):
            run()
        times.append((time.perf_counter() - start) / (rounds * PAIRS) * 1e9)
    return Spread.of(times)
