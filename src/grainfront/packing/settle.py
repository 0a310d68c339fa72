"""Trials among obstacles: a particle slides along either partner until it touches an obstacle.

Where a particle in contact with the pair (i, k) of the front would overlap an obstacle, or no such
contact exists, an obstacle takes the place of either partner; the particle joins the front between
i and k all the same.
"""

from __future__ import annotations

import math

from grainfront.jit import inlined, kernel
from grainfront.packing.front import member_at
from grainfront.packing.obstacles import (
    from_nearest,
    list_reached,
    near_obstacles,
    overlapped_obstacle,
    overlaps_obstacle,
)
from grainfront.packing.trials import (
    BLOCKED,
    BYPASSED,
    NOTHING,
    RESOLVED,
    TOO_HIGH,
    contact_at_tangent,
    contact_of_pair,
    overlapped,
    overlaps_member,
)

# A trial that touches an obstacle, but overlaps a member of the front: the pair is to be widened.
OVERLAPPING = 2
# A ceiling, as the top of a rectangle, is nothing to lean on: an obstacle from whose nearest point
# the centre of the trial lies more steeply down than this sine says.
CEILING = 0.7
# A particle that touches an obstacle closes off those between itself and the next place where the
# front meets an obstacle, if they are this close: so many of its circumradii from their circles.
CLOSED_OFF = 2.0
# Whom of its pair a particle touches: both, or an obstacle and the former or the latter.
BOTH, FORMER, LATTER = range(3)


@inlined
def hangs_below(placed, q, x, y):
    """Whether a centre (x, y) lies below the obstacle q rather than beside or above it."""
    squared, rise = from_nearest(placed, q, x, y)
    return rise < 0.0 and rise * rise > CEILING * CEILING * squared


@inlined
def to_undercut(best, ceiling):
    """Below which height the next place is of use: a resolved one is better than any other."""
    return best[2] if best[0] == RESOLVED else ceiling


@inlined
def touch_obstacle(
    obstacles, front, placed, grid, domain, trials, trial, i, k, side, n, ceiling, best
):
    """The better of `best` and the contact with one of the members i and k and an obstacle.

    It is the n-th of those listed, and the member is on the given side.
    """
    a, b = member_at(front, i), member_at(front, k)
    q = obstacles.reached.obstacle[n]
    tangent = obstacles.reached.tangent[n, side - FORMER]
    if side == FORMER:
        found, x, y = contact_at_tangent(placed, trials, trial, a, q, tangent)
    else:
        found, x, y = contact_at_tangent(placed, trials, trial, q, b, tangent)
    if not found or y >= to_undercut(best, ceiling) or hangs_below(placed, q, x, y):
        return best
    if overlaps_obstacle(obstacles, placed, domain, trials, trial, x, y):
        return best
    if overlaps_member(placed, domain, trials, trial, b if side == FORMER else a, x, y):
        return best
    position = overlapped(front, placed, grid, domain, trials, trial, i, k, x, y)
    if position == NOTHING:
        return RESOLVED, x, y, position, side
    if position == BYPASSED or best[0] == RESOLVED or y >= best[2]:
        return best
    return OVERLAPPING, x, y, position, side


@kernel
def settle(obstacles, front, placed, grid, domain, trials, trial, i, k, ceiling):
    """The place of a trial between the members i and k: (status, x, y, position, side).

    The contact with both, if no obstacle is in the way; else the lowest contact with one of them
    and an obstacle that is below `ceiling` and overlaps nothing (RESOLVED) or, where there is none,
    nothing but members beyond the pair (OVERLAPPING, with the position of the nearest).
    """
    nowhere = BLOCKED, 0.0, ceiling, NOTHING, BOTH
    if obstacles is None:
        return nowhere
    found, x, y = contact_of_pair(
        placed, domain, trials, trial, member_at(front, i), member_at(front, k)
    )
    if found:
        if y + trials.reach[trial.angle, 3] > domain.y_max + domain.tolerance:
            return TOO_HIGH, x, y, NOTHING, BOTH
        q = overlapped_obstacle(obstacles, placed, domain, trials, trial, x, y)
        if q == NOTHING:
            position = overlapped(front, placed, grid, domain, trials, trial, i, k, x, y)
            if y > ceiling or position == BYPASSED:
                return nowhere
            return (RESOLVED if position == NOTHING else OVERLAPPING), x, y, position, BOTH
        if q >= 0 and hangs_below(placed, q, x, y):
            return TOO_HIGH, x, y, NOTHING, BOTH
    best = nowhere
    for side in range(FORMER, LATTER + 1):
        partner = member_at(front, i if side == FORMER else k)
        if partner < 0:
            continue
        y, radius = placed.disc[partner, 1], placed.disc[partner, 2]
        if y - radius - trial.circumradius >= to_undercut(best, ceiling):
            continue
        reach = radius + 2.0 * trial.circumradius
        start, end = list_reached(obstacles, placed, domain, partner, reach)
        for n in range(start, end):
            best = touch_obstacle(
                obstacles, front, placed, grid, domain, trials, trial, i, k, side, n, ceiling, best
            )
    return best


@inlined
def touched_of_pair(obstacles, front, placed, grid, domain, trials, trial, i, k):
    """Whom of its pair a trial that has found its place touches: BOTH, FORMER or LATTER."""
    if obstacles is None:
        return BOTH
    if not near_obstacles(
        obstacles, placed, domain, trial.circumradius, member_at(front, i), member_at(front, k)
    ):
        return BOTH
    return settle(obstacles, front, placed, grid, domain, trials, trial, i, k, math.inf)[4]


@inlined
def close_to(placed, member, x, y, reach):
    """Whether a point is within `reach` of the circle of a particle."""
    far = placed.disc[member, 2] + reach
    return (placed.disc[member, 0] - x) ** 2 + (placed.disc[member, 1] - y) ** 2 < far * far


@inlined
def close_off(obstacles, front, placed, trial, x, y, i, k, touched):
    """The pair that a particle at (x, y) on the pair (i, k) joins: it may close off more members.

    On the side of the obstacle it touches, these are those close to it up to where the front meets
    an obstacle; there, a wall would have been the partner.
    """
    reach = CLOSED_OFF * trial.circumradius
    position = k if touched == FORMER else i
    step = 1 if touched == FORMER else -1
    while True:
        member = member_at(front, position)
        if member < 0 or not close_to(placed, member, x, y, reach):
            return i, k
        beyond = member_at(front, position + step)
        owner = member if touched == FORMER else beyond
        position += step
        if beyond < 0 or obstacles.splits[owner]:
            return (i, position) if touched == FORMER else (position, k)


@inlined
def is_passed_below(front, placed, y, i, k):
    """Whether a member between the positions i and k lies higher than y."""
    for position in range(i + 1, k):
        member = member_at(front, position)
        if member >= 0 and placed.disc[member, 1] > y:
            return True
    return False


@inlined
def join_obstacle(obstacles, front, placed, trial, number, x, y, i, k, touched):
    """Note which links of the front an obstacle splits; the pair that the new particle joins."""
    if obstacles is None:
        return i, k
    if is_passed_below(front, placed, y, i, k):
        if touched == LATTER:
            i = k - 1
        else:
            k = i + 1
    elif touched != BOTH:
        first, last = close_off(obstacles, front, placed, trial, x, y, i, k, touched)
        if not is_passed_below(front, placed, y, first, last):
            i, k = first, last
    a = member_at(front, i)
    if a >= 0:
        obstacles.splits[a] = touched == LATTER
    obstacles.splits[number] = touched == FORMER
    return i, k
