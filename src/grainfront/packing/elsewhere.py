"""Where else there is room once a front among obstacles has come to its end, and who takes it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from grainfront.packing.rooms import EmptyRooms, Room, anywhere
from grainfront.packing.starts import start_front
from grainfront.packing.turns import (
    EMPTY_ROWS,
    FINISHED,
    IN_VAIN,
    LAST_ORIENTATIONS,
    N_LEFT_OVER,
)
from grainfront.particles import LEAST_FILLED

if TYPE_CHECKING:
    from grainfront.packing.state import Obstacles
    from grainfront.packing.under_way import State

# So many times in a row others are drawn in vain. Of four times eight particles none found a place:
# hardly one in ten does.
MOST_IN_VAIN = 3


def other_fronts(state: State, obstacles: Obstacles, limit: int) -> Iterator[None]:
    """Begin another front, or go on with others, as long as there is a place; yield after each.

    Fronts begin far from all particles; where no such place is left, in rooms that are empty, as
    near as they like to particles behind a wall. In a domain that is not half full, the last front
    goes on with others than the waiting particles; above that, others would bend the size law.
    """
    yield from _far_from_all(state, obstacles, limit)
    only_hollows = obstacles.empty_about == 0.0
    if only_hollows or not state.finished:
        return
    yield from _in_empty_rooms(state, obstacles, limit)
    yield from _far_from_all(state, obstacles, limit)
    while state.finished and _resume_with_others(state):
        yield


def _far_from_all(state: State, obstacles: Obstacles, limit: int) -> Iterator[None]:
    while _start(state, obstacles, limit, anywhere(obstacles)):
        yield


def _in_empty_rooms(state: State, obstacles: Obstacles, limit: int) -> Iterator[None]:
    """In each room with one of the waiting particles or, in the end, with others."""
    nearby = obstacles._replace(empty_about=0.0, rejected=np.zeros_like(obstacles.rejected))
    orientations = math.ceil(LAST_ORIENTATIONS / state.n_angle)
    rooms = EmptyRooms(state, obstacles)
    in_vain = 0
    while state.finished and rooms.left() and in_vain < orientations * (1 + MOST_IN_VAIN):
        before = state.n_placed
        for room in rooms:
            nearby.rejected[:] = False
            if _start(state, nearby, limit, room, in_vain % orientations):
                yield
        in_vain = in_vain + 1 if state.n_placed == before else 0
        if in_vain > 0 and in_vain % orientations == 0:
            if not _leave_over(state):
                return
            rooms.begin_anew()


def _start(state: State, obstacles: Obstacles, limit: int, room: Room, attempt: int = 0) -> bool:
    return start_front(
        obstacles, state.front, state.placed, state.grid, state.domain, state.supply, state.laws,
        state.trials, state.arrangement, state.queues, state.counters, state.n_angle, state.n_loc,
        limit, *room, attempt,
    )  # fmt: skip


def _resume_with_others(state: State) -> bool:
    """Go on with others than the waiting particles, unless the domain is half full."""
    counters = state.counters
    filled = state.areas(slice(0, state.n_placed)).sum() / state.region.area
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
