"""Packing hulls into a domain until it is full."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from grainfront.geometry.rings import polygon_areas
from grainfront.jit import compiling
from grainfront.packing import search_of
from grainfront.packing.prepare import State, as_packing, prepare
from grainfront.packing.state import OrientationLaw
from grainfront.particles import Packing, Rectangle
from grainfront.polygons import Polygons

# Particles are placed in this many calls of the kernel or more, between which progress is told.
CALLS = 100


@dataclass(frozen=True)
class RunTime:
    """Seconds of one core spent packing; seconds compiling before that, or reading the cache."""

    kernel_s: float
    compile_s: float


def pack_hulls(
    hulls: Polygons,
    aspect_ratio: np.ndarray,
    shape: np.ndarray,
    size: np.ndarray,
    orientation: OrientationLaw,
    domain: Rectangle,
    *,
    n_angle: int,
    n_loc: int,
    rng: np.random.Generator,
    progress: Callable[[int, float], None] | None = None,
) -> tuple[Packing, RunTime]:
    """Pack particles by the optimised advancing front method until the domain is full.

    `hulls` are standardised (centroid at the origin, S = 1, orientation 0), `aspect_ratio`,
    (n_shapes,), is theirs. Particle i is a copy of `hulls.polygon(shape[i])` scaled by `size[i]`.
    Particles are taken in this order, so `shape` and `size`, (n,), must hold enough to fill the
    domain, a rectangle or a region of any shape. `progress` is told the particles placed and the
    volume fraction so far. With n_angle = n_loc = 1 this is the plain advancing front method.
    Source: Du et al. (2023), sections 3 and 4.
    """
    empty = prepare(hulls, shape, size, orientation, domain, n_angle, n_loc, rng)
    return fill(empty, aspect_ratio, progress)


def fill(
    empty: State,
    aspect_ratio: np.ndarray,
    progress: Callable[[int, float], None] | None = None,
) -> tuple[Packing, RunTime]:
    """Pack the particles of an empty packing until its domain is full; see `pack_hulls`."""
    among = "" if empty.domain.obstacles is None else " among obstacles"
    with compiling(f"{search_of(empty.n_angle, empty.n_loc)} search{among}") as compilation:
        empty.advance_to(0)
    kernel_s = run(empty, empty.supply.size.size, progress)
    return as_packing(empty, aspect_ratio), RunTime(kernel_s, compilation.seconds)


def run(state: State, limit: int, progress: Callable[[int, float], None] | None = None) -> float:
    """Place particles until there are `limit` or the domain is full; the seconds it took."""
    hull_area = polygon_areas(state.supply.hull_nodes, state.supply.hull_offsets)
    area, seconds = 0.0, 0.0
    # without progress to tell, one call: between calls threads wait for one another
    step = limit if progress is None else max(limit // CALLS, 1)
    while state.n_placed < limit and not state.finished:
        first = state.n_placed
        start = time.thread_time()
        state.advance_to(min(first + step, limit))
        seconds += time.thread_time() - start
        if progress is not None:
            new = state.placed.source[first : state.n_placed]
            area += np.sum(hull_area[state.supply.shape[new]] * state.supply.size[new] ** 2)
            progress(state.n_placed, area / state.domain_area)
    return seconds
