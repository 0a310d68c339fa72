"""Obstacles of a domain of any shape: what is outside, cut into convex pieces, and their cells."""

from __future__ import annotations

import math

import numpy as np
import shapely

from grainfront.geometry.pieces import convex_pieces
from grainfront.geometry.placing import radii_about_origin
from grainfront.packing.arranged import NO_MEMBER
from grainfront.packing.state import Obstacles, Placed, Reached
from grainfront.particles import Region
from grainfront.polygons import Polygons

# Pieces reach this far beyond the bounding rectangle, in its longer sides: enough for them to be
# no thinner than the domain is.
BORDER = 0.5
# A front begins only where no particle lies within so many circumradii of its first one: a hollow
# that a front has left empty along a wall is no part that it has not reached.
EMPTY_ABOUT = 3.0
# Cells are as wide as the median particle, unless they were more than this: finer cells cost memory
# and tell no better which obstacles are near.
MOST_CELLS = 2**18
# Cells are grown by this share of themselves, so that rounding leaves no obstacle out.
CELL_MARGIN = 1e-6
# Members whose obstacles are listed at a time, those of a local front and more, and obstacles in
# their lists: with hundreds to each, lists are made for every particle, but not for every trial.
N_LISTS = 64
MOST_ITEMS = 2**14


def outside_pieces(region: Region) -> Polygons:
    """Convex pieces of what lies outside the region, up to a border about its rectangle.

    All their nodes are nodes of the region or corners of the border.
    """
    border = BORDER * max(region.width, region.height)
    around = shapely.box(
        region.x_min - border, region.y_min - border, region.x_max + border, region.y_max + border
    )
    return Polygons.of(convex_pieces(shapely.difference(around, region.to_shapely())))


def discs_of(pieces: Polygons) -> np.ndarray:
    """Centroid, circumradius and inradius about it of each piece, shape (n_pieces, 4)."""
    centre = shapely.get_coordinates(shapely.centroid(pieces.to_shapely()))
    circumradius, inradius = np.empty(pieces.count), np.empty(pieces.count)
    relative = pieces.nodes - np.repeat(centre, pieces.node_counts, axis=0)
    radii_about_origin(relative, pieces.offsets, circumradius, inradius)
    return np.column_stack([centre, circumradius, inradius])


def add_obstacles(
    placed: Placed,
    region: Region,
    fixed: Polygons | None,
    circumradius: np.ndarray,
    largest: float,
) -> tuple[Placed, Obstacles]:
    """Store the pieces outside the region behind the particles.

    `circumradius` (n,) is that of the particles, none of which will exceed `largest`. `fixed` are
    convex particles to be packed around, which may leave but hollows: each of them may get a front
    of its own.
    """
    pieces = outside_pieces(region)
    if fixed is not None:
        pieces = Polygons.of(p.polygon(i) for p in (pieces, fixed) for i in range(p.count))
    first = len(placed.offsets)
    longer = placed._replace(
        nodes=np.concatenate([placed.nodes, pieces.nodes]),
        offsets=np.concatenate([placed.offsets, len(placed.nodes) + pieces.offsets]),
        disc=np.concatenate([placed.disc, np.zeros((1, 4)), discs_of(pieces)]),
    )
    return longer, make_obstacles(region, fixed, pieces, first, circumradius, largest)


def make_obstacles(
    region: Region,
    fixed: Polygons | None,
    pieces: Polygons,
    first: int,
    circumradius: np.ndarray,
    largest: float,
) -> Obstacles:
    """The cells of the pieces, of which `first` is the first index; see `add_obstacles`."""
    median = float(np.median(circumradius))
    cell = max(2.0 * median, math.sqrt(region.width * region.height / MOST_CELLS))
    columns, rows = math.floor(region.width / cell) + 1, math.floor(region.height / cell) + 1
    row, column = np.divmod(np.arange(columns * rows), columns)
    x, y = region.x_min + column * cell, region.y_min + row * cell
    margin = CELL_MARGIN * cell
    cells = shapely.box(x - margin, y - margin, x + cell + margin, y + cell + margin)
    shapes = pieces.to_shapely()
    tree = shapely.STRtree(shapes)
    owner, item = tree.query(cells, predicate="intersects")
    start, item = _lists(owner, item, columns * rows)
    reach = (2.0 + CELL_MARGIN) * largest
    one, other = tree.query(shapes, predicate="dwithin", distance=reach)
    beside_start, beside = _lists(one[one != other], other[one != other], pieces.count)
    return Obstacles(
        first=first,
        empty_about=EMPTY_ABOUT if fixed is None else 0.0,
        box=np.ascontiguousarray(shapely.bounds(shapes)),
        cell=float(cell),
        columns=columns,
        rows=rows,
        start=start,
        item=item,
        beside_start=beside_start,
        beside=beside,
        rejected=np.zeros(circumradius.size, dtype=np.bool_),
        crowded=np.zeros(pieces.count, dtype=np.bool_),
        met=np.zeros(pieces.count, dtype=np.int64),
        search=np.zeros(1, dtype=np.int64),
        overlapped=np.full(1, -1, dtype=np.int64),
        reached=make_reached(pieces.count),
        closed_to=np.full(first + 3, NO_MEMBER, dtype=np.int64),
        closed_from=np.zeros(first + 3),
        splits=np.zeros(first, dtype=np.bool_),
    )


def make_reached(n_obstacles: int) -> Reached:
    """Room for the lists of a local front, the longest of which has all obstacles."""
    n_items = n_obstacles + MOST_ITEMS
    return Reached(
        obstacle=np.empty(n_items, dtype=np.int64),
        tangent=np.empty((n_items, 2, 2), dtype=np.int64),
        filled=np.zeros(1, dtype=np.int64),
        member=np.full(N_LISTS, -1, dtype=np.int64),
        reach=np.empty(N_LISTS),
        start=np.empty(N_LISTS, dtype=np.int64),
        end=np.empty(N_LISTS, dtype=np.int64),
    )


def _lists(owner: np.ndarray, item: np.ndarray, owners: int) -> tuple[np.ndarray, np.ndarray]:
    """Where the list of each owner begins, (owners + 1,), and the items of all lists, sorted."""
    order = np.lexsort((item, owner))
    start = np.searchsorted(owner[order], np.arange(owners + 1))
    return start.astype(np.int64), item[order].astype(np.int64)
