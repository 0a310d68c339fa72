"""Whose turn it is: rows along the front, the particles that wait, and their regions."""

from __future__ import annotations

from grainfront.jit import inlined
from grainfront.packing.arranged import law_at, nth_other_law, rough_centre
from grainfront.packing.front import front_length, member_at, move_gap, position_of
from grainfront.packing.settle import FORMER, LATTER
from grainfront.packing.state import BOTTOM_WALL, RIGHT_WALL

# Particles that wait at the top for a lower place while others are tried: enough for one giant
# grain not to end the packing, few enough not to bend the size law.
WAITING_PLACES = 8

# A packing whose domain is not full ends when the waiting particles have been tried in so many
# orientations of their laws at least, at every place.
LAST_ORIENTATIONS = 24
# So many particles ahead, what a law's bins have so far counts for nothing.
FAR_AHEAD = 2**30

# Where no particle finds a place, the front moves on by this part of n_loc: each pair is tried with
# some eight times as many orientations as in one turn, but not with forty times as many, in vain.
MOVES_ON = 4

# What the loop remembers between calls; LAW and TURN: of whose waiting particles it tries which.
N_PLACED, N_LEFT_OVER, LAW, TURN, REGIONS_TRIED, N_FAILED = range(6)
PLACED_IN_ROW, TOO_HIGH_IN_ROW, FINISHED, EMPTY_ROWS = range(6, 10)
IN_VAIN = 12  # beyond what an arrangement remembers
N_COUNTERS = 13


@inlined
def exhausted(queues, law):
    """Whether a law has no particle left that might find a place."""
    if queues.parked[law] == queues.waiting.shape[1]:
        return True
    drawn_out = queues.drawn[law] == queues.last[law]
    return drawn_out and queues.parked[law] == queues.n_waiting[law]


@inlined
def bottom_is_open(front):
    """Whether particles may still lie on the bottom."""
    position = front_length(front) - 1
    while position >= 0 and member_at(front, position) != BOTTOM_WALL:
        position -= 1
    return position >= 0


@inlined
def end_row(front, queues, counters):
    """Begin a new row at the left wall, or finish where the last one placed nothing."""
    parked_more = False
    left = False
    for law in range(queues.last.size):
        if counters[PLACED_IN_ROW] > 0:
            queues.parked[law] = 0
        elif counters[TOO_HIGH_IN_ROW] == 0 and queues.parked[law] < queues.n_waiting[law]:
            queues.parked[law] += 1
            parked_more = True
        if not exhausted(queues, law):
            left = True
    if counters[PLACED_IN_ROW] > 0:
        counters[EMPTY_ROWS] = 0
        counters[IN_VAIN] = 0
    elif not left or not parked_more:
        # once more in orientations that the laws do not lack yet: there may be room in just these;
        # and, unless the domain is full to the top, in all of the laws: others may never fit
        full = counters[TOO_HIGH_IN_ROW] > 0 and not bottom_is_open(front)
        counters[EMPTY_ROWS] += 1
        queues.parked[:] = 0
        if counters[EMPTY_ROWS] > (1 if full else queues.last_rows[0]):
            counters[FINISHED] = 1
    counters[PLACED_IN_ROW] = 0
    counters[TOO_HIGH_IN_ROW] = 0
    move_gap(front, 1)


@inlined
def look_ahead(counters, laws):
    """How many particles ahead of the placed ones orientations are drawn for."""
    if counters[EMPTY_ROWS] == 0:
        return 0
    return laws.probability.shape[1] if counters[EMPTY_ROWS] == 1 else FAR_AHEAD


@inlined
def pass_on(front, queues, counters, members):
    """Move on along the front, by some members but not beyond the right wall."""
    if front.member[front.ends[1]] == RIGHT_WALL:
        end_row(front, queues, counters)
    else:
        move_gap(front, min(front.ends[0] + members, front_length(front) - 1))


@inlined
def turn_at_obstacle(front, placed, queues, counters, touched, particle):
    """Go on beside a particle that touches an obstacle instead of one of its pair.

    Towards the obstacle where that leads down, so that the front reaches all that lies below it;
    elsewhere rows end at walls.
    """
    position = position_of(front, particle)
    partner = member_at(front, position - 1 if touched == FORMER else position + 1)
    leads_down = placed.disc[particle, 1] < placed.disc[partner, 1]
    if touched == LATTER and leads_down:
        move_gap(front, position)
    elif touched == FORMER and not leads_down:
        pass_on(front, queues, counters, 1)


@inlined
def draw_next(queues, counters, law, supply, narrowest):
    """Draw a particle to wait for its turn; true where it is too wide for the domain: left over."""
    source = queues.drawn[law]
    queues.drawn[law] += 1
    if supply.size[source] > narrowest:
        counters[N_LEFT_OVER] += 1
        return True
    queues.waiting[law, queues.n_waiting[law]] = source
    queues.n_waiting[law] += 1
    return False


@inlined
def take_from_waiting(queues, law, turn):
    """Remove a particle that has been placed from those that wait."""
    queues.n_waiting[law] -= 1
    for n in range(turn, queues.n_waiting[law]):
        queues.waiting[law, n] = queues.waiting[law, n + 1]


@inlined
def begin_turn(front, placed, domain, arrangement, queues, counters, n_loc):
    """Choose whose particles are tried first at the gap: those of the rough centre's region."""
    counters[REGIONS_TRIED] = 0
    if arrangement is not None:
        x, y, height = rough_centre(front, placed, domain, queues, counters, n_loc)
        queues.rough_centre[0] = x
        queues.rough_centre[1] = y
        queues.rough_centre[2] = height
        counters[LAW] = law_at(arrangement, x, y)
    counters[TURN] = queues.parked[counters[LAW]]


@inlined
def next_region(arrangement, queues, counters):
    """Turn to the particles of another region at the same gap; false where all have been tried."""
    if arrangement is None:
        return False
    counters[REGIONS_TRIED] += 1
    x, y = queues.rough_centre[0], queues.rough_centre[1]
    law = nth_other_law(arrangement, counters[REGIONS_TRIED], x, y)
    if law < 0:
        return False
    counters[LAW] = law
    counters[TURN] = queues.parked[law]
    return True


@inlined
def give_way(front, placed, domain, arrangement, queues, counters, n_loc):
    """Where a particle found no place: turn to those of another region, or to the next gap."""
    if next_region(arrangement, queues, counters):
        return
    pass_on(front, queues, counters, n_loc // MOVES_ON + 1)
    begin_turn(front, placed, domain, arrangement, queues, counters, n_loc)
