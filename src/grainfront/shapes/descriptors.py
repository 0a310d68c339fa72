"""Shape descriptors of polygons, by exact algorithms.

Terms after Du, Liu, Han & Deng (2023, doi 10.1016/j.jrmge.2022.03.009, section 2) and, for the
regularity, Mollon & Zhao (2012, doi 10.1007/s10035-012-0356-x).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import shapely
from scipy.spatial import ConvexHull

from grainfront.polygons import Polygons

# Hull vertices closer than this (times the extent of the polygon) to the line through their
# neighbours, or to each other, are one: far above rounding (1e-16), far below any shape.
COLLINEAR = 1e-9
# Widths that differ by less than this fraction tie: rounding in the coordinates of symmetric
# polygons makes their equal widths differ by a few 1e-16.
WIDTH_TIE = 1e-12
# Relative to the square root of the area: far below any measurement, still far above rounding.
INSCRIBED_TOLERANCE = 1e-10
# Perimeters of an outline and its hull that differ by less than this fraction are equal: rounding
# of a few hundred sums is 1e-14.
CONVEX = 1e-12


class Feret(NamedTuple):
    """Minimum Feret diameter, the extent perpendicular to it, and the direction of that extent."""

    size: float
    length: float
    orientation: float


def feret(hull: np.ndarray) -> Feret:
    """Size, length and orientation (degrees, in [0, 180)) of a convex polygon, shape (n, 2), ccw.

    The minimum width of a convex polygon is that across one of its edges (Houle & Toussaint 1988),
    so every edge is tried: O(n²) in a few array operations, faster than rotating calipers for the
    tens of vertices of a grain. Of directions whose widths tie the smallest orientation is taken.
    """
    edges = np.roll(hull, -1, axis=0) - hull
    along = edges / np.hypot(edges[:, 0], edges[:, 1])[:, None]
    across = np.column_stack([-along[:, 1], along[:, 0]])
    widths = np.ptp(hull @ across.T, axis=0)
    angles = np.degrees(np.arctan2(along[:, 1], along[:, 0])) % 180.0
    # An edge along -x may round to 180 degrees less a hair: it is the orientation 0.
    angles[180.0 - angles < 180.0 * WIDTH_TIE] = 0.0
    tied = np.flatnonzero(widths <= widths.min() * (1.0 + WIDTH_TIE))
    best = tied[np.argmin(angles[tied])]
    length = float(np.ptp(hull @ along[best]))
    return Feret(float(widths[best]), length, float(angles[best]))


def hull_indices(outline: np.ndarray) -> np.ndarray:
    """Indices of the vertices of the convex hull, counter-clockwise, from the smallest index on.

    `outline` has shape (n, 2). Vertices closer to the line through their neighbours than COLLINEAR
    times the extent are left out; see `clean_outline`, which makes the hull hold every node then.
    """
    scaled = (outline - outline.mean(axis=0)) / np.ptp(outline, axis=0).max()
    index = list(ConvexHull(scaled).vertices)
    while len(index) > 3:
        corner = scaled[index]
        height = _heights(corner)
        flattest = int(np.argmin(height))
        if height[flattest] > COLLINEAR:
            break
        del index[flattest]
    start = int(np.argmin(index))
    return np.array(index[start:] + index[:start], dtype=np.int64)


def clean_outline(outline: np.ndarray) -> np.ndarray:
    """Make every node of an outline a hull vertex or clearly inside the hull.

    Nodes that repeat their predecessor, or lie on the straight line between their neighbours,
    within COLLINEAR times the extent, are dropped; nodes that then still lie within that distance
    of the hull's boundary are moved inside by twice as much. A rounded copy of the hull vertices
    therefore holds the rounded copy of the outline.
    """
    extent = np.ptp(outline, axis=0).max()
    nodes = outline
    while len(nodes) > 3:
        height = _heights(nodes) / extent
        step = nodes - np.roll(nodes, 1, axis=0)
        height[np.hypot(step[:, 0], step[:, 1]) <= COLLINEAR * extent] = 0.0
        flattest = int(np.argmin(height))
        if height[flattest] > COLLINEAR:
            break
        nodes = np.delete(nodes, flattest, axis=0)
    return _inside_hull(nodes, COLLINEAR * extent)


def _inside_hull(nodes: np.ndarray, margin: float) -> np.ndarray:
    """Move nodes that are no hull vertices at least `margin` inside the hull."""
    index = hull_indices(nodes)
    corner = nodes[index]
    edge = np.roll(corner, -1, axis=0) - corner
    inward = np.column_stack([-edge[:, 1], edge[:, 0]]) / np.hypot(*edge.T)[:, None]
    depth = nodes @ inward.T - np.einsum("ij,ij->i", corner, inward)
    depth[index] = np.inf
    shallow = np.flatnonzero(depth.min(axis=1) < margin)
    moved = nodes.copy()
    for i in shallow:
        moved[i] += 2.0 * margin * inward[np.argmin(depth[i])]
    return moved


def _heights(ring: np.ndarray) -> np.ndarray:
    """Distance of every node of a ring from the straight line between its neighbours."""
    before, after = np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0)
    chord = after - before
    length = np.hypot(chord[:, 0], chord[:, 1])
    offset = ring - before
    cross = np.abs(chord[:, 0] * offset[:, 1] - chord[:, 1] * offset[:, 0])
    return np.divide(cross, length, out=np.zeros_like(cross), where=length > 0.0)


def regularity(perimeter: np.ndarray, convex_perimeter: np.ndarray) -> np.ndarray:
    """log10(P / (P − P_convex)) (Mollon & Zhao 2012), +inf for a convex outline; same shape."""
    excess = np.asarray(perimeter - convex_perimeter, dtype=np.float64)
    convex = excess <= CONVEX * perimeter
    return np.where(convex, np.inf, np.log10(perimeter / np.where(convex, 1.0, excess)))


def circumscribed_radius(outline: np.ndarray) -> float:
    """Radius of the smallest circle round a polygon of shape (n, 2).

    GEOS finds the two or three nodes that carry the circle, so the result is exact to rounding.
    """
    return float(shapely.minimum_bounding_radius(shapely.LinearRing(outline)))


def inscribed_radius(outline: np.ndarray) -> float:
    """Radius of the largest circle inside a simple polygon of shape (n, 2), convex or not.

    Branch and bound (GEOS): the radius returned is a clearance really found, and no point inside
    has one larger by more than INSCRIBED_TOLERANCE times the square root of the area.
    """
    polygon = shapely.Polygon(outline)
    tolerance = INSCRIBED_TOLERANCE * np.sqrt(polygon.area)
    return float(shapely.length(shapely.maximum_inscribed_circle(polygon, tolerance=tolerance)))


def describe(outlines: Polygons, hulls: Polygons) -> dict[str, np.ndarray]:
    """Every descriptor of every outline; `hulls` are their convex hulls.

    Returns float64 arrays of shape (n_polygons,): size, length, perimeter, convex_perimeter,
    inscribed_radius, circumscribed_radius (lengths in the polygons' unit), area, hull_area (its
    square), orientation (degrees in [0, 180)), aspect_ratio, convexity, regularity, circularity
    (dimensionless; regularity is +inf for a convex outline).
    """
    diameters = [feret(hulls.polygon(i)) for i in range(hulls.count)]
    size, length, orientation = np.array(diameters, dtype=np.float64).reshape(-1, 3).T
    shapes, hull_shapes = outlines.to_shapely(), hulls.to_shapely()
    perimeter, convex_perimeter = shapely.length(shapes), shapely.length(hull_shapes)
    rings = [outlines.polygon(i) for i in range(outlines.count)]
    inscribed = np.array([inscribed_radius(ring) for ring in rings])
    circumscribed = np.array([circumscribed_radius(ring) for ring in rings])
    return {
        "size": size,
        "length": length,
        "aspect_ratio": length / size,
        "orientation": orientation,
        "area": shapely.area(shapes),
        "hull_area": shapely.area(hull_shapes),
        "perimeter": perimeter,
        "convex_perimeter": convex_perimeter,
        "convexity": convex_perimeter / perimeter,
        "regularity": regularity(perimeter, convex_perimeter),
        "inscribed_radius": inscribed,
        "circumscribed_radius": circumscribed,
        "circularity": np.sqrt(inscribed / circumscribed),
    }
