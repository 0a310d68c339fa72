"""Where a front begins that has no flat bottom: the lowest place that touches two obstacles.

The front reaches whatever is connected to its first particle as wide as the particles are. What it
does not reach, another part of the domain or one beyond a neck, gets a front of its own, which
begins once the one before it has come to its end.
"""

from __future__ import annotations

import math

import numpy as np

from grainfront.geometry.signed_distance import ray_parity
from grainfront.jit import inlined, kernel
from grainfront.packing.advance import GOLDEN_RATIO, store
from grainfront.packing.arranged import admitted
from grainfront.packing.obstacles import overlaps_obstacle
from grainfront.packing.orientations import draw_orientations, turn_and_inflate
from grainfront.packing.state import LEFT_WALL, RIGHT_WALL, Trial
from grainfront.packing.trials import RESOLVED, contact_of_pair, overlaps_particle
from grainfront.packing.turns import (
    EMPTY_ROWS,
    FAR_AHEAD,
    FINISHED,
    N_PLACED,
    PLACED_IN_ROW,
    TOO_HIGH_IN_ROW,
    begin_turn,
    draw_next,
    take_from_waiting,
)


@inlined
def may_touch_both(box, o, p, circumradius, ceiling):
    """Whether a particle whose centre is below a ceiling may touch both obstacles."""
    diameter = 2.0 * circumradius
    return (
        box[o, 0] <= box[p, 2] + diameter
        and box[p, 0] <= box[o, 2] + diameter
        and box[o, 1] <= box[p, 3] + diameter
        and box[p, 1] <= box[o, 3] + diameter
        and max(box[o, 1], box[p, 1]) - circumradius < ceiling
    )


@inlined
def empty_about(obstacles, placed, n_placed, domain, trials, trial, x, y):
    """Whether no particle is near a trial at (x, y), as near as a front may begin to another."""
    reach = obstacles.empty_about * trial.circumradius
    for q in range(n_placed):
        far = reach + placed.disc[q, 2]
        if (placed.disc[q, 0] - x) ** 2 + (placed.disc[q, 1] - y) ** 2 < far * far:
            return False
        if overlaps_particle(placed, domain, trials, trial, q, x, y):
            return False
    return True


@inlined
def note_crowded(obstacles, placed, n_placed, circumradius, inradius, beside):
    """Note the obstacles beside which no front can begin: one particle is near all along them.

    Those not `beside` the place where it is to begin are out of question.
    """
    reach = obstacles.empty_about * circumradius
    for o in range(obstacles.box.shape[0]):
        obstacles.crowded[o] = not beside[o]
        if obstacles.crowded[o]:
            continue
        x = 0.5 * (obstacles.box[o, 0] + obstacles.box[o, 2])
        y = 0.5 * (obstacles.box[o, 1] + obstacles.box[o, 3])
        half = 0.5 * math.hypot(
            obstacles.box[o, 2] - obstacles.box[o, 0], obstacles.box[o, 3] - obstacles.box[o, 1]
        )
        for q in range(n_placed):
            near = max(reach + placed.disc[q, 2], inradius + placed.disc[q, 3])
            near -= half + circumradius
            if near > 0.0 and (
                (placed.disc[q, 0] - x) ** 2 + (placed.disc[q, 1] - y) ** 2 < near * near
            ):
                obstacles.crowded[o] = True
                break


@inlined
def lowest_start(
    obstacles, placed, n_placed, domain, trials, arrangement, law, particle, n_angle, ceiling,
    within, beside, contacts, most,
):  # fmt: skip
    """The lowest place below a ceiling that touches two obstacles where all is empty.

    Returns (found, x, y, angle); see `start_front` for the last four.
    """
    count, circumradius, inradius = particle
    best = False, 0.0, ceiling, 0
    last = contacts[0] + most
    note_crowded(obstacles, placed, n_placed, circumradius, inradius, beside)
    for o in range(obstacles.box.shape[0]):
        if obstacles.crowded[o]:
            continue
        for n in range(obstacles.beside_start[o], obstacles.beside_start[o + 1]):
            p = obstacles.beside[n]
            if obstacles.crowded[p]:
                continue
            if not may_touch_both(obstacles.box, o, p, circumradius, best[2]):
                continue
            if contacts[0] >= last:
                return best
            for angle in range(n_angle):
                contacts[0] += 1
                trial = Trial(angle * count, count, angle, circumradius, inradius)
                found, x, y = contact_of_pair(
                    placed, domain, trials, trial, obstacles.first + o, obstacles.first + p
                )
                if not found or y >= best[2]:
                    continue
                if within.shape[0] > 0 and not ray_parity(within, 0, within.shape[0], x, y):
                    continue
                if arrangement is not None and (
                    admitted(arrangement, law, math.inf, RESOLVED, x, y) != RESOLVED
                ):
                    continue
                if overlaps_obstacle(obstacles, placed, domain, trials, trial, x, y):
                    continue
                if empty_about(obstacles, placed, n_placed, domain, trials, trial, x, y):
                    best = True, x, y, angle
    return best


