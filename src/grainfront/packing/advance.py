"""The packing loop: the optimised advancing front method (paper, section 4)."""

from __future__ import annotations

import numpy as np

from grainfront.geometry.placing import place_polygon
from grainfront.jit import inlined, kernel
from grainfront.packing import PRUNED_FROM_N_LOC
from grainfront.packing.arranged import (
    law_at,
    nth_other_law,
    pass_over,
    put_off,
    rough_centre,
)
from grainfront.packing.control import EFFORT_SUM, account, effort_now, spend
from grainfront.packing.exhaustive import choose_exhaustively
from grainfront.packing.front import bury, front_length, member_at, move_gap, position_of
from grainfront.packing.grid import insert
from grainfront.packing.orientations import draw_orientations, turn_and_inflate
from grainfront.packing.search import choose_lowest
from grainfront.packing.settle import BOTH, FORMER, LATTER, join_obstacle, touched_of_pair
from grainfront.packing.state import RIGHT_WALL, Trial
from grainfront.packing.trials import RESOLVED, TOO_HIGH

# Particles that wait at the top for a lower place while others are tried: enough for one giant
# grain not to end the packing, few enough not to bend the size law.
WAITING_PLACES = 8

# With regions, particles may be placed so many circumradii above the rough centre. Higher up they
# would pile up along the edge of a region, and the front would leave that region behind, empty.
MOST_RISE = 1.0

# So many particles ahead, what a law's bins have so far counts for nothing.
FAR_AHEAD = 2**30

# What the loop remembers between calls; LAW and TURN: of whose waiting particles it tries which.
N_PLACED, N_TOO_LARGE, LAW, TURN, REGIONS_TRIED, N_FAILED = range(6)
PLACED_IN_ROW, TOO_HIGH_IN_ROW, FINISHED, EMPTY_ROWS = range(6, 10)
N_COUNTERS = 12
# Each failure moves the random offset of the next trial orientations on by the golden ratio, so
# that a particle that is tried again is tried in other orientations.
GOLDEN_RATIO = 0.6180339887498949


@inlined
def store(
    placed, front, grid, domain, supply, laws, trials, source, row, number, x, y, angle, i, k
):
    """Make the chosen trial, uninflated, a placed particle and a member of the front."""
    shape = supply.shape[source]
    size = supply.size[source]
    first = supply.hull_offsets[shape]
    count = supply.hull_offsets[shape + 1] - first
    start = placed.offsets[number]
    place_polygon(
        supply.hull_nodes, first, count, size, trials.orientation[angle], x, y, placed.nodes, start
    )
    placed.offsets[number + 1] = start + count
    placed.disc[number, 0] = x
    placed.disc[number, 1] = y
    placed.disc[number, 2] = supply.circumradius[shape] * size
    placed.disc[number, 3] = supply.inradius[shape] * size
    placed.orientation[number] = trials.orientation[angle]
    placed.source[number] = source
    laws.placed[row, trials.bin[angle]] += 1
    insert(grid, domain, number, x, y, placed.disc[number, 2])
    bury(front, i, k, number)


@inlined
def exhausted(queues, law):
    """Whether a law has no particle left that might find a place."""
    if queues.parked[law] == queues.waiting.shape[1]:
        return True
    drawn_out = queues.drawn[law] == queues.last[law]
    return drawn_out and queues.parked[law] == queues.n_waiting[law]


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
    elif not left or not parked_more:
        # once more in orientations that the laws do not lack yet: there may be room in just these;
        # and, unless it is the top that leaves none, in all of the laws: others may never fit
        counters[EMPTY_ROWS] += 1
        queues.parked[:] = 0
        if counters[EMPTY_ROWS] > (1 if counters[TOO_HIGH_IN_ROW] > 0 else 2):
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
        counters[N_TOO_LARGE] += 1
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
def choose(
    front, placed, grid, domain, trials, memory, control, arrangement, law, highest, particle,
    n_angle, n_loc,
):  # fmt: skip
    """The resolved trial of least potential energy: (status, x, y, i, k, angle).

    Searched for exhaustively without a memory, and where a controller makes the local front short.
    None is taken from above `highest`.
    """
    if memory is None:
        return choose_exhaustively(
            front, placed, grid, domain, trials, arrangement, law, highest, particle, n_angle, n_loc
        )
    if control is None:
        return choose_lowest(
            front, placed, grid, domain, trials, memory, arrangement, law, highest, particle,
            n_angle, n_loc,
        )  # fmt: skip
    if n_loc < PRUNED_FROM_N_LOC:
        return choose_exhaustively(
            front, placed, grid, domain, trials, arrangement, law, highest, particle, n_angle, n_loc
        )
    return choose_lowest(
        front, placed, grid, domain, trials, memory, arrangement, law, highest, particle,
        n_angle, n_loc,
    )  # fmt: skip


