"""Packing hulls into a domain until it is full."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from grainfront.geometry.rings import polygon_areas
from grainfront.jit import compiling
from grainfront.packing import search_of
from grainfront.packing.fronts import advance_to
from grainfront.packing.prepare import as_packing
from grainfront.packing.under_way import State
from grainfront.particles import Packing

# Particles are placed in this many calls of the kernel or more, between which progress is told.
CALLS = 100


@dataclass(frozen=True)
class RunTime:
    """Seconds of one core spent packing; seconds compiling before that, or reading the cache."""

    kernel_s: float
    compile_s: float


def fill(
    empty: State,
    aspect_ratio: np.ndarray,
    progress: Callable[[int, float], None] | None = None,
) -> tuple[Packing, RunTime]:
    """Pack the particles of an empty packing by the advancing front until its domain is full.

    `aspect_ratio`, (n_shapes,), is that of the hulls; `progress` is told the particles placed and
    the volume fraction so far. With n_angle = n_loc = 1 this is the plain advancing front method,
    with more the optimised one. Source: Du et al. (2023), sections 3 and 4.
    """
    arranged = "" if empty.arrangement is None else "arranged "
    among = "" if empty.domain.obstacles is None else " among obstacles"
    search = search_of(empty.n_angle, empty.n_loc)
    with compiling(f"{arranged}{search} search{among}") as compilation:
        advance_to(empty, 0)
    kernel_s = run(empty, empty.supply.size.size, progress)
    return as_packing(empty, aspect_ratio), RunTime(kernel_s, compilation.seconds)


def run(state: State, limit: int, progress: Callable[[int, float], None] | None = None) -> float:
    """Place particles until there are `limit` or the domain is full; the seconds it took."""
    hull_area = polygon_areas(state.supply.hull_nodes, state.supply.hull_offsets)
    area, seconds = 0.0, 0.0
    # with nothing to do between, one call: between calls threads wait for one another
    step = limit if progress is None and state.keeper is None else max(limit // CALLS, 1)
    while state.n_placed < limit and not state.finished:
        first = state.n_placed
        start = time.thread_time()
        advance_to(state, min(first + step, limit))
        seconds += time.thread_time() - start
        if progress is not None:
            new = state.placed.source[first : state.n_placed]
            area += np.sum(hull_area[state.supply.shape[new]] * state.supply.size[new] ** 2)
            progress(state.n_placed, area / state.domain_area)
    return seconds
