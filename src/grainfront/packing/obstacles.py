"""Obstacles, and where they are: cells, overlaps, and lists of those within reach of a member.

A domain of any shape is its bounding rectangle with obstacles: convex pieces of what is outside.
They are particles that never join the front.
"""

from __future__ import annotations

import math

from grainfront.geometry.support import at
from grainfront.jit import inlined, kernel
from grainfront.packing.trials import BYPASSED, NOTHING, overlaps_particle, tangent_of_pair


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
def overlaps_obstacle(obstacles, placed, domain, trials, trial, x, y):
    """Whether the trial at (x, y) overlaps an obstacle or leaves the bounding rectangle.

    The obstacle that was overlapped last is tried first: mostly it is that one again.
    """
    q = obstacles.overlapped[0]
    if q >= 0 and overlaps_particle(placed, domain, trials, trial, q, x, y):
        return True
    q = overlapped_obstacle(obstacles, placed, domain, trials, trial, x, y)
    if q >= 0:
        obstacles.overlapped[0] = q
    return q != NOTHING


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
def comes_within(obstacles, placed, o, x, y, reach):
    """Whether an obstacle comes nearer to a point than `reach`."""
    if (
        at(obstacles.box, o, 0) > x + reach
        or at(obstacles.box, o, 1) > y + reach
        or at(obstacles.box, o, 2) < x - reach
        or at(obstacles.box, o, 3) < y - reach
    ):
        return False
    return from_nearest(placed, obstacles.first + o, x, y)[0] < reach * reach


@kernel
def list_reached(obstacles, placed, domain, member, reach):
    """List the obstacles within reach of a member's centre, once: (first, end) of the list."""
    reached = obstacles.reached
    slot = member % reached.member.size
    if reached.member[slot] == member and reached.reach[slot] == reach:
        return reached.start[slot], reached.end[slot]
    start = reached.filled[0]
    if start + obstacles.box.shape[0] > reached.obstacle.size:
        reached.member[:] = -1
        start = 0
    end = start
    obstacles.search[0] += 1
    x, y = placed.disc[member, 0], placed.disc[member, 1]
    left, right, bottom, top = cells_about(obstacles, domain, x, y, reach)
    for row in range(bottom, top + 1):
        first = row * obstacles.columns
        for n in range(obstacles.start[first + left], obstacles.start[first + right + 1]):
            o = obstacles.item[n]
            if obstacles.met[o] == obstacles.search[0]:
                continue
            obstacles.met[o] = obstacles.search[0]
            if comes_within(obstacles, placed, o, x, y, reach):
                q = obstacles.first + o
                reached.obstacle[end] = q
                reached.tangent[end, 0] = tangent_of_pair(placed, member, q)
                reached.tangent[end, 1] = tangent_of_pair(placed, q, member)
                end += 1
    reached.filled[0] = end
    reached.member[slot] = member
    reached.reach[slot] = reach
    reached.start[slot] = start
    reached.end[slot] = end
    return start, end
