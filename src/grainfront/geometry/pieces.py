"""Cutting polygons into convex pieces without new nodes."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from grainfront.geometry.exact import orientation


def convex_pieces(polygon: Any) -> list[np.ndarray]:
    """Cut a shapely polygon into convex pieces, each (n, 2), counter-clockwise, strictly convex.

    The triangles of a constrained Delaunay triangulation are merged across edges whose removal
    leaves both ends convex (Hertel & Mehlhorn 1983, doi 10.1007/3-540-12689-9_105), longest edges
    first. All nodes are nodes of the polygon.
    """
    triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
    triangles = shapely.orient_polygons(triangles)
    rings = [list(map(tuple, shapely.get_coordinates(t)[:-1].tolist())) for t in triangles]
    return [np.array(piece) for piece in _merged([r for r in rings if _strictly_convex(r)])]


def _strictly_convex(ring: list[tuple]) -> bool:
    """Whether a ring that turns by one full turn turns left at every node."""
    n = len(ring)
    return all(orientation(*ring[i - 2], *ring[i - 1], *ring[i]) > 0 for i in range(n))


def _merged(rings: list[list[tuple]]) -> list[list[tuple]]:
    owner = {}
    for number, ring in enumerate(rings):
        for i in range(len(ring)):
            owner[ring[i - 1], ring[i]] = number
    shared = [edge for edge in owner if edge[::-1] in owner and edge < edge[::-1]]
    shared.sort(key=lambda edge: (-np.hypot(*np.subtract(*edge)), edge))
    for edge in shared:
        first, second = owner[edge], owner[edge[::-1]]
        ring = _joined(rings[first], rings[second], edge)
        if first != second and _strictly_convex(ring):
            rings[first], rings[second] = ring, []
            for i in range(len(ring)):
                owner[ring[i - 1], ring[i]] = first
    return [ring for ring in rings if ring]


def _joined(first: list[tuple], second: list[tuple], edge: tuple) -> list[tuple]:
    """The ring round two that share an edge, which runs as given in the first."""
    i, j = first.index(edge[1]), second.index(edge[0])
    return first[i:] + first[:i] + (second[j:] + second[:j])[1:-1]
