"""The packing loop: the optimised advancing front method (paper, section 4)."""

from __future__ import annotations

from grainfront.geometry.placing import place_polygon
from grainfront.jit import inlined, kernel
from grainfront.packing import PRUNED_FROM_N_LOC
from grainfront.packing.control import EFFORT_SUM, account, effort_now, spend
from grainfront.packing.exhaustive import choose_exhaustively
from grainfront.packing.front import bury, front_length, member_at, move_gap, position_of
from grainfront.packing.grid import insert
from grainfront.packing.obstacles import BOTH, FORMER, LATTER, join_obstacle, touched_of_pair
from grainfront.packing.orientations import draw_orientations, turn_and_inflate
from grainfront.packing.search import choose_lowest
from grainfront.packing.state import RIGHT_WALL, Trial
from grainfront.packing.trials import RESOLVED, TOO_HIGH

# Particles that wait at the top for a lower place while others are tried: enough for one giant
# grain not to end the packing, few enough not to bend the size law.
WAITING_PLACES = 8

# What the loop remembers between calls. PARKED of the waiting particles found no place in a whole
# row, without the top being the reason: too wide for the domain, say. They are left for later rows.
N_PLACED, N_DRAWN, N_TOO_LARGE, N_WAITING, TURN, PARKED, N_FAILED = range(7)
PLACED_IN_ROW, TOO_HIGH_IN_ROW, FINISHED, N_COUNTERS = range(7, 11)
# Each failure moves the random offset of the next trial orientations on by the golden ratio, so
# that a particle that is tried again is tried in other orientations.
GOLDEN_RATIO = 0.6180339887498949


@inlined
def store(placed, front, grid, domain, supply, law, trials, source, number, x, y, angle, i, k):
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
    law.placed[trials.bin[angle]] += 1
    insert(grid, domain, number, x, y, placed.disc[number, 2])
    bury(front, i, k, number)


@inlined
def end_row(front, counters, n_waiting_places, supply_left):
    """Begin a new row at the left wall, or finish where the last one placed nothing."""
    if counters[PLACED_IN_ROW] > 0:
        counters[PARKED] = 0
    elif counters[TOO_HIGH_IN_ROW] == 0 and counters[PARKED] < counters[N_WAITING]:
        counters[PARKED] += 1
    else:
        counters[FINISHED] = 1
    if counters[PARKED] == n_waiting_places or (
        counters[PARKED] == counters[N_WAITING] and not supply_left
    ):
        counters[FINISHED] = 1
    counters[PLACED_IN_ROW] = 0
    counters[TOO_HIGH_IN_ROW] = 0
    counters[TURN] = counters[PARKED]
    move_gap(front, 1)


@inlined
def pass_on(front, counters, n_waiting_places, supply_left):
    """Move on by one member of the front."""
    if front.member[front.ends[1]] == RIGHT_WALL:
        end_row(front, counters, n_waiting_places, supply_left)
    else:
        counters[TURN] = counters[PARKED]
        move_gap(front, front.ends[0] + 1)


@inlined
def turn_at_obstacle(front, placed, counters, n_waiting_places, supply_left, touched, particle):
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
        pass_on(front, counters, n_waiting_places, supply_left)


@inlined
def draw_next(waiting, counters, supply, narrowest):
    """Draw a particle to wait for its turn; true where it is too wide for the domain: left over."""
    source = counters[N_DRAWN]
    counters[N_DRAWN] += 1
    if supply.size[source] > narrowest:
        counters[N_TOO_LARGE] += 1
        return True
    waiting[counters[N_WAITING]] = source
    counters[N_WAITING] += 1
    return False


@inlined
def take_from_waiting(waiting, counters, turn):
    """Remove a particle that has been placed from those that wait."""
    counters[N_WAITING] -= 1
    for n in range(turn, counters[N_WAITING]):
        waiting[n] = waiting[n + 1]
    counters[TURN] = counters[PARKED]


@inlined
def choose_by_reach(front, placed, grid, domain, trials, memory, particle, n_angle, n_loc):
    """The resolved trial of least potential energy, pruned where the local front is long enough."""
    if n_loc >= PRUNED_FROM_N_LOC:
        return choose_lowest(front, placed, grid, domain, trials, memory, particle, n_angle, n_loc)
    return choose_exhaustively(front, placed, grid, domain, trials, particle, n_angle, n_loc)


@kernel
def advance(
    front,
    placed,
    grid,
    domain,
    supply,
    law,
    trials,
    memory,
    control,
    waiting,
    counters,
    n_angle,
    n_loc,
    limit,
):
    """Place particles until there are `limit` or the domain is full.

    Without a memory the choice is exhaustive, which with one orientation and one pair is the plain
    advancing front method. With a control, n_angle and n_loc are the most that it may spend.
    """
    most_n_angle, most_n_loc = n_angle, n_loc
    places = waiting.size
    narrowest = min(domain.x_max - domain.x_min, domain.y_max - domain.y_min)
    while counters[N_PLACED] < limit and not counters[FINISHED]:
        turn = counters[TURN]
        supply_left = counters[N_DRAWN] < supply.size.size
        if turn == counters[N_WAITING] and (turn == places or not supply_left):
            pass_on(front, counters, places, supply_left)
            continue
        if turn == counters[N_WAITING] and draw_next(waiting, counters, supply, narrowest):
            continue
        source = waiting[turn]
        offset = (supply.uniform[source] + GOLDEN_RATIO * counters[N_FAILED]) % 1.0
        if control is not None:
            effort = effort_now(control)
            n_angle, n_loc = spend(control, effort, source, offset, most_n_angle, most_n_loc)
        draw_orientations(law, trials, n_angle, counters[N_PLACED], offset)
        particle = turn_and_inflate(supply, source, domain.clearance, trials, n_angle)
        if memory is None:
            status, x, y, i, k, angle = choose_exhaustively(
                front, placed, grid, domain, trials, particle, n_angle, n_loc
            )
        elif control is None:
            status, x, y, i, k, angle = choose_lowest(
                front, placed, grid, domain, trials, memory, particle, n_angle, n_loc
            )
        else:
            status, x, y, i, k, angle = choose_by_reach(
                front, placed, grid, domain, trials, memory, particle, n_angle, n_loc
            )
        if status == RESOLVED:
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
                placed, front, grid, domain, supply, law, trials, source, number, x, y, angle, i, k
            )
            counters[N_PLACED] += 1
            counters[PLACED_IN_ROW] += 1
            take_from_waiting(waiting, counters, turn)
            if touched != BOTH:
                turn_at_obstacle(front, placed, counters, places, supply_left, touched, number)
            elif at_right_wall:
                end_row(front, counters, places, supply_left)
            continue
        counters[N_FAILED] += 1
        if status == TOO_HIGH:
            counters[TOO_HIGH_IN_ROW] += 1
            counters[TURN] += 1
        else:
            pass_on(front, counters, places, supply_left)
