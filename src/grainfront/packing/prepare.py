"""Before and after the kernel: the arrays that it works on, and the Packing that comes of them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from grainfront.geometry.placing import radii_about_origin
from grainfront.geometry.regions import REST
from grainfront.geometry.rings import polygon_areas
from grainfront.packing import search_of
from grainfront.packing.arranged import NO_MEMBER, Arrangement
from grainfront.packing.front import make_front
from grainfront.packing.grid import make_grid
from grainfront.packing.memory import make_memory
from grainfront.packing.orientations import orientation_laws
from grainfront.packing.scout import SCOUT_CORNERS
from grainfront.packing.state import (
    CLEARANCE_ULPS,
    TOLERANCE_OF_CLEARANCE,
    Domain,
    OrientationLaw,
    Placed,
    Queues,
    Supply,
    Trials,
)
from grainfront.packing.turns import (
    LAST_ORIENTATIONS,
    N_COUNTERS,
    N_LEFT_OVER,
    WAITING_PLACES,
)
from grainfront.packing.under_way import State
from grainfront.particles import Packing, Rectangle, Region
from grainfront.polygons import Polygons


def prepare(
    hulls: Polygons,
    shape: np.ndarray,
    size: np.ndarray,
    orientation: Sequence[OrientationLaw],
    domain: Rectangle,
    n_angle: int,
    n_loc: int,
    rng: np.random.Generator,
    arrangement: Arrangement | None = None,
    last: np.ndarray | None = None,
    largest_size: float | None = None,
    fixed: Polygons | None = None,
) -> State:
    """An empty packing with all its arrays.

    `hulls` are standardised (centroid at the origin, S = 1, orientation 0). Particle i is a copy of
    `hulls.polygon(shape[i])` scaled by `size[i]`. Particles are taken in this order, so `shape` and
    `size`, (n,), must hold enough to fill the domain, a rectangle or a region of any shape. With an
    arrangement, each of its laws has an `orientation`; its particles come one law's after the
    other's, and `last` (n_laws,) is where they end. `largest_size` is given where sizes are yet to
    change. Around `fixed`, convex particles, the hollows of a region are filled one by one.
    """
    n = size.size
    last = np.array([n]) if last is None else last
    supply = _supply(hulls, shape, size, rng)
    circumradius = supply.circumradius[shape] * size
    largest = circumradius.max()
    if largest_size is not None:
        largest = max(largest, largest_size * supply.circumradius.max())
    nodes_of_all = int(hulls.node_counts[shape].sum())
    nodes_of_trials = n_angle * int(hulls.node_counts.max()) + SCOUT_CORNERS
    placed = Placed(
        nodes=np.empty((nodes_of_all, 2)),
        offsets=np.zeros(n + 1, dtype=np.int64),
        disc=np.empty((n, 4)),
        orientation=np.empty(n),
        source=np.empty(n, dtype=np.int64),
    )
    walls = _domain(domain)
    if isinstance(domain, Region):
        from grainfront.packing.region import add_obstacles

        placed, obstacles = add_obstacles(placed, domain, fixed, circumradius, float(largest))
        walls = walls._replace(obstacles=obstacles)
    return State(
        front=make_front(n),
        placed=placed,
        grid=make_grid(walls, circumradius.min(), largest, n),
        domain=walls,
        supply=supply,
        laws=orientation_laws(orientation),
        trials=Trials(
            nodes=np.empty((nodes_of_trials, 2)),
            reach=np.empty((n_angle + 1, 4)),
            orientation=np.empty(n_angle),
            bin=np.empty(n_angle, dtype=np.int64),
            weight=np.empty(max(law.probability.size for law in orientation) + 1),
        ),
        memory=make_memory(n_angle, n_loc) if search_of(n_angle, n_loc) == "pruned" else None,
        control=None,
        arrangement=arrangement,
        queues=_queues(last, 0 if arrangement is None else n + 3, n_angle),
        counters=np.zeros(N_COUNTERS, dtype=np.int64),
        n_angle=n_angle,
        n_loc=n_loc,
        region=domain,
    )


def _queues(last: np.ndarray, members: int, n_angle: int) -> Queues:
    waiting, parked, placed = np.zeros((3, last.size), dtype=np.int64)
    return Queues(
        drawn=np.concatenate([[0], last[:-1]]),
        last=last,
        waiting=np.empty((last.size, WAITING_PLACES), dtype=np.int64),
        n_waiting=waiting,
        parked=parked,
        n_placed=placed,
        passed=np.full(members, NO_MEMBER),
        least_height=np.zeros(members),
        rough_centre=np.zeros(3),
        last_rows=np.array([1 + math.ceil(LAST_ORIENTATIONS / n_angle)]),
    )


def _domain(domain: Rectangle) -> Domain:
    sides = domain.x_min, domain.y_min, domain.x_max, domain.y_max
    clearance = CLEARANCE_ULPS * float(np.spacing(1.0)) * max(map(abs, sides))
    return Domain(*sides, clearance, TOLERANCE_OF_CLEARANCE * clearance, None)


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


def as_packing(state: State, aspect_ratio: np.ndarray) -> Packing:
    """What has been placed so far; `aspect_ratio`, (n_shapes,), is that of the hulls."""
    n = state.n_placed
    placed, supply = state.placed, state.supply
    offsets = placed.offsets[: n + 1]
    source = placed.source[:n]
    shape, size = supply.shape[source], supply.size[source]
    x, y, circumradius, _ = placed.disc[:n].T
    return Packing(
        domain=state.region,
        polygons=Polygons(placed.nodes[: offsets[-1]], offsets),
        x=x,
        y=y,
        size=size,
        aspect_ratio=aspect_ratio[shape],
        orientation=placed.orientation[:n],
        area=polygon_areas(supply.hull_nodes, supply.hull_offsets)[shape] * size**2,
        circumradius=circumradius,
        shape=shape,
        left_over=int(state.queues.n_waiting.sum() + state.counters[N_LEFT_OVER]),
        region=None if state.arrangement is None else _region(state, source),
    )


def _region(state: State, source: np.ndarray) -> np.ndarray:
    """The regions that particles of the supply were drawn for, −1 for the rest of the domain."""
    arrangement = state.arrangement
    assert arrangement is not None, "there are no regions"
    region = arrangement.region_of_law[np.searchsorted(state.queues.last, source, side="right")]
    return np.where(region == arrangement.first_law.size - 2, REST, region)
