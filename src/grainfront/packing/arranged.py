"""Which particles go where: regions with laws of their own (paper, section 4.2, Pseudocode 7)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainfront.geometry.regions import RegionMap, region_of, stratum_in
from grainfront.jit import inlined
from grainfront.packing.front import member_at
from grainfront.packing.state import BOTTOM_WALL, LEFT_WALL, RIGHT_WALL
from grainfront.packing.trials import BLOCKED, RESOLVED


class Arrangement(NamedTuple):
    """Regions, numbered as they are asked for; the rest of the domain comes last.

    A law stands for a stratum of a region; `first_law` counts them through all regions.
    """

    regions: RegionMap
    first_law: np.ndarray  # (n_regions + 2,) first law of each region and of the rest; their number
    region_of_law: np.ndarray  # (n_laws,)


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
def admitted(arrangement, law, outcome, x, y):
    """The outcome of a trial of a law's particle: BLOCKED where its centre is in another region."""
    if outcome == RESOLVED and region_at(arrangement, x, y) != arrangement.region_of_law[law]:
        return BLOCKED
    return outcome


@inlined
def rough_centre(front, placed, domain):
    """Mean of the two members at the gap, before anything is known of the new particle."""
    back = member_at(front, front.ends[0] - 1)
    ahead = member_at(front, front.ends[0])
    x_back = domain.x_min
    y_back = domain.y_min
    x_ahead = domain.x_max
    y_ahead = domain.y_min
    if back >= 0:
        x_back, y_back = placed.disc[back, 0], placed.disc[back, 1]
    if ahead >= 0:
        x_ahead, y_ahead = placed.disc[ahead, 0], placed.disc[ahead, 1]
    if back == LEFT_WALL and ahead >= 0:
        y_back = y_ahead
    if ahead == RIGHT_WALL and back >= 0:
        y_ahead = y_back
    if ahead == BOTTOM_WALL:
        x_ahead = x_back
    if back == BOTTOM_WALL:
        x_back = x_ahead
    return 0.5 * (x_back + x_ahead), 0.5 * (y_back + y_ahead)
