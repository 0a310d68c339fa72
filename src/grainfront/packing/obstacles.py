"""Trials among obstacles: a particle slides along either partner until it touches an obstacle.

A domain of any shape is its bounding rectangle with obstacles: convex pieces of what is outside.
They are particles that never join the front. Where a particle in contact with the pair (i, k) of
the front would overlap one, or no such contact exists, an obstacle takes the place of either
partner; the particle joins the front between i and k all the same.
"""

from __future__ import annotations

import math

from grainfront.geometry.support import at
from grainfront.jit import inlined, kernel
from grainfront.packing.front import member_at
from grainfront.packing.trials import (
    BLOCKED,
    BYPASSED,
    NOTHING,
    RESOLVED,
    TOO_HIGH,
    contact_of_pair,
    overlapped,
    overlaps_member,
    overlaps_particle,
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
def cells_about(obstacles, domain, x, y, reach):
    """First and last column and row of the cells within a square about a point."""
    left = max(int((x - reach - domain.x_min) / obstacles.cell), 0)
    right = min(int((x + reach - domain.x_min) / obstacles.cell), obstacles.columns - 1)
    bottom = max(int((y - reach - domain.y_min) / obstacles.cell), 0)
    top = min(int((y + reach - domain.y_min) / obstacles.cell), obstacles.rows - 1)
    return left, right, bottom, top


@inlined
def near_member(obstacles, placed, domain, circumradius, member):
    """Whether a particle of a circumradius that touches the member may touch an obstacle too."""
    reach = placed.disc[member, 2] + 2.0 * circumradius
    left, right, bottom, top = cells_about(
        obstacles, domain, placed.disc[member, 0], placed.disc[member, 1], reach
    )
    for row in range(bottom, top + 1):
        first = row * obstacles.columns
        if obstacles.start[first + left] < obstacles.start[first + right + 1]:
            return True
    return False


@inlined
def near_obstacles(obstacles, placed, domain, circumradius, a, b):
    """Whether a particle that touches the member a or b may touch an obstacle too."""
    if obstacles is None:
        return False
    if a < 0 and b < 0:
        return True
    if a >= 0 and near_member(obstacles, placed, domain, circumradius, a):
        return True
    return b >= 0 and near_member(obstacles, placed, domain, circumradius, b)


@inlined
def leaves_rectangle(domain, trials, trial, x, y):
    """Whether the trial at (x, y) crosses a side of the bounding rectangle."""
    reach = trials.reach
    return (
        x - reach[trial.angle, 0] < domain.x_min - domain.tolerance
        or y - reach[trial.angle, 1] < domain.y_min - domain.tolerance
        or x + reach[trial.angle, 2] > domain.x_max + domain.tolerance
        or y + reach[trial.angle, 3] > domain.y_max + domain.tolerance
    )


@inlined
def overlapped_obstacle(obstacles, placed, domain, trials, trial, x, y):
    """The first obstacle that the trial at (x, y) overlaps, or NOTHING.

    BYPASSED where it leaves the bounding rectangle.
    """
    if leaves_rectangle(domain, trials, trial, x, y):
        return BYPASSED
    left, right, bottom, top = cells_about(obstacles, domain, x, y, trial.circumradius)
    for row in range(bottom, top + 1):
        first = row * obstacles.columns
        for n in range(obstacles.start[first + left], obstacles.start[first + right + 1]):
            q = obstacles.first + obstacles.item[n]
            if overlaps_particle(placed, domain, trials, trial, q, x, y):
                return q
    return NOTHING


@inlined
def from_nearest(placed, q, x, y):
    """Distance squared and rise from the nearest point of an obstacle's boundary to a point."""
    nodes = placed.nodes
    before = placed.offsets[q + 1] - 1
    nearest = math.inf
    rise = 0.0
    for node in range(placed.offsets[q], placed.offsets[q + 1]):
        along_x = at(nodes, node, 0) - at(nodes, before, 0)
        along_y = at(nodes, node, 1) - at(nodes, before, 1)
        off_x = x - at(nodes, before, 0)
        off_y = y - at(nodes, before, 1)
        share = (off_x * along_x + off_y * along_y) / (along_x * along_x + along_y * along_y)
        share = min(max(share, 0.0), 1.0)
        off_x -= share * along_x
        off_y -= share * along_y
        squared = off_x * off_x + off_y * off_y
        if squared < nearest:
            nearest = squared
            rise = off_y
        before = node
    return nearest, rise


@inlined
def newly_within_reach(obstacles, placed, o, x, y, reach):
    """Whether an obstacle comes near a point, the first time that this search meets it."""
    if obstacles.met[o] == obstacles.search[0]:
        return False
    obstacles.met[o] = obstacles.search[0]
    if (
        at(obstacles.box, o, 0) > x + reach
        or at(obstacles.box, o, 1) > y + reach
        or at(obstacles.box, o, 2) < x - reach
        or at(obstacles.box, o, 3) < y - reach
    ):
        return False
    return from_nearest(placed, obstacles.first + o, x, y)[0] < reach * reach


@inlined
def hangs_below(placed, q, x, y):
    """Whether a centre (x, y) lies below the obstacle q rather than beside or above it."""
    squared, rise = from_nearest(placed, q, x, y)
    return rise < 0.0 and rise * rise > CEILING * CEILING * squared


@inlined
def touch_obstacle(obstacles, front, placed, grid, domain, trials, trial, i, k, side, q, best):
    """The lower of `best` and the contact with obstacle q and the member i or k, if any."""
    a, b = member_at(front, i), member_at(front, k)
    first, second, other = (a, q, b) if side == FORMER else (q, b, a)
    found, x, y = contact_of_pair(placed, domain, trials, trial, first, second)
    if not found or y >= best[2] or hangs_below(placed, q, x, y):
        return best
    if overlapped_obstacle(obstacles, placed, domain, trials, trial, x, y) != NOTHING:
        return best
    if overlaps_member(placed, domain, trials, trial, other, x, y):
        return best
    position = overlapped(front, placed, grid, domain, trials, trial, i, k, x, y)
    if position == BYPASSED:
        return best
    return (RESOLVED if position == NOTHING else OVERLAPPING), x, y, position, side


@kernel
def settle(obstacles, front, placed, grid, domain, trials, trial, i, k, ceiling):
    """The place of a trial between the members i and k: (status, x, y, position, side).

    The contact with both, if no obstacle is in the way; else the lowest contact with one of them
    and an obstacle that is below `ceiling` and overlaps nothing but members beyond the pair: it is
    RESOLVED or, with the position of the nearest of these members, OVERLAPPING.
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
        about_x, about_y = placed.disc[partner, 0], placed.disc[partner, 1]
        if about_y - placed.disc[partner, 2] - trial.circumradius >= best[2]:
            continue
        obstacles.search[0] += 1
        reach = placed.disc[partner, 2] + 2.0 * trial.circumradius
        left, right, bottom, top = cells_about(obstacles, domain, about_x, about_y, reach)
        for row in range(bottom, top + 1):
            first = row * obstacles.columns
            for n in range(obstacles.start[first + left], obstacles.start[first + right + 1]):
                o = obstacles.item[n]
                if newly_within_reach(obstacles, placed, o, about_x, about_y, reach):
                    best = touch_obstacle(
                        obstacles, front, placed, grid, domain, trials, trial, i, k, side,
                        obstacles.first + o, best,
                    )  # fmt: skip
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
def join_obstacle(obstacles, front, placed, trial, number, x, y, i, k, touched):
    """Note which links of the front an obstacle splits; the pair that the new particle joins."""
    if obstacles is None:
        return i, k
    if touched != BOTH:
        i, k = close_off(obstacles, front, placed, trial, x, y, i, k, touched)
    a = member_at(front, i)
    if a >= 0:
        obstacles.splits[a] = touched == LATTER
    obstacles.splits[number] = touched == FORMER
    return i, k