@kernel
def advance(
    front,
    placed,
    grid,
    domain,
    supply,
    laws,
    trials,
    memory,
    control,
    arrangement,
    queues,
    counters,
    n_angle,
    n_loc,
    limit,
):
    """Place particles until there are `limit` or the domain is full.

    Without a memory the choice is exhaustive, which with one orientation and one pair is the plain
    advancing front method. With a control, n_angle and n_loc are the most that it may spend. With
    an arrangement, particles are drawn by where the rough centre lies, the mean of the two chosen
    boundaries, and placed where their region is (paper, Pseudocode 7). Where no waiting particle
    finds a place, the front moves on by n_loc members: half of the next local front is new.
    """
    most_n_angle, most_n_loc = n_angle, n_loc
    places = queues.waiting.shape[1]
    narrowest = min(domain.x_max - domain.x_min, domain.y_max - domain.y_min)
    if counters[N_PLACED] == 0:
        begin_turn(front, placed, domain, arrangement, queues, counters, n_loc)
    while counters[N_PLACED] < limit and not counters[FINISHED]:
        law, turn = counters[LAW], counters[TURN]
        waiting = queues.n_waiting[law]
        if turn == waiting and (turn == places or queues.drawn[law] == queues.last[law]):
            if not next_region(arrangement, queues, counters):
                pass_on(front, queues, counters, n_loc)
                begin_turn(front, placed, domain, arrangement, queues, counters, n_loc)
            continue
        if turn == waiting and draw_next(queues, counters, law, supply, narrowest):
            continue
        source = queues.waiting[law, turn]
        offset = (supply.uniform[source] + GOLDEN_RATIO * counters[N_FAILED]) % 1.0
        if control is not None:
            effort = effort_now(control)
            n_angle, n_loc = spend(control, effort, source, offset, most_n_angle, most_n_loc)
        ahead = look_ahead(counters, laws)
        draw_orientations(laws, law, trials, n_angle, queues.n_placed[law] + ahead, offset)
        particle = turn_and_inflate(supply, source, domain.clearance, trials, n_angle)
        highest = np.inf
        if arrangement is not None:
            highest = queues.rough_centre[2] + MOST_RISE * particle[1]
        status, x, y, i, k, angle = choose(
            front, placed, grid, domain, trials, memory, control, arrangement, law, highest,
            particle, n_angle, n_loc,
        )  # fmt: skip
        if status == RESOLVED:
            if arrangement is not None:
                pass_over(front, queues, counters, i, k, y)
            at_right_wall = k == front_length(front) - 1
            number = counters[N_PLACED]
            trial = Trial(angle * particle[0], particle[0], angle, particle[1], particle[2])
            touched = touched_of_pair(
                domain.obstacles, front, placed, grid, domain, trials, trial, i, k
            )
            i, k = join_obstacle(
                domain.obstacles, front, placed, trial, number, x, y, i, k, touched
            )
            if control is not None:
                account(control, supply, front, placed, domain, source, number, x, y, i, k)
                control.tally[EFFORT_SUM] += effort
            store(
                placed, front, grid, domain, supply, laws, trials, source, law, number, x, y,
                angle, i, k,
            )  # fmt: skip
            counters[N_PLACED] += 1
            counters[PLACED_IN_ROW] += 1
            queues.n_placed[law] += 1
            take_from_waiting(queues, law, turn)
            if touched != BOTH:
                turn_at_obstacle(front, placed, queues, counters, touched, number)
            elif at_right_wall:
                end_row(front, queues, counters)
            begin_turn(front, placed, domain, arrangement, queues, counters, n_loc)
            continue
        counters[N_FAILED] += 1
        if arrangement is not None:
            put_off(queues, counters, particle[1])
        if status == TOO_HIGH:
            counters[TOO_HIGH_IN_ROW] += 1
            counters[TURN] += 1
        elif not next_region(arrangement, queues, counters):
            pass_on(front, queues, counters, n_loc)
            begin_turn(front, placed, domain, arrangement, queues, counters, n_loc)
