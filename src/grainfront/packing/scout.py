"""The scout: a small polygon inside the new particle that bounds from below where it can get.

No orientation of the particle gets lower than the scout, resolved once at every pair, gets nearby.
The bound is not proven; the tests hold the choice it leads to against exhaustive search over many
thousand steps. Among obstacles 8 of 6,133 choices, of triangles mostly, were not the lowest.
"""

from __future__ import annotations

import math

import numpy as np

from grainfront.jit import inlined
from grainfront.packing.arranged import is_elsewhere
from grainfront.packing.front import front_length, member_at
from grainfront.packing.memory import WIDTHS, contact_from_tangent
from grainfront.packing.obstacles import near_obstacles
from grainfront.packing.settle import OVERLAPPING, settle
from grainfront.packing.state import Trial
from grainfront.packing.trials import BLOCKED, NOTHING, contact_of_pair, overlapped_neighbour

# Corners of the scout: enough to fill most of the inscribed circle, few enough to be quick.
SCOUT_CORNERS = 12
# A place of the scout bounds the pairs it covers, those that the places next to it cover, as a long
# particle may lean over a ridge to where the scout falls, and this many pairs more.
SCOUT_MARGIN = 2
# Pairs outside the local front from which scouts are sent too, as their places bound its ends.
SCOUT_OUTSIDE = 6


@inlined
def shape_scout(trials, start, angle, inradius):
    """Write the scout, a regular polygon inscribed in the particle's inscribed circle."""
    for c in range(SCOUT_CORNERS):
        turn = 2.0 * math.pi * c / SCOUT_CORNERS
        trials.nodes[start + c, 0] = inradius * math.cos(turn)
        trials.nodes[start + c, 1] = inradius * math.sin(turn)
    trials.reach[angle, :] = inradius
    return Trial(
        start, SCOUT_CORNERS, angle, inradius, inradius * math.cos(math.pi / SCOUT_CORNERS)
    )


@inlined
def rest_of_scout(obstacles, front, placed, grid, domain, trials, circumradius, scout, i, k):
    """Where the scout, sent from the pair (i, k), rests among obstacles: (x, y, i, k).

    Where it finds no place, y is ∞. A link of the front where one found none is closed to all that
    are no smaller: what is empty only shrinks.
    """
    if obstacles is None:
        return 0.0, -math.inf, i, k
    begin = i
    link = member_at(front, i)
    following = member_at(front, k)
    if obstacles.closed_to[link] == following and obstacles.closed_from[link] <= scout.inradius:
        return 0.0, math.inf, i, k
    while True:
        a = member_at(front, i)
        b = member_at(front, k)
        if near_obstacles(obstacles, placed, domain, circumradius, a, b):
            status, x, y, position, _ = settle(
                obstacles, front, placed, grid, domain, trials, scout, i, k, math.inf
            )
            if status == BLOCKED:
                obstacles.closed_to[link] = following
                obstacles.closed_from[link] = scout.inradius
                return x, math.inf, begin, begin + 1
            if status != OVERLAPPING:
                return x, y, i, k
        else:
            found, x, y = contact_of_pair(placed, domain, trials, scout, a, b)
            if not found:
                return x, -math.inf, i, k
            position = overlapped_neighbour(front, placed, domain, trials, scout, i, k, x, y)
            if position == NOTHING:
                return x, y, i, k
        if position < i:
            i = position
        else:
            k = position


@inlined
def send_scout(front, placed, domain, trials, scout, memory, arrangement, law, base, begin, p):
    """Resolve the scout from pair p and note its place: its height and the pairs it covers.

    Where a wall is met or the memory ends, the height is −∞: no bound. In the region of another law
    it is ∞: no place. A pair that another scout of this step came by leads to the same place.
    """
    i = begin + p
    k = i + 1
    memory.height[p] = -np.inf
    while True:
        row = i - base
        width = k - i - 1
        entry = np.uint64(max(row, 0) * WIDTHS + width)
        a = member_at(front, i)
        b = member_at(front, k)
        if a < 0 or b < 0 or row < 0 or width >= WIDTHS:
            break
        if memory.scouted[entry, 0] == memory.step[0]:
            same = memory.scouted[entry, 1]
            memory.height[p] = memory.height[same]
            for end in range(2):
                memory.covers[p, end] = memory.covers[same, end]
            return
        memory.scouted[entry, 0] = memory.step[0]
        memory.scouted[entry, 1] = p
        found, x, y, _, _, _, _ = contact_from_tangent(placed, trials, scout, memory, a, b, entry)
        if not found:
            break
        position = overlapped_neighbour(front, placed, domain, trials, scout, i, k, x, y)
        if position == NOTHING:
            memory.height[p] = y
            if arrangement is not None and is_elsewhere(arrangement, law, x, y):
                memory.height[p] = np.inf
            break
        if position < i:
            i = position
        else:
            k = position
    memory.covers[p, 0] = i - begin
    memory.covers[p, 1] = k - 1 - begin


@inlined
def bound_pairs(
    front, placed, grid, domain, trials, circumradius, scout, memory, arrangement, law, base, first,
    last,
):  # fmt: skip
    """Lower bounds of what trials reach from each pair, from the scout's places nearby."""
    begin = max(first - SCOUT_OUTSIDE, 0)
    end = min(last + SCOUT_OUTSIDE, front_length(front) - 2)
    n_sent = end + 1 - begin
    for p in range(n_sent):
        memory.bound[p] = np.inf
        if domain.obstacles is None:
            send_scout(
                front, placed, domain, trials, scout, memory, arrangement, law, base, begin, p
            )
            continue
        x, y, i, k = rest_of_scout(
            domain.obstacles, front, placed, grid, domain, trials, circumradius, scout,
            begin + p, begin + p + 1,
        )  # fmt: skip
        if arrangement is not None and math.isfinite(y) and is_elsewhere(arrangement, law, x, y):
            y = math.inf
        memory.height[p] = y
        memory.covers[p, 0] = i - begin
        memory.covers[p, 1] = k - 1 - begin
    # among obstacles a front may end anywhere: scouts beyond the local front are not waited for
    beyond = -np.inf if domain.obstacles is None else np.inf
    for p in range(n_sent):
        left = memory.covers[p, 0]
        right = memory.covers[p, 1]
        y = memory.height[p]
        y = min(y, memory.height[left - 1] if left > 0 else beyond)
        y = min(y, memory.height[right + 1] if right + 1 < n_sent else beyond)
        for u in range(max(left - SCOUT_MARGIN, 0), min(right + SCOUT_MARGIN, n_sent - 1) + 1):
            memory.bound[u] = min(memory.bound[u], y)
    for p in range(last + 1 - first):
        memory.bound[p] = memory.bound[p + first - begin]
