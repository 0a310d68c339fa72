"""Rooms: parts of a polygon that are joined for a disc of some radius, and what is in them."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely


def rooms_for_disc(polygon: Any, radius: float) -> np.ndarray:
    """Rooms of a shapely polygon for discs of a radius, as far as these reach: polygons."""
    rooms = shapely.get_parts(shapely.buffer(polygon, -radius))
    return shapely.buffer(rooms[~shapely.is_empty(rooms)], radius)


class Occupancy:
    """How many particles have their centre in each of some rooms, of those told of so far."""

    def __init__(self, rooms: np.ndarray) -> None:
        self._tree = shapely.STRtree(rooms)
        self.particles = np.zeros(len(rooms), dtype=np.int64)

    def add(self, x: np.ndarray, y: np.ndarray) -> None:
        """Tell of particles at (x, y), arrays of shape (n,)."""
        room = self._tree.query(shapely.points(x, y), predicate="intersects")[1]
        self.particles += np.bincount(room, minlength=self.particles.size)


def edges_of(polygon: Any) -> np.ndarray:
    """The ends of all edges of a shapely polygon, x, y, x, y, shape (n_edges, 4)."""
    nodes, ring = shapely.get_coordinates(shapely.get_rings(polygon), return_index=True)
    edges = np.column_stack([nodes[:-1], nodes[1:]])
    return edges[ring[:-1] == ring[1:]]
