"""Whether two simple polygons share interior points, in rational arithmetic.

Needed only where the convex hulls of two nonconvex outlines overlap, so clarity goes before speed.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise

import numpy as np

Point = tuple[Fraction, Fraction]
Edge = tuple[Point, Point]


def interiors_meet(a: np.ndarray, b: np.ndarray) -> bool:
    """Whether two simple counter-clockwise polygons share interior points; shapes (n, 2), (m, 2).

    They do if and only if some piece of one boundary lies inside the other polygon, or along the
    other boundary in the same direction, so that both interiors are on its left. Touching nodes and
    edges that run in opposite directions are no overlap.
    """
    edges_a, edges_b = _edges(a), _edges(b)
    return _enters(edges_a, edges_b) or _enters(edges_b, edges_a)


def lies_inside(polygon: np.ndarray, boundary: np.ndarray) -> bool:
    """Whether a simple polygon, (n, 2), lies inside the region that edges, (m, 2, 2), bound.

    It does if no piece of the boundary lies in its interior, and one point of its interior is
    inside. Touching is allowed.
    """
    edges = _edges(polygon)
    around = [(_point(p), _point(q)) for p, q in boundary.tolist()]
    for edge in around:
        for middle in _middles_of_pieces(edge, edges):
            if not any(_is_on(middle, e) for e in edges) and _is_inside(middle, edges):
                return False
    return _is_inside(_interior_point(edges), around)


def _interior_point(edges: list[Edge]) -> Point:
    """Half way from the middle of the first edge to the boundary opposite of it."""
    (px, py), (qx, qy) = edges[0]
    middle = (px + qx) / 2, (py + qy) / 2
    inward = py - qy, qx - px
    nearest = min(
        t
        for p, q in edges[1:]
        if (turn := _cross(inward, _minus(q, p))) != 0
        and 0 <= _cross(_minus(p, middle), inward) / turn <= 1
        and (t := _cross(_minus(p, middle), _minus(q, p)) / turn) > 0
    )
    return middle[0] + inward[0] * nearest / 2, middle[1] + inward[1] * nearest / 2


def _point(coordinates: list[float]) -> Point:
    return Fraction(coordinates[0]), Fraction(coordinates[1])


def _edges(polygon: np.ndarray) -> list[Edge]:
    points = [_point(node) for node in polygon.tolist()]
    return list(zip(points, points[1:] + points[:1], strict=True))


def _minus(p: Point, q: Point) -> Point:
    return p[0] - q[0], p[1] - q[1]


def _cross(u: Point, v: Point) -> Fraction:
    return u[0] * v[1] - u[1] * v[0]


def _dot(u: Point, v: Point) -> Fraction:
    return u[0] * v[0] + u[1] * v[1]


def _enters(edges: list[Edge], other: list[Edge]) -> bool:
    for edge in edges:
        direction = _minus(edge[1], edge[0])
        for middle in _middles_of_pieces(edge, other):
            touched = [e for e in other if _is_on(middle, e)]
            if touched:
                if any(_dot(_minus(e[1], e[0]), direction) > 0 for e in touched):
                    return True
            elif _is_inside(middle, other):
                return True
    return False


def _middles_of_pieces(edge: Edge, other: list[Edge]) -> Iterator[Point]:
    start, direction = edge[0], _minus(edge[1], edge[0])
    cuts = sorted({Fraction(0), Fraction(1), *_cuts(edge, other)})
    for low, high in pairwise(cuts):
        t = (low + high) / 2
        yield start[0] + t * direction[0], start[1] + t * direction[1]


def _cuts(edge: Edge, other: list[Edge]) -> Iterator[Fraction]:
    """Where `other` meets the edge, as parameters in [0, 1]."""
    start, direction = edge[0], _minus(edge[1], edge[0])
    for p, q in other:
        along, to_p = _minus(q, p), _minus(p, start)
        turn = _cross(direction, along)
        if turn != 0:
            t, s = _cross(to_p, along) / turn, _cross(to_p, direction) / turn
            if 0 <= t <= 1 and 0 <= s <= 1:
                yield t
        elif _cross(to_p, direction) == 0:
            for point in (p, q):
                t = _dot(_minus(point, start), direction) / _dot(direction, direction)
                if 0 <= t <= 1:
                    yield t


def _is_on(point: Point, edge: Edge) -> bool:
    p, q = edge
    to_p, to_q = _minus(p, point), _minus(q, point)
    return _cross(to_p, to_q) == 0 and _dot(to_p, to_q) <= 0


def _is_inside(point: Point, edges: list[Edge]) -> bool:
    """Even-odd rule, for a point that is not on the boundary."""
    inside = False
    for p, q in edges:
        if (p[1] > point[1]) != (q[1] > point[1]):
            left = _cross(_minus(q, p), _minus(point, p)) > 0
            inside ^= left == (q[1] > p[1])
    return inside
