"""Rooms: parts of a polygon that are joined for a disc of some radius."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely


def rooms_for_disc(polygon: Any, radius: float) -> np.ndarray:
    """Where the centre of a disc may lie in a shapely polygon: one polygon for each room."""
    rooms = shapely.get_parts(shapely.buffer(polygon, -radius))
    return rooms[~shapely.is_empty(rooms)]


def holds_a_point(rooms: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Whether each room, a shapely polygon, holds any of the points; shape (n_rooms,)."""
    holds = np.zeros(rooms.size, dtype=np.bool_)
    holds[shapely.STRtree(rooms).query(shapely.points(x, y), predicate="intersects")[1]] = True
    return holds


def edges_of(polygons: np.ndarray) -> np.ndarray:
    """The ends of all edges of shapely polygons, x, y, x, y, shape (n_edges, 4)."""
    nodes, ring = shapely.get_coordinates(shapely.get_rings(polygons), return_index=True)
    edges = np.column_stack([nodes[:-1], nodes[1:]])
    return edges[ring[:-1] == ring[1:]]
