"""Exact proof that the particles of a packing are disjoint and inside their domain."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from grainfront.errors import InputError
from grainfront.geometry.boxes import bounding_boxes, close_pairs, pairs_between
from grainfront.geometry.exact import (
    convex_hull,
    edges_surround,
    hull_surrounds,
    hulls_disjoint,
    is_convex,
    is_simple,
)
from grainfront.geometry.outlines import interiors_meet, lies_inside
from grainfront.geometry.rings import neighbours
from grainfront.jit import kernel
from grainfront.particles import Cell, Packing, Rectangle, Region, tiled
from grainfront.polygons import Polygons


@dataclass(frozen=True)
class Certificate:
    """What `certify` found; it holds where both counts of offenders are zero.

    `pairs_tested` are the pairs of particles whose bounding boxes meet, `pairs_exact` those of them
    that floating point could not decide. `overlapping_pairs` has shape (overlaps, 2),
    `particles_across_wall` shape (across_wall,); both index the packing's particles.
    """

    particles: int
    pairs_tested: int
    pairs_exact: int
    overlaps: int
    across_wall: int
    overlapping_pairs: np.ndarray
    particles_across_wall: np.ndarray

    @property
    def holds(self) -> bool:
        """Whether no two particles share interior points and none crosses a wall."""
        return self.overlaps == 0 and self.across_wall == 0


def certify(packing: Packing) -> Certificate:
    """Count, exactly, the particles that share interior points and those that cross a wall.

    The verdict is that of rational arithmetic on the stored float64 coordinates: touching is no
    overlap, and one unit in the last place of penetration is one; so with walls, of rectangles and
    of domains of any shape. Hulls are decided by the theorem of separating edges; outlines by their
    hulls and, where those overlap, by the outlines themselves. Raises InputError where a polygon is
    not finite, simple and counter-clockwise. A periodic cell is tiled, 3 × 3 where both axes
    repeat.
    """
    if isinstance(packing.domain, Cell) and packing.x.size:
        return _certify_cell(packing)
    polygons = packing.polygons
    if polygons.count == 0:
        none = np.empty(0, dtype=np.int64)
        return Certificate(0, 0, 0, 0, 0, none.reshape(0, 2), none)
    convex = _check_polygons(polygons)
    boxes = bounding_boxes(polygons.nodes, polygons.offsets)
    pairs = close_pairs(boxes, 0.0)
    hulls = polygons if convex.all() else _exact_hulls(polygons)
    disjoint, exact = np.empty((2, len(pairs)), dtype=np.bool_)
    _separate(hulls.nodes, hulls.offsets, hulls.nodes, hulls.offsets, pairs, disjoint, exact)

    overlapping = ~disjoint
    for k in np.flatnonzero(overlapping & ~convex[pairs].all(axis=1)):
        i, j = pairs[k]
        overlapping[k] = interiors_meet(polygons.polygon(i), polygons.polygon(j))
        exact[k] = True
    across = _across_wall(boxes, packing.domain)
    if isinstance(packing.domain, Region):
        outside = _outside(polygons, hulls, boxes, convex, packing.domain)
        across = np.union1d(across, outside)
    return Certificate(
        particles=polygons.count,
        pairs_tested=len(pairs),
        pairs_exact=int(exact.sum()),
        overlaps=int(overlapping.sum()),
        across_wall=across.size,
        overlapping_pairs=pairs[overlapping],
        particles_across_wall=across,
    )


def _certify_cell(packing: Packing) -> Certificate:
    """The certificate of the cell with those about it, told of the particles of the cell."""
    whole, n = certify(tiled(packing)), packing.x.size
    pairs = np.unique(np.sort(whole.overlapping_pairs % n, axis=1), axis=0)
    across = np.unique(whole.particles_across_wall % n)
    return replace(
        whole, particles=n, overlaps=len(pairs), across_wall=across.size,
        overlapping_pairs=pairs, particles_across_wall=across,
    )  # fmt: skip


def _check_polygons(polygons: Polygons) -> np.ndarray:
    """Refuse what is no polygon; returns which polygons are convex."""
    few = np.flatnonzero(polygons.node_counts < 3)
    if few.size:
        raise InputError(
            f"Particle {few[0]} has {polygons.node_counts[few[0]]} nodes; "
            "a polygon needs at least three."
        )
    infinite = np.flatnonzero(~np.isfinite(polygons.nodes).all(axis=1))
    if infinite.size:
        particle = np.searchsorted(polygons.offsets, infinite[0], side="right") - 1
        raise InputError(f"Particle {particle} has a node that is not finite.")
    convex = np.empty(polygons.count, dtype=np.bool_)
    _mark_convex(polygons.nodes, polygons.offsets, convex)
    if not convex.all():
        simple = convex.copy()
        _mark_simple(polygons.nodes, polygons.offsets, _edges_from_left(polygons), simple)
        if not simple.all():
            raise InputError(
                f"The polygon of particle {np.flatnonzero(~simple)[0]} is not simple and "
                "counter-clockwise; only such polygons can be certified."
            )
    return convex


def _edges_from_left(polygons: Polygons) -> np.ndarray:
    """For each polygon, its edges in the order of their left ends; edge i ends at node i."""
    before, _ = neighbours(polygons.offsets)
    x = polygons.nodes[:, 0]
    owner = np.repeat(np.arange(polygons.count), polygons.node_counts)
    return np.lexsort((np.minimum(x, x[before]), owner)) - polygons.offsets[owner]


def _exact_hulls(polygons: Polygons) -> Polygons:
    owner = np.repeat(np.arange(polygons.count), polygons.node_counts)
    order = np.lexsort((polygons.nodes[:, 1], polygons.nodes[:, 0], owner))
    order -= polygons.offsets[owner]
    kept = np.empty(len(polygons.nodes), dtype=np.int64)
    offsets = np.zeros(polygons.count + 1, dtype=np.int64)
    scratch = np.empty(2 * polygons.node_counts.max(), dtype=np.int64)
    _find_hulls(polygons.nodes, polygons.offsets, order, scratch, kept, offsets)
    return Polygons(polygons.nodes[kept[: offsets[-1]]], offsets)


def _across_wall(boxes: np.ndarray, domain: Rectangle) -> np.ndarray:
    return np.flatnonzero(
        (boxes[:, 0] < domain.x_min)
        | (boxes[:, 1] < domain.y_min)
        | (boxes[:, 2] > domain.x_max)
        | (boxes[:, 3] > domain.y_max)
    )


def _outside(
    polygons: Polygons, hulls: Polygons, boxes: np.ndarray, convex: np.ndarray, region: Region
) -> np.ndarray:
    """Particles that are not inside the region, sorted.

    A hull is inside if no edge of the region crosses its interior and one point of the interior is
    inside; where its hull is not, an outline is decided by itself.
    """
    edges = _edges_of(region.rings)
    pairs = pairs_between(boxes, bounding_boxes(edges.nodes, edges.offsets))
    clear, exact = np.empty((2, len(pairs)), dtype=np.bool_)
    _separate(hulls.nodes, hulls.offsets, edges.nodes, edges.offsets, pairs, clear, exact)
    inside = np.empty(hulls.count, dtype=np.bool_)
    _mark_inside(hulls.nodes, hulls.offsets, edges.nodes, inside)
    crossed = np.zeros(hulls.count, dtype=np.bool_)
    crossed[pairs[~clear, 0]] = True
    for k in np.flatnonzero((crossed & ~convex) | ~(crossed | inside)).tolist():
        inside[k] = lies_inside(polygons.polygon(k), edges.nodes.reshape(-1, 2, 2))
        crossed[k] = False
    return np.flatnonzero(crossed | ~inside)


def _edges_of(rings: Polygons) -> Polygons:
    """Each edge of the rings as a polygon of two nodes."""
    _, after = neighbours(rings.offsets)
    nodes = np.stack([rings.nodes, rings.nodes[after]], axis=1).reshape(-1, 2)
    return Polygons(nodes, np.arange(0, len(nodes) + 1, 2))


@kernel
def _mark_convex(nodes, offsets, convex):
    for i in range(convex.size):
        convex[i] = is_convex(nodes[offsets[i] : offsets[i + 1]])


@kernel
def _mark_simple(nodes, offsets, order, simple):
    """Decide those that are not marked yet."""
    for i in range(simple.size):
        if not simple[i]:
            first, last = offsets[i], offsets[i + 1]
            simple[i] = is_simple(nodes[first:last], order[first:last])


@kernel
def _find_hulls(nodes, offsets, order, scratch, kept, hull_offsets):
    for i in range(offsets.size - 1):
        first, last = offsets[i], offsets[i + 1]
        size = convex_hull(nodes[first:last], order[first:last], scratch)
        start = hull_offsets[i]
        hull_offsets[i + 1] = start + size
        for k in range(size):
            kept[start + k] = first + scratch[k]


@kernel
def _separate(nodes, offsets, other_nodes, other_offsets, pairs, disjoint, exact):
    for k in range(pairs.shape[0]):
        i, j = pairs[k, 0], pairs[k, 1]
        disjoint[k], exact[k] = hulls_disjoint(
            nodes[offsets[i] : offsets[i + 1]],
            other_nodes[other_offsets[j] : other_offsets[j + 1]],
        )


@kernel
def _mark_inside(nodes, offsets, edges, inside):
    """Mark convex polygons whose mean node lies inside both themselves and the region."""
    for i in range(inside.size):
        hull = nodes[offsets[i] : offsets[i + 1]]
        x, y = 0.0, 0.0
        for k in range(hull.shape[0]):
            x += hull[k, 0] / hull.shape[0]
            y += hull[k, 1] / hull.shape[0]
        inside[i] = hull_surrounds(hull, x, y) and edges_surround(edges, x, y)
