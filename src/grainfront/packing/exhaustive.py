"""Exhaustive choice: every trial orientation at every pair of the local front (paper, 4.2).

With one orientation and one pair this is the plain advancing front method.
"""

from __future__ import annotations

import math

from grainfront.jit import inlined
from grainfront.packing.arranged import admitted
from grainfront.packing.front import front_length, member_at
from grainfront.packing.obstacles import near_obstacles
from grainfront.packing.settle import OVERLAPPING, settle
from grainfront.packing.state import Trial
from grainfront.packing.trials import (
    BLOCKED,
    BYPASSED,
    NOTHING,
    RESOLVED,
    TOO_HIGH,
    contact_of_pair,
    overlapped,
)


@inlined
def no_trial_below(highest):
    """The outcome of no trial at all, (status, x, y, i, k, angle), that only lower ones beat."""
    return BLOCKED, math.inf, highest, -1, -1, -1


@inlined
def lower(best, trial):
    """The lower of two outcomes (status, x, y, i, k, angle): by height, then pair, then angle.

    A trial that found no place does not count, but that the top was the reason is remembered.
    """
    if trial[0] != RESOLVED:
        if trial[0] == TOO_HIGH and best[0] == BLOCKED:
            return (TOO_HIGH, best[1], best[2], best[3], best[4], best[5])
        return best
    if best[0] != RESOLVED or trial[2] < best[2]:
        return trial
    if trial[2] == best[2] and trial[3:] < best[3:]:
        return trial
    return best


@inlined
def resolve(front, placed, grid, domain, trials, trial, i, k):
    """Widen the pair (i, k) until the trial in contact with it overlaps nothing (paper, Fig. 9).

    Returns (RESOLVED, x, y, i, k), or BLOCKED where no place is found, TOO_HIGH where it would
    cross the top.
    """
    while True:
        a = member_at(front, i)
        b = member_at(front, k)
        if near_obstacles(domain.obstacles, placed, domain, trial.circumradius, a, b):
            status, x, y, position, _ = settle(
                domain.obstacles, front, placed, grid, domain, trials, trial, i, k, math.inf
            )
            if status != OVERLAPPING:
                return status, x, y, i, k
        else:
            found, x, y = contact_of_pair(placed, domain, trials, trial, a, b)
            if not found:
                return BLOCKED, 0.0, 0.0, i, k
            if y + trials.reach[trial.angle, 3] > domain.y_max + domain.tolerance:
                return TOO_HIGH, x, y, i, k
            position = overlapped(front, placed, grid, domain, trials, trial, i, k, x, y)
            if position == NOTHING:
                return RESOLVED, x, y, i, k
            if position == BYPASSED:
                return BLOCKED, 0.0, 0.0, i, k
        if position < i:
            i = position
        else:
            k = position


@inlined
def choose_exhaustively(
    front, placed, grid, domain, trials, arrangement, law, highest, particle, n_angle, n_loc
):
    """The resolved trial of least potential energy: (status, x, y, i, k, angle)."""
    count, circumradius, inradius = particle
    first = max(front.ends[0] - n_loc, 0)
    last = min(front.ends[0] + n_loc - 2, front_length(front) - 2)
    best = no_trial_below(highest)
    for i in range(first, last + 1):
        for angle in range(n_angle):
            trial = Trial(angle * count, count, angle, circumradius, inradius)
            outcome, x, y, at_i, at_k = resolve(
                front, placed, grid, domain, trials, trial, i, i + 1
            )
            if arrangement is not None:
                outcome = admitted(arrangement, law, highest, outcome, x, y)
            best = lower(best, (outcome, x, y, at_i, at_k, angle))
    return best
