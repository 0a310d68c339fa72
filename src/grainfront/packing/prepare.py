"""Before and after the kernel: the arrays that it works on, and the Packing that comes of them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainfront.geometry.placing import radii_about_origin
from grainfront.geometry.rings import polygon_areas
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
from grainfront.packing.control import Control
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
from grainfront.particles import Packing, Rectangle, Region
from grainfront.polygons import Polygons


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
    control: Control | None
    waiting: np.ndarray
    counters: np.ndarray
    n_angle: int
    n_loc: int
    region: Rectangle

    def advance_to(self, limit: int) -> None:
        """Place particles until there are `limit` of them or the domain is full."""
        advance(*self[:-1], limit)
        while self._start_front(limit):
            advance(*self[:-1], limit)

    def _start_front(self, limit: int) -> bool:
        """Begin another front where the last one did not come; whether there was a place for it."""
        if self.domain.obstacles is None:
            return False
        from grainfront.packing.starts import start_front

        return start_front(
            self.domain.obstacles, self.front, self.placed, self.grid, self.domain, self.supply,
            self.law, self.trials, self.waiting, self.counters, self.n_angle, limit,
        )  # fmt: skip

    @property
    def n_placed(self) -> int:
        """Particles placed so far."""
        return int(self.counters[N_PLACED])

    @property
    def finished(self) -> bool:
        """Whether the domain is full."""
        return bool(self.counters[FINISHED])

    @property
    def domain_height(self) -> float:
        """Height of the domain."""
        return self.domain.y_max - self.domain.y_min

    @property
    def domain_area(self) -> float:
        """Area of the domain."""
        return self.region.area

    def copy(self) -> State:
        """The same packing, to be continued in another way; what does not change is shared."""
        return self._replace(
            front=Front(*(array.copy() for array in self.front)),
            placed=Placed(*(array.copy() for array in self.placed)),
            grid=Grid(*(array.copy() for array in self.grid)),
            law=self.law._replace(placed=self.law.placed.copy()),
            waiting=self.waiting.copy(),
            counters=self.counters.copy(),
        )

    def steered(self, control: Control, rng: np.random.Generator) -> State:
        """The same packing with the effort left to a controller, n_angle and n_loc at most.

        Its particles get other random offsets of their trial orientations, so that it is another
        packing even where the effort is the same.
        """
        return self._replace(
            control=control,
            memory=self.memory or make_memory(self.n_angle, self.n_loc),
            supply=self.supply._replace(uniform=rng.random(self.supply.size.size)),
        )


def prepare(
    hulls: Polygons,
    shape: np.ndarray,
    size: np.ndarray,
    orientation: OrientationLaw,
    domain: Rectangle,
    n_angle: int,
    n_loc: int,
    rng: np.random.Generator,
    fixed: Polygons | None = None,
) -> State:
    """An empty packing with all its arrays; see `pack_hulls`.

    Around `fixed`, convex particles, the hollows of a region are filled one by one.
    """
    n = size.size
    supply = _supply(hulls, shape, size, rng)
    circumradius = supply.circumradius[shape] * size
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

        placed, obstacles = add_obstacles(placed, domain, fixed, float(np.median(circumradius)))
        walls = walls._replace(obstacles=obstacles)
    return State(
        front=make_front(n),
        placed=placed,
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
        control=None,
        waiting=np.empty(WAITING_PLACES, dtype=np.int64),
        counters=np.zeros(N_COUNTERS, dtype=np.int64),
        n_angle=n_angle,
        n_loc=n_loc,
        region=domain,
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
        left_over=int(state.counters[N_WAITING] + state.counters[N_TOO_LARGE]),
    )
