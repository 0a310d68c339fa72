"""The scout: a small polygon inside the new particle that bounds from below where it can get.

No orientation of the particle gets lower than the scout, resolved once at every pair, gets nearby.
The bound is not proven; the tests hold the choice it leads to against exhaustive search over many
thousand steps.
"""

from __future__ import annotations

import math

import numpy as np

from grainfront.jit import inlined
from grainfront.packing.front import front_length, member_at
from grainfront.packing.memory import SCOUT_MARGIN, WIDTHS, contact_from_tangent
from grainfront.packing.state import Trial
from grainfront.packing.trials import overlaps_member

# Corners of the scout: enough to fill most of the inscribed circle, few enough to be quick.
SCOUT_CORNERS = 12
# Neighbours along the front that the scout is kept off; it is too small to reach farther ones often,
# and missing one only makes the bound lower.
SCOUT_NEIGHBOURS = 3


@inlined
def shape_scout(trials, start, angle, inradius):
    """Write the scout, a regular polygon inscribed in the particle's inscribed circle."""
    for c in range(SCOUT_CORNERS):
        turn = 2.0 * math.pi * c / SCOUT_CORNERS
        trials.nodes[start + c, 0] = inradius * math.cos(turn)
        trials.nodes[start + c, 1] = inradius * math.sin(turn)
    trials.reach[angle, :] = inradius
    return Trial(start, SCOUT_CORNERS, angle, inradius, inradius * math.cos(math.pi / SCOUT_CORNERS))


@inlined
def send_scout(front, placed, domain, trials, scout, memory, base, i, k):
    """Resolve the scout from one pair: (found, y, i, k, falls to the left, falls to the right).

    Only near neighbours along the front are looked at, and no walls: where one is met, nothing is
    found.
    """
    last = front_length(front) - 1
    while True:
        row = i - base
        width = k - i - 1
        a = member_at(front, i)
        b = member_at(front, k)
        if a < 0 or b < 0 or row < 0 or width >= WIDTHS:
            return False, 0.0, i, k, False, False
        found, x, y, _, _, _, _, slope_a, slope_b = contact_from_tangent(
            placed, trials, scout, memory, a, b, row, width
        )
        if not found:
            return False, 0.0, i, k, False, False
        moved = False
        for d in range(1, SCOUT_NEIGHBOURS + 1):
            if i >= d and overlaps_member(
                placed, domain, trials, scout, member_at(front, i - d), x, y
            ):
                i -= d
                moved = True
                break
            if k + d <= last and overlaps_member(
                placed, domain, trials, scout, member_at(front, k + d), x, y
            ):
                k += d
                moved = True
                break
        if not moved:
            return True, y, i, k, slope_a > 0.0, slope_b > 0.0


@inlined
def bound_pairs(front, placed, domain, trials, scout, memory, base, first, last):
    """Lower bounds of what trials reach from each pair, from the scout's places nearby.

    The scout is also sent from the pairs just outside the local front, whose places bound its ends.
    """
    begin = max(first - SCOUT_MARGIN, 0)
    end = min(last + SCOUT_MARGIN, front_length(front) - 2)
    n_sent = end + 1 - begin
    for p in range(n_sent):
        memory.bound[p] = np.inf
        found, y, i, k, falls_left, falls_right = send_scout(
            front, placed, domain, trials, scout, memory, base, begin + p, begin + p + 1
        )
        memory.height[p] = y if found else -np.inf
        memory.reach[p, 0] = i - begin
        memory.reach[p, 1] = k - 1 - begin
        memory.falls[p, 0] = falls_left
        memory.falls[p, 1] = falls_right
    for p in range(n_sent):
        y = memory.height[p]
        i = memory.reach[p, 0]
        k = memory.reach[p, 1]
        if memory.falls[p, 0]:
            y = min(y, memory.height[i - 1] if i > 0 else -np.inf)
        if memory.falls[p, 1]:
            y = min(y, memory.height[k + 1] if k + 1 < n_sent else -np.inf)
        for u in range(max(i - SCOUT_MARGIN, 0), min(k + SCOUT_MARGIN, n_sent - 1) + 1):
            memory.bound[u] = min(memory.bound[u], y)
    for p in range(last + 1 - first):
        memory.bound[p] = memory.bound[p + first - begin]
