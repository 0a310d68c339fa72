"""Zones to polygons: set operations, offsets and motions carried out once, before packing.

Minimum and maximum of signed distances (paper, Eqs. 5–7) have the right sign everywhere, but away
from the boundary they are bounds of the distance only. The polygon of the result has the same
inside, and the distance to its boundary is exact.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import shapely

from grainfront.arrangement import zones
from grainfront.arrangement.zones import Zone
from grainfront.errors import InputError
from grainfront.particles import Rectangle, Region

# Circles and round corners are drawn with an edge for each degree: it strays from the arc by
# 1 − cos(0.5°) = 4e-5 of the radius.
EDGES_OF_QUARTER = 90
# More bars than this are refused: they would be finer than any grain that is told apart in them.
MOST_BARS = 10_000
# Edges on the border of a window stray from it by rounding alone, relative to its width.
ON_BORDER = 1e-9


class Resolved(NamedTuple):
    """The polygon of a zone, cut off at a window; edges on the window's border bound nothing.

    The window surrounds the domain, and every finite part of the zone, by the diagonal of both, so
    that a distance in the domain that is less than this diagonal knows no window.
    """

    polygon: shapely.Geometry
    window: Rectangle

    def within(self, domain: Rectangle) -> shapely.Geometry:
        """The part of the zone that lies in the domain."""
        whole = shapely.box(domain.x_min, domain.y_min, domain.x_max, domain.y_max)
        if isinstance(domain, Region):
            whole = domain.to_shapely()
        return _polygons_of(shapely.intersection(self.polygon, whole))


class Motion(NamedTuple):
    """The similarity z → turn · z + shift of the complex plane."""

    turn: complex
    shift: complex

    def __call__(self, z: complex) -> complex:
        return self.turn * z + self.shift

    def of_nodes(self, nodes: np.ndarray) -> np.ndarray:
        """Nodes, shape (n, 2), in their new places."""
        z = self.turn * (nodes[:, 0] + 1j * nodes[:, 1]) + self.shift
        return np.column_stack([z.real, z.imag])


STILL = Motion(1.0 + 0.0j, 0.0j)


def resolve(zone: Zone, domain: Rectangle) -> Resolved:
    """The polygon (or polygons, with holes) of a zone around a domain.

    Raises InputError where an image or a file of the zone is at fault, where a polygon crosses
    itself, and where there are too many bars.
    """
    corners = np.array([[domain.x_min, domain.y_min], [domain.x_max, domain.y_max]])
    return _resolve(zone, corners)


def resolve_bounded(zone: Zone) -> shapely.Geometry:
    """The polygon (or polygons, with holes) of a zone that is to be a domain itself.

    Raises InputError as `resolve` does, and where the zone is empty or has no end, or none near.
    """
    polygon, window = _resolve(zone, np.empty((0, 2)))
    border = shapely.box(window.x_min, window.y_min, window.x_max, window.y_max).exterior
    slack = ON_BORDER * max(window.width, window.height)
    # half-planes and bars through a single point have no extent, and no end
    if slack == 0.0 or shapely.distance(polygon, border) <= slack:
        raise InputError("the zone has no end, or none near, but a domain must be bounded")
    if polygon.is_empty:
        raise InputError("nothing is left of the zone, but a domain must have an area")
    return polygon


def _resolve(zone: Zone, seen: np.ndarray) -> Resolved:
    """Resolve a zone in a window around the points to be `seen`, shape (n, 2)."""
    figures = {leaf: _figure(leaf) for leaf in _leaves(zone)}
    points, reach = _extent(zone, STILL, figures)
    points = np.concatenate([points, seen])
    low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
    diagonal = math.hypot(*(high - low))
    window = Rectangle(*map(float, low - diagonal), *map(float, high + diagonal))
    box = shapely.box(window.x_min, window.y_min, window.x_max, window.y_max)
    whole = _polygon(zone, STILL, figures, window)
    return Resolved(_polygons_of(shapely.intersection(whole, box)), window)


def _children(zone: Zone) -> tuple[Zone, ...]:
    match zone:
        case zones.Union() | zones.Intersection() | zones.Difference():
            return zone.zones
        case zones.Offset() | zones.Moved():
            return (zone.zone,)
    return ()


def _leaves(zone: Zone) -> Iterator[Zone]:
    """The zones of a given, finite figure."""
    children = _children(zone)
    for child in children:
        yield from _leaves(child)
    if not children and not isinstance(zone, zones.HalfPlane | zones.Bars):
        yield zone


def _figure(leaf: Zone) -> shapely.Geometry:
    match leaf:
        case zones.Circle(centre, radius):
            return shapely.buffer(shapely.Point(centre), radius, quad_segs=EDGES_OF_QUARTER)
        case zones.Box((x, y), width, height):
            return shapely.box(x - width / 2, y - height / 2, x + width / 2, y + height / 2)
        case zones.Polygon(nodes, holes):
            return _valid(shapely.Polygon(nodes, holes))
        case zones.Silhouette():
            from grainfront.arrangement.silhouette import silhouette

            return silhouette(leaf)
        case zones.PolygonsFile(path):
            from grainfront.arrangement.polygons_file import read_polygons

            return read_polygons(path)
    raise TypeError(f"{leaf!r} is no finite zone")


def _valid(polygon: shapely.Polygon) -> shapely.Polygon:
    if not polygon.is_valid or polygon.area == 0.0:
        reason = shapely.is_valid_reason(polygon) if not polygon.is_valid else "its area is 0"
        raise InputError(f"a polygon is not simple with holes inside ({reason})")
    return polygon


def _extent(
    zone: Zone, motion: Motion, figures: dict[Zone, shapely.Geometry]
) -> tuple[np.ndarray, float]:
    """Points, shape (n, 2), that bound the finite parts of a zone, and how far offsets reach."""
    match zone:
        case zones.Offset(inner, distance):
            points, reach = _extent(inner, motion, figures)
            return points, reach + abs(motion.turn) * abs(distance)
        case zones.Moved():
            return _extent(zone.zone, _after(motion, zone), figures)
        case zones.HalfPlane(point) | zones.Bars(point=point):
            return motion.of_nodes(np.array([point])), 0.0
    if zone in figures:
        return motion.of_nodes(shapely.get_coordinates(figures[zone].convex_hull)), 0.0
    parts, reaches = zip(*(_extent(z, motion, figures) for z in _children(zone)), strict=True)
    return np.concatenate(parts), max(reaches)


def _after(motion: Motion, moved: zones.Moved) -> Motion:
    """`motion` after that of `moved`; quarter turns are exact."""
    quarters, rest = divmod(moved.angle, 90.0)
    turn = moved.scale * 1j ** int(quarters % 4) * cmath.rect(1.0, math.radians(rest))
    about, shift = complex(*moved.about), complex(*moved.shift)
    return Motion(motion.turn * turn, motion(about - turn * about + shift))


def _polygon(
    zone: Zone, motion: Motion, figures: dict[Zone, shapely.Geometry], window: Rectangle
) -> shapely.Geometry:
    """The polygon of a zone; what has no end is cut off far outside the window."""
    if zone in figures:
        return shapely.transform(figures[zone], motion.of_nodes)
    match zone:
        case zones.HalfPlane():
            return _half_plane(zone, motion, window)
        case zones.Bars():
            return _bars(zone, motion, window)
        case zones.Moved():
            return _polygon(zone.zone, _after(motion, zone), figures, window)
        case zones.Offset(inner, distance):
            polygon = _polygon(inner, motion, figures, window)
            by = abs(motion.turn) * distance
            return shapely.buffer(polygon, by, quad_segs=EDGES_OF_QUARTER)
    first, *others = [_polygon(z, motion, figures, window) for z in _children(zone)]
    match zone:
        case zones.Union():
            return shapely.union_all([first, *others])
        case zones.Intersection():
            return shapely.intersection_all([first, *others])
        case zones.Difference():
            return shapely.difference(first, shapely.union_all(others))
    raise TypeError(f"{zone!r} is no zone")


def _far(window: Rectangle) -> tuple[complex, float]:
    """Centre of a window, and a length that leads well outside it, offsets included."""
    centre = complex(window.x_min + window.x_max, window.y_min + window.y_max) / 2
    return centre, 4.0 * math.hypot(window.width, window.height)


def _half_plane(zone: zones.HalfPlane, motion: Motion, window: Rectangle) -> shapely.Polygon:
    """The part of a half-plane that is seen from the window: a rectangle on its line."""
    centre, far = _far(window)
    point, normal = motion(complex(*zone.point)), motion.turn * complex(*zone.normal)
    normal /= abs(normal)
    across = ((centre - point) * normal.conjugate()).real
    foot = centre - across * normal
    along = 1j * normal
    inner = foot - (far + abs(across)) * normal
    return _quadrilateral(foot - far * along, foot + far * along, inner + far * along,
                          inner - far * along)  # fmt: skip


def _bars(zone: zones.Bars, motion: Motion, window: Rectangle) -> shapely.Geometry:
    """The bars that come near the window, each a rectangle."""
    centre, far = _far(window)
    along = motion.turn * cmath.rect(1.0, math.radians(zone.direction))
    scale = abs(along)
    along /= scale
    across = 1j * along
    width, spacing = scale * zone.width, scale * zone.spacing
    offset = (motion(complex(*zone.point)) - centre) * across.conjugate()
    # the bars' own line through the centre: what is beyond half the diagonal is not seen
    count = far / 4.0 / spacing
    if count > MOST_BARS:
        raise InputError(
            f"bars are {zone.spacing:g} apart, which makes {count:.0f} of them, "
            f"but there may be {MOST_BARS} at most"
        )
    first = offset.real % spacing - math.ceil(count) * spacing
    steps = first + spacing * np.arange(2 * math.ceil(count) + 1)
    corners = np.array([-far * along, far * along, far * along, -far * along])
    sides = np.array([-1, -1, 1, 1]) * (width / 2) * across
    z = centre + steps[:, None] * across + corners + sides
    return shapely.multipolygons(shapely.polygons(np.stack([z.real, z.imag], axis=-1)))


def _quadrilateral(*corners: complex) -> shapely.Polygon:
    return shapely.Polygon([(z.real, z.imag) for z in corners])


def _polygons_of(geometry: shapely.Geometry) -> shapely.Geometry:
    """The polygons of what an overlay left, without its points and lines."""
    parts = shapely.get_parts(geometry)
    kept = parts[shapely.get_dimensions(parts) == 2]
    return shapely.multipolygons(kept) if len(kept) else shapely.MultiPolygon()
