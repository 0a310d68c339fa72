"""Polygons of zones to the distance grid that the kernels ask, and evaluation at many points."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import shapely
from numpy.typing import ArrayLike

from grainfront.arrangement.resolve import ON_BORDER, Resolved
from grainfront.geometry.signed_distance import (
    SignedDistances,
    mark_cells,
    mark_inside,
    measure_points,
    ray_parity,
)
from grainfront.particles import Rectangle

# So many cells for each segment in the domain leave few segments in a cell; four times as many are
# no faster to ask. The bounds keep simple zones sharp and the lists of large ones short.
CELLS_A_SEGMENT, FEWEST_CELLS, MOST_CELLS = 8, 1 << 12, 1 << 18
# Cells look for segments beyond their edges by this share of their width, so that rounding, which
# is far less, never puts a point into a cell that does not know its segments.
CELL_MARGIN = 0.01

# How many segments each cell of a zone has, and all of them.
Lists = tuple[np.ndarray, np.ndarray]


def signed_distances(
    zones: Sequence[Resolved], domain: Rectangle, measured: Sequence[bool] | None = None
) -> SignedDistances:
    """The distance grid of zones over a domain; zone k of the kernels is `zones[k]`.

    Zones that are not `measured` know which points they hold, and no distances: these take most of
    the time and memory where there are many zones.
    """
    measured = [True] * len(zones) if measured is None else measured
    edges = [_edges(zone.polygon) for zone in zones]
    kept = [e[_bounding(e, zone.window)] for e, zone in zip(edges, zones, strict=True)]
    cell, columns, rows = _grid(kept, domain)
    touching: list[Lists] = []
    nearest: list[Lists] = []
    first = 0
    for one, distances in zip(kept, measured, strict=True):
        pairs = _pairs(one, domain, cell, columns, rows, distances)
        for lists, (cells, segments) in zip((touching, nearest), pairs, strict=True):
            lists.append((np.bincount(cells, minlength=columns * rows), segments + first))
        first += len(one)
    segment = np.concatenate(kept)
    squared = np.sum((segment[:, 2:] - segment[:, :2]) ** 2, axis=1)
    field = SignedDistances(
        domain.x_min, domain.y_min, cell, columns, rows,
        np.column_stack([segment, 1.0 / squared]),
        np.zeros(len(kept) * columns * rows, dtype=np.int8),
        *_lists(touching), *_lists(nearest),
    )  # fmt: skip
    for zone, closed in enumerate(edges):
        inside = ray_parity(closed, 0, len(closed), domain.x_min, domain.y_min)
        mark_cells(field, zone, inside)
    return field


def distance_at(field: SignedDistances, zone: int, x: ArrayLike, y: ArrayLike) -> np.ndarray:
    """Signed distances of points to a zone, negative inside; the shape of `x` and `y` together.

    Raises ValueError for points outside the domain of the grid.
    """
    x, y = _inside_grid(field, x, y)
    distance = np.empty(x.size)
    measure_points(field, zone, x.ravel(), y.ravel(), distance)
    return distance.reshape(x.shape)


def inside_at(field: SignedDistances, zone: int, x: ArrayLike, y: ArrayLike) -> np.ndarray:
    """Whether points lie inside a zone; bool of the shape of `x` and `y` together.

    Raises ValueError for points outside the domain of the grid.
    """
    x, y = _inside_grid(field, x, y)
    inside = np.empty(x.size, dtype=np.bool_)
    mark_inside(field, zone, x.ravel(), y.ravel(), inside)
    return inside.reshape(x.shape)


def _inside_grid(
    field: SignedDistances, x: ArrayLike, y: ArrayLike
) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
    column, row = (x - field.x_min) / field.cell, (y - field.y_min) / field.cell
    inside = (column >= 0) & (column <= field.columns) & (row >= 0) & (row <= field.rows)
    if not inside.all():
        raise ValueError("a point lies outside the domain over which the distances are known")
    return np.ascontiguousarray(x), np.ascontiguousarray(y)


def _edges(polygon: shapely.Geometry) -> np.ndarray:
    """All edges of polygons with holes, shape (n, 4): both ends."""
    rings = shapely.get_rings(shapely.get_parts(polygon))
    nodes, ring = shapely.get_coordinates(rings, return_index=True)
    edges = np.hstack([nodes[:-1], nodes[1:]])[ring[:-1] == ring[1:]]
    return np.ascontiguousarray(edges[(edges[:, :2] != edges[:, 2:]).any(axis=1)])


def _bounding(edges: np.ndarray, window: Rectangle) -> np.ndarray:
    """Which edges bound the zone, and do not merely cut it off at the window."""
    slack = ON_BORDER * max(window.width, window.height)
    border = np.zeros(len(edges), dtype=np.bool_)
    for axis, value in ((0, window.x_min), (0, window.x_max), (1, window.y_min), (1, window.y_max)):
        border |= (np.abs(edges[:, axis::2] - value) <= slack).all(axis=1)
    return ~border


def _grid(edges: Sequence[np.ndarray], domain: Rectangle) -> tuple[float, int, int]:
    """Width of the square cells, and how many columns and rows of them cover the domain."""
    box = shapely.box(domain.x_min, domain.y_min, domain.x_max, domain.y_max)
    lines = [shapely.linestrings(e.reshape(-1, 2, 2)) for e in edges]
    seen = sum(int(shapely.intersects(one, box).sum()) for one in lines)
    cells = min(max(CELLS_A_SEGMENT * seen, FEWEST_CELLS), MOST_CELLS)
    cell = math.sqrt(domain.area / cells)
    return cell, math.ceil(domain.width / cell), math.ceil(domain.height / cell)


def _pairs(
    edges: np.ndarray, domain: Rectangle, cell: float, columns: int, rows: int, distances: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Cells and the segments that touch them, cells and the segments nearest to points of them.

    The latter are none where there are to be no `distances`.
    """
    if not len(edges):
        return np.empty((2, 0), np.int64), np.empty((2, 0), np.int64)
    tree = shapely.STRtree(shapely.linestrings(edges.reshape(-1, 2, 2)))
    x, y = np.meshgrid(
        domain.x_min + cell * np.arange(columns), domain.y_min + cell * np.arange(rows)
    )
    x, y, margin = x.ravel(), y.ravel(), CELL_MARGIN * cell
    boxes = shapely.box(x - margin, y - margin, x + cell + margin, y + cell + margin)
    touching = _by_cell(tree.query(boxes, predicate="intersects"))
    if not distances:
        return touching, np.empty((2, 0), np.int64)
    centres = shapely.points(x + cell / 2, y + cell / 2)
    _, least = tree.query_nearest(centres, return_distance=True, all_matches=False)
    # every point of a cell is within half its diagonal of the centre, and so is its nearest segment
    # within that more than the centre's nearest, seen from the point
    reach = least + math.sqrt(2.0) * cell + 4.0 * margin
    return touching, _by_cell(tree.query(centres, predicate="dwithin", distance=reach))


def _by_cell(pairs: np.ndarray) -> np.ndarray:
    """Pairs in the order of their cells."""
    return pairs[:, np.argsort(pairs[0], kind="stable")]


def _lists(parts: Sequence[Lists]) -> tuple[np.ndarray, np.ndarray]:
    """Segments of all cells of all zones, and their offsets."""
    counts = np.concatenate([count for count, _ in parts])
    segments = np.concatenate([segment for _, segment in parts])
    return segments.astype(np.int32), np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