@inlined
def empty_front(front, n_placed):
    """Bury all particles, and let the walls alone make the front."""
    for q in range(n_placed):
        front.slot[q] = -1
    front.member[0] = LEFT_WALL
    front.ends[0] = 1
    front.ends[1] = front.member.size - 1
    front.member[front.ends[1]] = RIGHT_WALL


@inlined
def start_of_law(
    obstacles, placed, domain, supply, laws, trials, arrangement, queues, counters, n_angle, law,
    ceiling, within, beside, contacts, most, attempt,
):  # fmt: skip
    """The first of the waiting particles of a law that finds a place to start: (turn, x, y, angle).

    None does where turn is −1; the trials are those of the last particle tried.
    """
    narrowest = min(domain.x_max - domain.x_min, domain.y_max - domain.y_min)
    turn = 0
    while turn < queues.waiting.shape[1]:
        if turn == queues.n_waiting[law]:
            if queues.drawn[law] == queues.last[law]:
                break
            if draw_next(queues, counters, law, supply, narrowest):
                continue
        source = queues.waiting[law, turn]
        if obstacles.rejected[source]:
            turn += 1
            continue
        offset = (supply.uniform[source] + GOLDEN_RATIO * attempt) % 1.0
        ahead = FAR_AHEAD if attempt > 0 else 0
        draw_orientations(laws, law, trials, n_angle, queues.n_placed[law] + ahead, offset)
        particle = turn_and_inflate(supply, source, domain.clearance, trials, n_angle)
        found, x, y, angle = lowest_start(
            obstacles, placed, counters[N_PLACED], domain, trials, arrangement, law, particle,
            n_angle, ceiling, within, beside, contacts, most,
        )  # fmt: skip
        if found:
            return turn, x, y, angle
        # the domain fills up, so that what found no place will find none later
        obstacles.rejected[source] = ceiling == math.inf
        turn += 1
    return -1, 0.0, ceiling, 0


@kernel
def start_front(
    obstacles, front, placed, grid, domain, supply, laws, trials, arrangement, queues, counters,
    n_angle, n_loc, limit, within, beside, contacts, most, attempt,
):  # fmt: skip
    """Where the last front has come to its end, begin another one; whether there was a place.

    It begins with the first of the waiting particles that finds one; of those of several laws, the
    lowest. `within`, (n, 4), are the edges of the polygon that it must begin in, or none; `beside`,
    (n_obstacles,), tells which of the obstacles it may touch; `contacts`, (1,), counts those tried,
    about `most` for each particle.
    Further attempts are made in other orientations of the laws.
    """
    if not counters[FINISHED] or counters[N_PLACED] >= limit:
        return False
    n_placed = counters[N_PLACED]
    chosen = 0
    lowest = math.inf
    if arrangement is not None:
        for law in range(queues.last.size):
            turn, x, y, angle = start_of_law(
                obstacles, placed, domain, supply, laws, trials, arrangement, queues, counters,
                n_angle, law, lowest, within, beside, contacts, most, attempt,
            )  # fmt: skip
            if turn >= 0:
                chosen = law
                lowest = y
    # with several laws once more, as the trials are those of another one by now
    turn, x, y, angle = start_of_law(
        obstacles, placed, domain, supply, laws, trials, arrangement, queues, counters, n_angle,
        chosen, np.nextafter(lowest, math.inf), within, beside, contacts, most, attempt,
    )  # fmt: skip
    if turn < 0:
        return False
    source = queues.waiting[chosen, turn]
    empty_front(front, n_placed)
    store(
        placed, front, grid, domain, supply, laws, trials, source, chosen, n_placed, x, y, angle,
        0, 1,
    )  # fmt: skip
    counters[N_PLACED] += 1
    counters[PLACED_IN_ROW] = 1
    counters[TOO_HIGH_IN_ROW] = 0
    counters[EMPTY_ROWS] = 0
    counters[FINISHED] = 0
    queues.n_placed[chosen] += 1
    queues.parked[:] = 0
    take_from_waiting(queues, chosen, turn)
    begin_turn(front, placed, domain, arrangement, queues, counters, n_loc)
    return True
