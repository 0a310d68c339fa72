"""Where else there is room once a front among obstacles has come to its end, and who takes it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import shapely

from grainfront.geometry.rings import polygon_areas
from grainfront.geometry.rooms import edges_of, holds_a_point, rooms_for_disc
from grainfront.packing.starts import start_front
from grainfront.packing.turns import EMPTY_ROWS, FINISHED, IN_VAIN, N_LEFT_OVER
from grainfront.particles import Region

if TYPE_CHECKING:
    from grainfront.packing.prepare import State
    from grainfront.packing.state import Obstacles

ANYWHERE = np.empty((0, 4))
# A domain that is filled less than this has room, but not for any of the waiting particles: other
# packings of hulls fill more, but for slivers. Above it, others would only bend the size law.
LEAST_FILLED = 0.5
# So many times in a row others are drawn in vain. Of four times eight particles none found a place:
# hardly one in ten does.
MOST_IN_VAIN = 3


def go_on(state: State, limit: int) -> bool:
    """Go on where a front among obstacles has come to its end; whether there is a place to.

    Another front begins far from all particles; where no such place is left, in a room that holds
    none yet, as near as it likes to those behind a wall. In a domain that is not half full, the
    last front goes on with others than the waiting particles.
    """
    obstacles = state.domain.obstacles
    assert obstacles is not None, "in a rectangle the front begins at the bottom"
    if _start(state, obstacles, limit, ANYWHERE, 0):
        return True
    only_hollows = obstacles.empty_about == 0.0
    if only_hollows or not state.finished or state.n_placed >= limit:
        return False
    return _start_in_empty_room(state, obstacles, limit) or _resume_with_others(state)


def _start(
    state: State, obstacles: Obstacles, limit: int, within: np.ndarray, attempt: int
) -> bool:
    return start_front(
        obstacles, state.front, state.placed, state.grid, state.domain, state.supply, state.laws,
        state.trials, state.arrangement, state.queues, state.counters, state.n_angle, state.n_loc,
        limit, within, attempt,
    )  # fmt: skip


def _start_in_empty_room(state: State, obstacles: Obstacles, limit: int) -> bool:
    """Begin a front in an empty room with one of the waiting particles, or of others in turn."""
    within = _edges_of_empty_rooms(state) if state.n_placed else ANYWHERE
    if state.n_placed and not within.size:
        return False
    for _ in range(1 + MOST_IN_VAIN):
        for attempt in range(state.queues.last_rows[0]):
            rejected = np.zeros_like(obstacles.rejected)
            nearby = obstacles._replace(empty_about=0.0, rejected=rejected)
            if _start(state, nearby, limit, within, attempt):
                return True
        if not _leave_over(state):
            break
    return False


def _edges_of_empty_rooms(state: State) -> np.ndarray:
    """Edges (n, 4) of the rooms that hold no particle, for discs of the mean size so far."""
    assert isinstance(state.region, Region), "a rectangle is one room"
    radius = 0.5 * float(state.supply.size[state.placed.source[: state.n_placed]].mean())
    rooms = rooms_for_disc(state.region.to_shapely(), radius)
    x, y, _, _ = state.placed.disc[: state.n_placed].T
    return edges_of(shapely.buffer(rooms[~holds_a_point(rooms, x, y)], radius))


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
