"""Packing hulls into a rectangle: prepares the arrays, runs the kernel, hands back a Packing."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from grainfront.geometry.placing import radii_about_origin
from grainfront.geometry.rings import polygon_areas
from grainfront.jit import compiling
from grainfront.packing import search_of
from grainfront.packing.advance import (
    FINISHED,
    N_COUNTERS,
    N_PLACED,
    N_TOO_LARGE,
    N_WAITING,
    WAITING_PLACES,
    advance,
)
from grainfront.packing.front import make_front
from grainfront.packing.grid import make_grid
from grainfront.packing.memory import Memory, make_memory
from grainfront.packing.scout import SCOUT_CORNERS
from grainfront.packing.state import (
    CLEARANCE_ULPS,
    TOLERANCE_OF_CLEARANCE,
    Domain,
    Front,
    Grid,
    OrientationLaw,
    Placed,
    Supply,
    Trials,
)
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
    domain. `progress` is told the particles placed and the volume fraction so far. With
    n_angle = n_loc = 1 this is the plain advancing front method. Source: Du et al. (2023),
    sections 3 and 4.
    """
    with compiling(f"{search_of(n_angle, n_loc)} search") as compilation:
        state = prepare(hulls, shape, size, orientation, domain, n_angle, n_loc, rng)
        state.advance_to(0)
    hull_area = polygon_areas(hulls.nodes, hulls.offsets)
    area = 0.0
    kernel_s = 0.0
    placed = 0
    # without progress to tell, one call: between calls threads wait for one another
    step = size.size if progress is None else max(size.size // CALLS, 1)
    while not state.counters[FINISHED]:
        start = time.thread_time()
        state.advance_to(placed + step)
        kernel_s += time.thread_time() - start
        if progress is not None:
            new = state.placed.source[placed : state.counters[N_PLACED]]
            area += float(np.sum(hull_area[shape[new]] * size[new] ** 2))
            progress(int(state.counters[N_PLACED]), area / domain.area)
        placed = int(state.counters[N_PLACED])
    return _packing(state, hull_area, aspect_ratio, shape, size, domain), RunTime(
        kernel_s, compilation.seconds
    )


class State(NamedTuple):
    """A packing under way: the arguments of the kernel."""

    front: Front
    placed: Placed
    grid: Grid
    domain: Domain
    supply: Supply
    law: OrientationLaw
    trials: Trials
    memory: Memory | None
    waiting: np.ndarray
    counters: np.ndarray
    n_angle: int
    n_loc: int

    def advance_to(self, limit: int) -> None:
        """Place particles until there are `limit` of them or the domain is full."""
        advance(*self, limit)


def prepare(
    hulls: Polygons,
    shape: np.ndarray,
    size: np.ndarray,
    orientation: OrientationLaw,
    domain: Rectangle,
    n_angle: int,
    n_loc: int,
    rng: np.random.Generator,
) -> State:
    """An empty packing with all its arrays; see `pack_hulls`."""
    n = size.size
    walls = _domain(domain)
    supply = _supply(hulls, shape, size, rng)
    circumradius = supply.circumradius[shape] * size
    nodes_of_all = int(hulls.node_counts[shape].sum())
    nodes_of_trials = n_angle * int(hulls.node_counts.max()) + SCOUT_CORNERS
    return State(
        front=make_front(n),
        placed=Placed(
            nodes=np.empty((nodes_of_all, 2)),
            offsets=np.zeros(n + 1, dtype=np.int64),
            disc=np.empty((n, 4)),
            orientation=np.empty(n),
            source=np.empty(n, dtype=np.int64),
        ),
        grid=make_grid(walls, circumradius.min(), circumradius.max(), n),
        domain=walls,
        supply=supply,
        law=orientation._replace(placed=np.zeros_like(orientation.placed)),
        trials=Trials(
            nodes=np.empty((nodes_of_trials, 2)),
            reach=np.empty((n_angle + 1, 4)),
            orientation=np.empty(n_angle),
            bin=np.empty(n_angle, dtype=np.int64),
            weight=np.empty(orientation.probability.size + 1),
        ),
        memory=make_memory(n_angle, n_loc) if search_of(n_angle, n_loc) == "pruned" else None,
        waiting=np.empty(WAITING_PLACES, dtype=np.int64),
        counters=np.zeros(N_COUNTERS, dtype=np.int64),
        n_angle=n_angle,
        n_loc=n_loc,
    )


def _domain(domain: Rectangle) -> Domain:
    sides = domain.x_min, domain.y_min, domain.x_max, domain.y_max
    clearance = CLEARANCE_ULPS * float(np.spacing(1.0)) * max(map(abs, sides))
    return Domain(*sides, clearance, TOLERANCE_OF_CLEARANCE * clearance)


def _supply(
    hulls: Polygons, shape: np.ndarray, size: np.ndarray, rng: np.random.Generator
) -> Supply:
    circumradius, inradius = np.empty(hulls.count), np.empty(hulls.count)
    radii_about_origin(hulls.nodes, hulls.offsets, circumradius, inradius)
    return Supply(
        hulls.nodes,
        hulls.offsets,
        circumradius,
        inradius,
        np.ascontiguousarray(shape, dtype=np.int64),
        np.ascontiguousarray(size, dtype=np.float64),
        rng.random(size.size),
    )


def _packing(
    state: State,
    hull_area: np.ndarray,
    aspect_ratio: np.ndarray,
    shape: np.ndarray,
    size: np.ndarray,
    domain: Rectangle,
) -> Packing:
    n = int(state.counters[N_PLACED])
    placed = state.placed
    offsets = placed.offsets[: n + 1]
    source = placed.source[:n]
    x, y, circumradius, _ = placed.disc[:n].T
    return Packing(
        domain=domain,
        polygons=Polygons(placed.nodes[: offsets[-1]], offsets),
        x=x,
        y=y,
        size=size[source],
        aspect_ratio=aspect_ratio[shape[source]],
        orientation=placed.orientation[:n],
        area=hull_area[shape[source]] * size[source] ** 2,
        circumradius=circumradius,
        shape=shape[source],
        left_over=int(state.counters[N_WAITING] + state.counters[N_TOO_LARGE]),
    )
