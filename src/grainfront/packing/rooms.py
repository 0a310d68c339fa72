"""Rooms of a domain that no front has reached, and the search for a place to begin one in each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely

from grainfront.geometry.rooms import Occupancy, edges_of, rooms_for_disc
from grainfront.packing.turns import WAITING_PLACES
from grainfront.particles import Region
from grainfront.polygons import Polygons

if TYPE_CHECKING:
    from grainfront.packing.state import Obstacles
    from grainfront.packing.under_way import State

# Contacts tried in a room for each particle, some hundredths of a second, after which it is taken
# not to fit; there are others.
MOST_CONTACTS = 50_000


UNLIMITED = 2**62


class Room(NamedTuple):
    """Where a front may begin: in a polygon and touching any of the obstacles beside it."""

    edges: np.ndarray  # (n, 4), those of the polygon; none: all of the domain
    beside: np.ndarray  # (n_obstacles,)
    contacts: np.ndarray  # (1,) tried so far
    most: int  # tried for each particle


def anywhere(obstacles: Obstacles) -> Room:
    """All of the domain."""
    beside = np.ones(len(obstacles.box), dtype=np.bool_)
    return Room(np.empty((0, 4)), beside, np.zeros(1, dtype=np.int64), UNLIMITED)


class EmptyRooms:
    """The rooms that are empty, while fronts begin in one after the other.

    Rooms are those for the disc in the smallest particle, and for discs of the mean size and of
    twice as much: what such a disc is shut off from is a room.
    """

    def __init__(self, state: State, obstacles: Obstacles) -> None:
        assert isinstance(state.region, Region), "a rectangle is one room"
        supply = state.supply
        smallest = float((supply.inradius[supply.shape] * supply.size).min())
        source = state.placed.source[: state.n_placed]
        mean = float(supply.size[source if source.size else ...].mean())
        whole = state.region.to_shapely()
        walls = shapely.STRtree(_shapes(state, obstacles))
        polygons: list[Any] = []
        self._rooms: list[Room] = []
        for radius in (smallest, mean / 2, mean):
            found = rooms_for_disc(whole, radius)
            occupancy = Occupancy(found)
            occupancy.add(*_centres(state, 0))
            in_known = shapely.STRtree(polygons).query(found, predicate="intersects")[0]
            new = np.setdiff1d(np.flatnonzero(occupancy.particles == 0), in_known)
            polygons += found[new].tolist()
            room, wall = walls.query(found[new], predicate="dwithin", distance=radius)
            for n, polygon in enumerate(found[new]):
                beside = np.zeros(len(obstacles.box), dtype=np.bool_)
                beside[wall[room == n]] = True
                none_tried = np.zeros(1, dtype=np.int64)
                self._rooms.append(Room(edges_of(polygon), beside, none_tried, MOST_CONTACTS))
        self._state = state
        self._occupancy = Occupancy(np.array(polygons))
        self._told = 0

    def __iter__(self) -> Iterator[Room]:
        """The empty rooms that the waiting particles may fit."""
        for n, room in enumerate(self._rooms):
            if room.contacts[0] < MOST_CONTACTS * WAITING_PLACES and self._empty()[n]:
                yield room

    def _empty(self) -> np.ndarray:
        self._occupancy.add(*_centres(self._state, self._told))
        self._told = self._state.n_placed
        return self._occupancy.particles == 0

    def left(self) -> bool:
        """Whether any of them is still empty."""
        return bool(self._empty().any())

    def begin_anew(self) -> None:
        """Others wait by now."""
        for room in self._rooms:
            room.contacts[0] = 0


def _centres(state: State, first: int) -> tuple[np.ndarray, np.ndarray]:
    """Where the particles from the first one on are."""
    new = slice(first, state.n_placed)
    return state.placed.disc[new, 0], state.placed.disc[new, 1]


def _shapes(state: State, obstacles: Obstacles) -> np.ndarray:
    """The obstacles as shapely polygons."""
    offsets = state.placed.offsets[obstacles.first :]
    nodes = state.placed.nodes[offsets[0] : offsets[-1]]
    return Polygons(nodes, offsets - offsets[0]).to_shapely()
