"""The packing loop: the optimised advancing front method (paper, section 4)."""

from __future__ import annotations

import numpy as np

from grainfront.geometry.placing import place_polygon
from grainfront.jit import inlined, kernel
from grainfront.packing import PRUNED_FROM_N_LOC
from grainfront.packing.arranged import pass_over, put_off
from grainfront.packing.control import EFFORT_SUM, account, effort_now, spend
from grainfront.packing.exhaustive import choose_exhaustively
from grainfront.packing.front import bury, front_length
from grainfront.packing.grid import insert
from grainfront.packing.orientations import draw_orientations, turn_and_inflate
from grainfront.packing.search import choose_lowest
from grainfront.packing.settle import BOTH, join_obstacle, touched_of_pair
from grainfront.packing.state import Trial
from grainfront.packing.trials import RESOLVED, TOO_HIGH
from grainfront.packing.turns import (
    FINISHED,
    LAW,
    N_FAILED,
    N_PLACED,
    PLACED_IN_ROW,
    TOO_HIGH_IN_ROW,
    TURN,
    begin_turn,
    draw_next,
    end_row,
    give_way,
    look_ahead,
    take_from_waiting,
    turn_at_obstacle,
)

# With regions, particles may be placed so many circumradii above the rough centre. Higher up they
# would pile up along the edge of a region, and the front would leave that region behind, empty.
MOST_RISE = 1.0

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


@inlined
def take_place(
    front, placed, grid, domain, supply, laws, trials, control, arrangement, queues, counters, law,
    source, particle, x, y, i, k, angle,
):  # fmt: skip
    """Make the chosen trial a particle, and go on beside it."""
    if arrangement is not None:
        pass_over(front, queues, counters, i, k, y)
    at_right_wall = k == front_length(front) - 1
    number = counters[N_PLACED]
    trial = Trial(angle * particle[0], particle[0], angle, particle[1], particle[2])
    touched = touched_of_pair(domain.obstacles, front, placed, grid, domain, trials, trial, i, k)
    i, k = join_obstacle(domain.obstacles, front, placed, trial, number, x, y, i, k, touched)
    if control is not None:
        account(control, supply, front, placed, domain, source, number, x, y, i, k)
    store(placed, front, grid, domain, supply, laws, trials, source, law, number, x, y, angle, i, k)
    counters[N_PLACED] += 1
    counters[PLACED_IN_ROW] += 1
    queues.n_placed[law] += 1
    if touched != BOTH:
        turn_at_obstacle(front, placed, queues, counters, touched, number)
    elif at_right_wall:
        end_row(front, queues, counters)


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
    finds a place, the front moves on by a part of n_loc.
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
            give_way(front, placed, domain, arrangement, queues, counters, n_loc)
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
            if control is not None:
                control.tally[EFFORT_SUM] += effort
            take_place(
                front, placed, grid, domain, supply, laws, trials, control, arrangement, queues,
                counters, law, source, particle, x, y, i, k, angle,
            )  # fmt: skip
            take_from_waiting(queues, law, turn)
            begin_turn(front, placed, domain, arrangement, queues, counters, n_loc)
            continue
        counters[N_FAILED] += 1
        if arrangement is not None:
            put_off(queues, counters, particle[1])
        if status == TOO_HIGH:
            counters[TOO_HIGH_IN_ROW] += 1
            counters[TURN] += 1
        else:
            give_way(front, placed, domain, arrangement, queues, counters, n_loc)
