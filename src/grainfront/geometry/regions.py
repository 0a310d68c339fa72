"""In which region a point lies: the first whose zone holds it, and its stratum there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainfront.geometry.signed_distance import (
    INSIDE,
    TOUCHED,
    SignedDistances,
    cell_at,
    is_inside,
    signed_distance,
)
from grainfront.jit import inlined, kernel

REST = -1  # no region at all
MIXED = -2  # more than one answer in the cell


class RegionMap(NamedTuple):
    """Regions in the order in which they are asked, over the grid of their zones.

    A graded region is cut into strata, of equal steps of a coordinate: of u·(x, y), or of the
    signed distance where u is 0. Strata count through all regions; a region that is not graded has
    one.
    """

    field: SignedDistances  # zone k is that of region k
    owner: np.ndarray  # (n_cells,) region of the whole cell, REST or MIXED
    grade: np.ndarray  # (n_regions, 4): u_x, u_y, coordinate at the start, strata per unit of it
    first: np.ndarray  # (n_regions + 1,) first stratum of each region


@inlined
def region_of(regions, x, y):
    """Index of the first region that holds a point of the grid's box, or REST; exact."""
    column, row = cell_at(regions.field, x, y)
    owner = regions.owner[row * regions.field.columns + column]
    if owner != MIXED:
        return owner
    for region in range(regions.first.size - 1):
        if is_inside(regions.field, region, x, y):
            return region
    return REST


@inlined
def stratum_of(regions, x, y):
    """Index of the stratum that holds a point of the grid's box, or REST."""
    region = region_of(regions, x, y)
    if region == REST:
        return REST
    first = regions.first[region]
    n_strata = regions.first[region + 1] - first
    if n_strata == 1:
        return first
    u_x, u_y = regions.grade[region, 0], regions.grade[region, 1]
    if u_x == 0.0 and u_y == 0.0:
        coordinate = signed_distance(regions.field, region, x, y)
    else:
        coordinate = u_x * x + u_y * y
    step = (coordinate - regions.grade[region, 2]) * regions.grade[region, 3]
    return first + int(min(max(step, 0.0), n_strata - 1.0))


@kernel
def assign_points(regions, x, y, region, stratum):
    """Put the regions and strata of points into `region` and `stratum`; all of shape (n,)."""
    for i in range(x.size):
        region[i] = region_of(regions, x[i], y[i])
        stratum[i] = stratum_of(regions, x[i], y[i])


@kernel
def mark_owners(regions):
    """Fill `owner`: the first region that holds the cell, MIXED where a polyline cuts it before."""
    field = regions.field
    n_cells = field.rows * field.columns
    for cell in range(n_cells):
        regions.owner[cell] = REST
        for region in range(regions.first.size - 1):
            state = field.state[region * n_cells + cell]
            if state >= TOUCHED:
                regions.owner[cell] = MIXED
                break
            if state == INSIDE:
                regions.owner[cell] = region
                break
