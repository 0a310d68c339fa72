"""How much of the domain the particles fill."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from grainfront.geometry.boxes import bounding_boxes
from grainfront.geometry.rooms import Occupancy, rooms_for_disc
from grainfront.particles import Cell, Packing, Region
from grainfront.polygons import Polygons

BULK_MARGIN = 2.0
"""Width of the strip along the walls that the bulk leaves out, in square roots of the mean area."""

SLIVER = 1e-9
"""Share of a slice that is the domain's, up to which it is taken for rounding of coordinates."""


def volume_fraction(packing: Packing) -> float:
    """Area of the particles over the area of the domain."""
    return float(packing.area.sum() / packing.domain.area)


def volume_fraction_bulk(packing: Packing) -> float:
    """Volume fraction away from the walls, where particles cannot pack as they do inside.

    The domain is shrunk by `BULK_MARGIN` × sqrt(mean particle area) from every wall; particles that
    straddle the border of what remains count with their part inside. NaN where nothing remains.
    """
    domain = packing.domain
    if isinstance(domain, Region):
        return _fraction_within_region(packing, domain)
    if isinstance(domain, Cell):
        return _fraction_of_cell(packing, domain)
    margin = BULK_MARGIN * float(np.sqrt(packing.area.mean()))
    x_min, y_min = domain.x_min + margin, domain.y_min + margin
    x_max, y_max = domain.x_max - margin, domain.y_max - margin
    if x_min >= x_max or y_min >= y_max:
        return float("nan")
    polygons = packing.polygons
    left, bottom, right, top = bounding_boxes(polygons.nodes, polygons.offsets).T
    inside = (left >= x_min) & (bottom >= y_min) & (right <= x_max) & (top <= y_max)
    outside = (left >= x_max) | (bottom >= y_max) | (right <= x_min) | (top <= y_min)
    straddling = Polygons.of(
        polygons.polygon(i) for i in np.flatnonzero(~inside & ~outside).tolist()
    )
    bulk = shapely.box(x_min, y_min, x_max, y_max)
    clipped = shapely.area(shapely.intersection(straddling.to_shapely(), bulk))
    area = packing.area[inside].sum() + clipped.sum()
    return float(area / ((x_max - x_min) * (y_max - y_min)))


@dataclass(frozen=True)
class Rooms:
    """Parts of a domain that are joined for a disc of the mean size, arrays of shape (n_rooms,).

    A room is empty if it holds the centre of no particle; (`x`, `y`) is a point inside it.
    """

    area: np.ndarray
    x: np.ndarray
    y: np.ndarray
    empty: np.ndarray

    @property
    def empty_area(self) -> float:
        """Area of the empty rooms."""
        return float(self.area[self.empty].sum())


def find_rooms(packing: Packing) -> Rooms:
    """The rooms of the domain: islands, and what lies beyond necks where no such disc fits."""
    domain = packing.domain
    if not isinstance(domain, Region):
        x, y = 0.5 * (domain.x_min + domain.x_max), 0.5 * (domain.y_min + domain.y_max)
        whole = map(np.array, ([domain.area], [x], [y], [False]))
        return Rooms(*whole)
    radius = 0.5 * float(packing.size.mean())
    rooms = rooms_for_disc(domain.to_shapely(), radius)
    occupancy = Occupancy(rooms)
    occupancy.add(packing.x, packing.y)
    inside = shapely.point_on_surface(rooms)
    x, y = shapely.get_x(inside), shapely.get_y(inside)
    return Rooms(shapely.area(rooms), x, y, occupancy.particles == 0)


def _fraction_within_region(packing: Packing, region: Region) -> float:
    margin = BULK_MARGIN * float(np.sqrt(packing.area.mean()))
    inner = shapely.buffer(region.to_shapely(), -margin)
    if inner.is_empty:
        return float("nan")
    shapely.prepare(inner)
    shapes = packing.polygons.to_shapely()
    inside = shapely.contains_properly(inner, shapes)
    straddling = shapes[~inside & shapely.intersects(inner, shapes)]
    clipped = shapely.area(shapely.intersection(straddling, inner))
    return float((packing.area[inside].sum() + clipped.sum()) / inner.area)


def _fraction_of_cell(packing: Packing, cell: Cell) -> float:
    if cell.along_y:
        return volume_fraction(packing)
    margin = BULK_MARGIN * float(np.sqrt(packing.area.mean()))
    bottom, top = cell.y_min + margin, cell.y_max - margin
    if bottom >= top:
        return float("nan")
    return volume_fraction_between(packing, 1, bottom, top)


def volume_fraction_between(packing: Packing, axis: int, low: float, high: float) -> float:
    """Volume fraction between two lines across an axis (0: x, 1: y) of the domain.

    Particles that reach over the border of a periodic cell come in again on the other side. NaN
    where nothing of the domain lies between the lines.
    """
    domain = packing.domain
    period = (domain.width, domain.height)[axis]
    repeats = isinstance(domain, Cell) and (axis == 0 or domain.along_y)
    area = sum(
        _area_between(packing.polygons, axis, low + shift, high + shift)
        for shift in ((-period, 0.0, period) if repeats else (0.0,))
    )
    whole = slice_area = (high - low) * (domain.height if axis == 0 else domain.width)
    if isinstance(domain, Region):
        sides = np.array([domain.x_min, domain.y_min, domain.x_max, domain.y_max])
        sides[[axis, axis + 2]] = low, high
        # clip_by_rect of GEOS takes wrong areas where a concave polygon has corners on the border
        whole = shapely.intersection(domain.to_shapely(), shapely.box(*sides)).area
    return area / whole if whole > SLIVER * slice_area else float("nan")


def _area_between(polygons: Polygons, axis: int, low: float, high: float) -> float:
    """Area of polygons between two lines across an axis.

    By Green's theorem, the area of a polygon between x = a and x = b is the integral over its
    boundary of min(max(x, a), b) dy; of lengths from a on, so that far from the origin rounding
    does not outweigh thin slices.
    """
    nodes, offsets = polygons.nodes, polygons.offsets
    after = np.arange(1, len(nodes) + 1)
    after[offsets[1:] - 1] = offsets[:-1]
    first, last = np.sort([nodes[:, axis], nodes[after, axis]], axis=0) - low
    width = high - low
    # clipping bends an edge at the two lines at most, and the trapezium rule is exact in between
    bends = np.array([first, np.clip(0.0, first, last), np.clip(width, first, last), last])
    clipped = np.clip(bends, 0.0, width)
    length = last - first
    integral = np.sum(np.diff(bends, axis=0) * (clipped[1:] + clipped[:-1]) / 2, axis=0)
    mean = np.divide(integral, length, out=clipped[0].copy(), where=length > 0)
    across = nodes[after, 1 - axis] - nodes[:, 1 - axis]
    # counter-clockwise, the area is the integral of x dy, or of −y dx
    return float(np.sum(mean * across)) * (1 if axis == 0 else -1)


def void_ratio(volume_fraction: float) -> float:
    """Area of the voids over the area of the particles, (1 − φ)/φ."""
    return (1.0 - volume_fraction) / volume_fraction
