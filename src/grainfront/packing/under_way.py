"""A packing under way: all that its kernels work on, and what of it can be asked or copied."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from grainfront.geometry.rings import polygon_areas
from grainfront.packing.arranged import Arrangement
from grainfront.packing.control import Control
from grainfront.packing.memory import Memory, make_memory
from grainfront.packing.state import (
    Domain,
    Front,
    Grid,
    OrientationLaws,
    Placed,
    Queues,
    Supply,
    Trials,
)
from grainfront.packing.turns import FINISHED, N_PLACED
from grainfront.particles import Rectangle

if TYPE_CHECKING:
    from grainfront.packing.size_keeper import SizeKeeper


class State(NamedTuple):
    """A packing under way: the arguments of the kernel."""

    front: Front
    placed: Placed
    grid: Grid
    domain: Domain
    supply: Supply
    laws: OrientationLaws
    trials: Trials
    memory: Memory | None
    control: Control | None
    arrangement: Arrangement | None
    queues: Queues
    counters: np.ndarray
    n_angle: int
    n_loc: int
    region: Rectangle
    keeper: SizeKeeper | None = None

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

    def areas(self, particles: slice) -> np.ndarray:
        """Hull areas of some of the particles, by order of placement."""
        source = self.placed.source[particles]
        areas = polygon_areas(self.supply.hull_nodes, self.supply.hull_offsets)
        return areas[self.supply.shape[source]] * self.supply.size[source] ** 2

    def copy(self) -> State:
        """The same packing, to be continued in another way; what does not change is shared."""
        return self._replace(
            front=Front(*(array.copy() for array in self.front)),
            placed=Placed(*(array.copy() for array in self.placed)),
            grid=Grid(*(array.copy() for array in self.grid)),
            laws=self.laws._replace(placed=self.laws.placed.copy()),
            queues=Queues(*(array.copy() for array in self.queues)),
            supply=self.supply._replace(size=self.supply.size.copy()),
            counters=self.counters.copy(),
            keeper=None if self.keeper is None else self.keeper.copy(),
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
