"""Signed distance to polylines, negative inside, and on which side of them a point lies.

Source: Du, Liu, Han, Deng (2023), doi 10.1016/j.jrmge.2022.03.009, section 4.2. The distance grid
is ours: a cell that no polyline touches knows its side, and each cell lists the segments that can
be nearest to some point in it, so that the answers are those of all segments.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grainfront.geometry.exact import orientation
from grainfront.jit import inlined, kernel

# Sides of a cell's lower left corner; of the whole cell, where no polyline touches it.
OUTSIDE, INSIDE, TOUCHED = 0, 1, 2


class SignedDistances(NamedTuple):
    """Zones of the plane, each bounded by polylines, and a grid over a box of square cells.

    Cells count along rows from the lower left corner, zone after zone. Cell c is touched by the
    segments ``touching[touching_offsets[c]:touching_offsets[c + 1]]``; ``nearest`` lists likewise
    those that are nearest to some point of it.
    """

    x_min: float
    y_min: float
    cell: float
    columns: int
    rows: int
    segment: np.ndarray  # (n_segments, 5): both ends, and 1 / length²
    state: np.ndarray  # (n_cells,) side of the lower left corner, + TOUCHED where touched
    touching: np.ndarray
    touching_offsets: np.ndarray  # (n_cells + 1,)
    nearest: np.ndarray
    nearest_offsets: np.ndarray  # (n_cells + 1,)


@inlined
def cell_at(field, x, y):
    """Column and row of the cell of a point; of the nearest cell where it lies off the grid."""
    column = min(max(int((x - field.x_min) / field.cell), 0), field.columns - 1)
    row = min(max(int((y - field.y_min) / field.cell), 0), field.rows - 1)
    return column, row


@inlined
def is_left(ax, ay, bx, by, x, y):
    """Whether a point lies left of the line a → b; a point on it is moved by (ε, ε²), ε → 0.

    Exact, and never undecided (Edelsbrunner & Mücke 1990, doi 10.1145/77635.77639).
    """
    side = orientation(ax, ay, bx, by, x, y)
    if side == 0:
        return by < ay or (by == ay and bx > ax)
    return side > 0


@inlined
def _crosses_upward(ax, ay, bx, by, x, y, y_end):
    """Whether the segment crosses the way from (x, y) to (x, y_end)."""
    if (ax <= x) == (bx <= x):
        return False
    return is_left(ax, ay, bx, by, x, y) != is_left(ax, ay, bx, by, x, y_end)


@inlined
def _crosses_sideways(ax, ay, bx, by, x, y, x_end):
    """Whether the segment crosses the way from (x, y) to (x_end, y)."""
    if (ay <= y) == (by <= y):
        return False
    return is_left(ax, ay, bx, by, x, y) != is_left(ax, ay, bx, by, x_end, y)


@inlined
def is_inside(field, zone, x, y):
    """Whether a point of the grid's box lies inside a zone; exact.

    A point on a polyline belongs to one of its sides. In a cell that a polyline touches, the side
    of its corner is carried along two legs, first up, then sideways, to the point.
    """
    column, row = cell_at(field, x, y)
    cell = (zone * field.rows + row) * field.columns + column
    state = field.state[cell]
    if state < TOUCHED:
        return state == INSIDE
    inside = state == INSIDE + TOUCHED
    corner_x = field.x_min + column * field.cell
    corner_y = field.y_min + row * field.cell
    for i in range(field.touching_offsets[cell], field.touching_offsets[cell + 1]):
        s = field.touching[i]
        ax, ay = field.segment[s, 0], field.segment[s, 1]
        bx, by = field.segment[s, 2], field.segment[s, 3]
        inside = inside != _crosses_upward(ax, ay, bx, by, corner_x, corner_y, y)
        inside = inside != _crosses_sideways(ax, ay, bx, by, corner_x, y, x)
    return inside


@inlined
def signed_distance(field, zone, x, y):
    """Distance of a point of the grid's box to the polylines of a zone, negative inside.

    The sign is exact, the distance is right up to rounding; infinite where there is no polyline.
    """
    column, row = cell_at(field, x, y)
    cell = (zone * field.rows + row) * field.columns + column
    least = np.inf
    for i in range(field.nearest_offsets[cell], field.nearest_offsets[cell + 1]):
        s = field.nearest[i]
        ax, ay = field.segment[s, 0], field.segment[s, 1]
        along_x, along_y = field.segment[s, 2] - ax, field.segment[s, 3] - ay
        to_x, to_y = x - ax, y - ay
        share = (to_x * along_x + to_y * along_y) * field.segment[s, 4]
        share = min(max(share, 0.0), 1.0)
        to_x -= share * along_x
        to_y -= share * along_y
        least = min(least, to_x * to_x + to_y * to_y)
    distance = math.sqrt(least)
    return -distance if is_inside(field, zone, x, y) else distance


@kernel
def measure_points(field, zone, x, y, distance):
    """Put the signed distances of points to a zone into `distance`; all have shape (n,)."""
    for i in range(x.size):
        distance[i] = signed_distance(field, zone, x[i], y[i])


@kernel
def mark_inside(field, zone, x, y, inside):
    """Put into `inside` (bool) whether points lie inside a zone; all have shape (n,)."""
    for i in range(x.size):
        inside[i] = is_inside(field, zone, x[i], y[i])


@kernel
def ray_parity(edge, first, last, x, y):
    """Whether a point lies inside the closed rings of edges first … last − 1 (4 columns: ends)."""
    inside = False
    for i in range(first, last):
        ax, ay, bx, by = edge[i, 0], edge[i, 1], edge[i, 2], edge[i, 3]
        if (ay <= y) != (by <= y):
            crossed = is_left(ax, ay, bx, by, x, y) != (by > ay)
            inside = inside != crossed
    return inside


@kernel
def mark_cells(field, zone, inside):
    """Fill the states of a zone's cells, given whether the grid's lower left corner is inside."""
    for row in range(field.rows):
        y = field.y_min + row * field.cell
        above = inside
        corner = inside
        for column in range(field.columns):
            x = field.x_min + column * field.cell
            cell = (zone * field.rows + row) * field.columns + column
            first, last = field.touching_offsets[cell], field.touching_offsets[cell + 1]
            field.state[cell] = (INSIDE if corner else OUTSIDE) + (TOUCHED if last > first else 0)
            for i in range(first, last):
                s = field.touching[i]
                ax, ay = field.segment[s, 0], field.segment[s, 1]
                bx, by = field.segment[s, 2], field.segment[s, 3]
                if column == 0:
                    y_next = field.y_min + (row + 1) * field.cell
                    above = above != _crosses_upward(ax, ay, bx, by, x, y, y_next)
                x_next = field.x_min + (column + 1) * field.cell
                corner = corner != _crosses_sideways(ax, ay, bx, by, x, y, x_next)
        inside = above
