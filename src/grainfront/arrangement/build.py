"""Regions to the map that the kernels ask, and evaluation at many points."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from grainfront.arrangement.fields import signed_distances
from grainfront.arrangement.regions import Arrangement, Grade, GradedAlong, GradedByDistance, Region
from grainfront.arrangement.resolve import Resolved, resolve
from grainfront.arrangement.zones import HalfPlane
from grainfront.errors import InputError
from grainfront.geometry.regions import REST, RegionMap, assign_points, mark_owners
from grainfront.particles import Rectangle


class Assigned(NamedTuple):
    """Regions and strata of points, int64 of their shape; −1 where no region holds the point."""

    region: np.ndarray
    stratum: np.ndarray


def resolve_regions(arrangement: Arrangement, domain: Rectangle) -> list[Resolved]:
    """The polygons of all regions, in their order.

    Raises InputError where a region's zone cannot be had, or lies outside the domain.
    """
    resolved = []
    for number, region in enumerate(arrangement.regions):
        key = f"arrangement.regions[{number}].inside"
        try:
            zone = resolve(_everywhere(domain) if region.inside is None else region.inside, domain)
        except InputError as error:
            raise InputError(f"{key}: {error}") from None
        if zone.polygon.is_empty:
            raise InputError(f"{key}: nothing is left of the zone, but a region must have an area")
        if zone.within(domain).area == 0.0:
            raise InputError(f"{key} lies outside the domain, but must hold a part of it")
        resolved.append(zone)
    return resolved


def region_map(arrangement: Arrangement, domain: Rectangle) -> RegionMap:
    """What the kernels ask for the region of a point of the domain.

    Its field has distances to those zones alone that are graded by them. Raises InputError as
    `resolve_regions` does.
    """
    measured = [isinstance(region.grade, GradedByDistance) for region in arrangement.regions]
    field = signed_distances(resolve_regions(arrangement, domain), domain, measured)
    counts = [len(region.strata) for region in arrangement.regions]
    regions = RegionMap(
        field=field,
        owner=np.full(field.columns * field.rows, REST, dtype=np.int64),
        grade=np.array([_grade(region) for region in arrangement.regions]),
        first=np.concatenate([[0], np.cumsum(counts)]).astype(np.int64),
    )
    mark_owners(regions)
    return regions


def assign(regions: RegionMap, x: ArrayLike, y: ArrayLike) -> Assigned:
    """The regions and strata of points of the domain."""
    x, y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
    found = Assigned(np.empty(x.size, np.int64), np.empty(x.size, np.int64))
    assign_points(regions, x.ravel(), y.ravel(), found.region, found.stratum)
    return Assigned(found.region.reshape(x.shape), found.stratum.reshape(x.shape))


def _everywhere(domain: Rectangle) -> HalfPlane:
    """A half-plane that holds all of the domain, its line far away."""
    return HalfPlane((domain.x_min - (domain.width + domain.height), domain.y_min), (-1.0, 0.0))


def _grade(region: Region) -> tuple[float, float, float, float]:
    """The row of a region in `RegionMap.grade`."""
    grade: Grade | None = region.grade
    match grade:
        case None:
            return 0.0, 0.0, 0.0, 0.0
        case GradedAlong((x0, y0), (x1, y1)):
            length = math.hypot(x1 - x0, y1 - y0)
            u_x, u_y = (x1 - x0) / length, (y1 - y0) / length
            return u_x, u_y, u_x * x0 + u_y * y0, len(region.strata) / length
        case GradedByDistance(start, end):
            return 0.0, 0.0, start, len(region.strata) / (end - start)
    raise TypeError(f"{grade!r} is no grade")
