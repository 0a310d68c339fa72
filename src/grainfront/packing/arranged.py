"""Which particles go where: regions with laws of their own (paper, section 4.2, Pseudocode 7)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grainfront.geometry.regions import RegionMap, region_of, stratum_in
from grainfront.jit import inlined
from grainfront.packing.front import front_length, member_at, position_of
from grainfront.packing.state import BOTTOM_WALL, LEFT_WALL
from grainfront.packing.trials import BLOCKED, RESOLVED

# Members of the pair on which the next particle is expected to rest, among the loop's counters.
REST_BACK, REST_AHEAD = 10, 11
# Not the number of any member of the front.
NO_MEMBER = -9
# Three equal discs that touch: so high, in two radii, lies the third above the line of two others.
SIN_60 = math.sqrt(0.75)


class Arrangement(NamedTuple):
    """Regions, numbered as they are asked for; the rest of the domain comes last.

    A law stands for a stratum of a region; `first_law` counts them through all regions.
    """

    regions: RegionMap
    first_law: np.ndarray  # (n_regions + 2,) first law of each region and of the rest; their number
    region_of_law: np.ndarray  # (n_laws,)


def arrangement_of(regions: RegionMap, region_of_law: np.ndarray) -> Arrangement:
    """The arrangement of laws that are sorted by region, `region_of_law` (n_laws,)."""
    first_law = np.concatenate([regions.first, [region_of_law.size]])
    return Arrangement(regions, first_law.astype(np.int64), region_of_law.astype(np.int64))


@inlined
def region_at(arrangement, x, y):
    """The region that holds a point, the rest of the domain being the last."""
    region = region_of(arrangement.regions, x, y)
    return region if region >= 0 else arrangement.first_law.size - 2


@inlined
def law_in(arrangement, region, x, y):
    """The law of a region at a point, or at the end of its grade that is nearest."""
    if region == arrangement.first_law.size - 2:
        return arrangement.first_law[region]
    return stratum_in(arrangement.regions, region, x, y)


@inlined
def law_at(arrangement, x, y):
    """The law at a point."""
    return law_in(arrangement, region_at(arrangement, x, y), x, y)


@inlined
def nth_other_law(arrangement, n, x, y):
    """The law of the nth region, counted from 1, that does not hold a point; −1 beyond the last."""
    here = region_at(arrangement, x, y)
    region = n - 1 if n - 1 < here else n
    if region >= arrangement.first_law.size - 1:
        return -1
    return law_in(arrangement, region, x, y)


@inlined
def is_elsewhere(arrangement, law, x, y):
    """Whether a point lies in another region than that of a law."""
    return region_at(arrangement, x, y) != arrangement.region_of_law[law]


@inlined
def admitted(arrangement, law, highest, outcome, x, y):
    """The outcome of a trial of a law's particle.

    BLOCKED where its centre is in another region, or higher than such a particle may go.
    """
    if y > highest:
        return BLOCKED
    if outcome == RESOLVED and is_elsewhere(arrangement, law, x, y):
        return BLOCKED
    return outcome


@inlined
def foot(placed, domain, member, beside):
    """Centre and mean radius of a member of the front; of a wall, where it faces another member."""
    if member >= 0:
        disc = placed.disc
        return disc[member, 0], disc[member, 1], math.sqrt(disc[member, 2] * disc[member, 3])
    x, y = domain.x_min, domain.y_min
    if beside >= 0:
        x, y = placed.disc[beside, 0], placed.disc[beside, 1]
    if member == BOTTOM_WALL:
        return x, domain.y_min, 0.0
    return domain.x_min if member == LEFT_WALL else domain.x_max, y, 0.0


@inlined
def rest(front, placed, domain, i):
    """About where a particle as large as its neighbours would rest on positions i and i + 1."""
    back, ahead = member_at(front, i), member_at(front, i + 1)
    x_back, y_back, r_back = foot(placed, domain, back, ahead)
    x_ahead, y_ahead, r_ahead = foot(placed, domain, ahead, back)
    return 0.5 * (x_back + x_ahead), 0.5 * (y_back + y_ahead) + SIN_60 * (r_back + r_ahead)


@inlined
def slot_of(passed, member):
    """Where a member of the front stands in `passed`; walls come after the particles."""
    return member if member >= 0 else passed.size + member


@inlined
def rough_centre(front, placed, domain, queues, counters, n_loc):
    """Where the next particle is likely to go: the lowest place to rest on the local front.

    A pair that was passed over, because the lowest place of what was tried was elsewhere, counts as
    no lower than that place. The pair is noted, and the height it counts with returned as well.
    """
    first = max(front.ends[0] - n_loc, 0)
    last = min(front.ends[0] + n_loc - 2, front_length(front) - 2)
    x, y = rest(front, placed, domain, first)
    lowest = np.inf
    for i in range(first, last + 1):
        other_x, other_y = rest(front, placed, domain, i)
        back, ahead = member_at(front, i), member_at(front, i + 1)
        height = other_y
        slot = slot_of(queues.passed, back)
        if queues.passed[slot] == ahead:
            height = max(height, queues.least_height[slot])
        if height < lowest:
            x, y, lowest = other_x, other_y, height
            counters[REST_BACK] = back
            counters[REST_AHEAD] = ahead
    queues.least_height[slot_of(queues.passed, counters[REST_BACK])] = lowest
    return x, min(y, domain.y_max), lowest


@inlined
def put_off(queues, counters, rise):
    """Let the pair on which a particle found no place count as that much higher."""
    slot = slot_of(queues.passed, counters[REST_BACK])
    queues.passed[slot] = counters[REST_AHEAD]
    queues.least_height[slot] += rise


@inlined
def pass_over(front, queues, counters, i, k, y):
    """Note at what height a particle came to rest that did not bury the pair it was to rest on."""
    back = counters[REST_BACK]
    position = i
    if back >= 0:
        position = position_of(front, back) if front.slot[back] >= 0 else i
    elif back == LEFT_WALL:
        position = 0
    if not i <= position < k:
        slot = slot_of(queues.passed, back)
        queues.passed[slot] = counters[REST_AHEAD]
        queues.least_height[slot] = y
