"""Where else there is room once a front among obstacles has come to its end, and who takes it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import shapely

from grainfront.geometry.rings import polygon_areas
from grainfront.geometry.rooms import edges_of, holds_a_point, rooms_for_disc
from grainfront.packing.starts import start_front
from grainfront.packing.turns import (
    EMPTY_ROWS,
    FINISHED,
    IN_VAIN,
    LAST_ORIENTATIONS,
    N_LEFT_OVER,
    WAITING_PLACES,
)
from grainfront.particles import Region

if TYPE_CHECKING:
    from grainfront.packing.state import Obstacles
    from grainfront.packing.under_way import State

# A domain that is filled less than this has room, but not for any of the waiting particles: other
# packings of hulls fill more, but for slivers. Above it, others would only bend the size law.
LEAST_FILLED = 0.5
# So many times in a row others are drawn in vain. Of four times eight particles none found a place:
# hardly one in ten does.
MOST_IN_VAIN = 3
# Contacts tried in an empty room before it is given up, some second's worth; of the waiting
# particles, each is tried in it once, whatever that takes.
MOST_CONTACTS = 2_000_000


def other_fronts(state: State, obstacles: Obstacles, limit: int) -> Iterator[None]:
    """Begin another front, or go on with others, as long as there is a place; yield after each.

    Fronts begin far from all particles; where no such place is left, in rooms that hold none yet,
    as near as they like to those behind a wall. In a domain that is not half full, the last front
    goes on with others than the waiting particles.
    """
    anywhere = Room(None, np.empty((0, 4)), np.ones(len(obstacles.box), dtype=np.bool_))
    yield from _fronts_far_off(state, obstacles, limit, anywhere)
    only_hollows = obstacles.empty_about == 0.0
    if only_hollows:
        return
    if state.n_placed == 0 and _start_nearby(state, obstacles, limit, anywhere):
        yield
        yield from _fronts_far_off(state, obstacles, limit, anywhere)
    for room in _empty_rooms(state, obstacles):
        if state.finished and room.is_empty(state) and _start_nearby(state, obstacles, limit, room):
            yield
            yield from _fronts_far_off(state, obstacles, limit, anywhere)
    while state.finished and _resume_with_others(state):
        yield


class Room(NamedTuple):
    """Where a front may begin: in a polygon and touching any of the obstacles beside it."""

    polygon: Any  # or None: all of the domain
    edges: np.ndarray  # (n, 4), its own, or none
    beside: np.ndarray  # (n_obstacles,)

    @classmethod
    def of(cls, polygon: Any, obstacles: Obstacles, reach: float) -> Room:
        """A polygon, and the obstacles that may be touched from inside it within a reach."""
        left, bottom, right, top = polygon.bounds
        low, high = obstacles.box[:, :2], obstacles.box[:, 2:]
        beside = np.all(low <= [right + reach, top + reach], axis=1)
        beside &= np.all(high >= [left - reach, bottom - reach], axis=1)
        return cls(polygon, edges_of(np.array([polygon])), beside)

    def is_empty(self, state: State) -> bool:
        """Whether no particle has its centre there."""
        x, y, _, _ = state.placed.disc[: state.n_placed].T
        return not holds_a_point(np.array([self.polygon]), x, y)[0]


def _fronts_far_off(
    state: State, obstacles: Obstacles, limit: int, anywhere: Room
) -> Iterator[None]:
    while _start(state, obstacles, limit, anywhere):
        yield


def _start(state: State, obstacles: Obstacles, limit: int, room: Room, attempt: int = 0) -> bool:
    return start_front(
        obstacles, state.front, state.placed, state.grid, state.domain, state.supply, state.laws,
        state.trials, state.arrangement, state.queues, state.counters, state.n_angle, state.n_loc,
        limit, room.edges, room.beside, attempt,
    )  # fmt: skip


def _empty_rooms(state: State, obstacles: Obstacles) -> list[Room]:
    """Those of the rooms for discs of the mean size so far that hold no particle."""
    if state.n_placed == 0 or not state.finished:
        return []
    assert isinstance(state.region, Region), "a rectangle is one room"
    supply = state.supply
    radius = 0.5 * float(supply.size[state.placed.source[: state.n_placed]].mean())
    rooms = rooms_for_disc(state.region.to_shapely(), radius)
    x, y, _, _ = state.placed.disc[: state.n_placed].T
    reach = float((supply.circumradius[supply.shape] * supply.size).max())
    empty = rooms[~holds_a_point(rooms, x, y)]
    return [Room.of(polygon, obstacles, reach) for polygon in shapely.buffer(empty, radius)]


def _start_nearby(state: State, obstacles: Obstacles, limit: int, room: Room) -> bool:
    """Begin a front in an empty room with one of the waiting particles, or of others in turn."""
    beside = np.diff(obstacles.beside_start)[room.beside].sum()
    contacts_once = max(int(beside) * state.n_angle * WAITING_PLACES, 1)
    orientations = math.ceil(LAST_ORIENTATIONS / state.n_angle)
    attempts = min(orientations * (1 + MOST_IN_VAIN), max(MOST_CONTACTS // contacts_once, 1))
    for attempt in range(attempts):
        if attempt > 0 and attempt % orientations == 0 and not _leave_over(state):
            break
        rejected = np.zeros_like(obstacles.rejected)
        nearby = obstacles._replace(empty_about=0.0, rejected=rejected)
        if _start(state, nearby, limit, room, attempt % orientations):
            return True
    return False


def _resume_with_others(state: State) -> bool:
    """Go on with others than the waiting particles, unless the domain is half full."""
    supply, counters = state.supply, state.counters
    source = state.placed.source[: state.n_placed]
    areas = polygon_areas(supply.hull_nodes, supply.hull_offsets)[supply.shape[source]]
    filled = np.sum(areas * supply.size[source] ** 2) / state.region.area
    if filled >= LEAST_FILLED or counters[IN_VAIN] == MOST_IN_VAIN or not _leave_over(state):
        return False
    counters[IN_VAIN] += 1
    counters[EMPTY_ROWS] = counters[FINISHED] = 0
    return True


def _leave_over(state: State) -> bool:
    """Leave the waiting particles over; whether there are any others."""
    queues = state.queues
    if not np.any(queues.drawn < queues.last):
        return False
    state.counters[N_LEFT_OVER] += queues.n_waiting.sum()
    queues.n_waiting[:] = 0
    return True
