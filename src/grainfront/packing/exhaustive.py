"""Exhaustive choice: every trial orientation at every pair of the local front (paper, 4.2).

With one orientation and one pair this is the plain advancing front method.
"""

from __future__ import annotations

from grainfront.jit import inlined
from grainfront.packing.front import front_length
from grainfront.packing.state import Trial
from grainfront.packing.trials import BLOCKED, RESOLVED, TOO_HIGH, resolve


@inlined
def lower(y, i, k, angle, best_y, best_i, best_k, best_angle):
    """Whether a trial goes before the best so far: by height, then pair, then angle."""
    if y != best_y:
        return y < best_y
    if i != best_i:
        return i < best_i
    if k != best_k:
        return k < best_k
    return angle < best_angle


@inlined
def choose_exhaustively(front, placed, grid, domain, trials, particle, n_angle, n_loc):
    """The resolved trial of least potential energy: (status, x, y, i, k, angle)."""
    count, circumradius, inradius = particle
    first = max(front.ends[0] - n_loc, 0)
    last = min(front.ends[0] + n_loc - 2, front_length(front) - 2)
    status = BLOCKED
    best_x = best_y = 0.0
    best_i = best_k = best_angle = -1
    for i in range(first, last + 1):
        for angle in range(n_angle):
            trial = Trial(angle * count, count, angle, circumradius, inradius)
            outcome, x, y, at_i, at_k = resolve(
                front, placed, grid, domain, trials, trial, i, i + 1
            )
            if outcome == RESOLVED:
                if status != RESOLVED or lower(
                    y, at_i, at_k, angle, best_y, best_i, best_k, best_angle
                ):
                    status = RESOLVED
                    best_x, best_y, best_i, best_k, best_angle = x, y, at_i, at_k, angle
            elif outcome == TOO_HIGH and status == BLOCKED:
                status = TOO_HIGH
    return status, best_x, best_y, best_i, best_k, best_angle
