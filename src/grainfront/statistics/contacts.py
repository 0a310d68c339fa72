"""Which particles touch, where, and in which direction they push."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from grainfront.geometry.boxes import bounding_boxes, close_pairs
from grainfront.geometry.nearness import near_nodes_and_edges
from grainfront.geometry.rings import neighbours
from grainfront.particles import CONTACT_TOLERANCE, Cell, Packing, Region, tiled
from grainfront.polygons import Polygons


@dataclass(frozen=True)
class Contacts:
    """Pairs of particles that touch, and particles that touch a wall.

    `pairs` has shape (n_contacts, 2), first index smaller, sorted; `position` and `normal` have the
    same shape, lengths in the scene's unit. The normal has length 1 and points from the first
    particle to the second. A pair that touches along an edge is one contact, in the middle of the
    shared segment. `wall_particle` and `wall` have shape (n_wall_contacts,); walls are numbered
    left 0, bottom 1, right 2, top 3; those of a domain of any shape by its rings, in their order.
    """

    pairs: np.ndarray
    position: np.ndarray
    normal: np.ndarray
    wall_particle: np.ndarray
    wall: np.ndarray

    def per_particle(self, particles: int) -> np.ndarray:
        """Contacts with other particles of each particle, shape (particles,)."""
        return np.bincount(self.pairs.ravel(), minlength=particles)


def find_contacts(packing: Packing) -> Contacts:
    """Find the pairs whose gap is at most `CONTACT_TOLERANCE` × mean size, walls apart.

    In a periodic cell, contacts with the images of its particles count too, each once.
    """
    if isinstance(packing.domain, Cell):
        return _contacts_of_cell(packing, packing.domain)
    tolerance = CONTACT_TOLERANCE * float(packing.size.mean())
    polygons, domain = packing.polygons, packing.domain
    boxes = bounding_boxes(polygons.nodes, polygons.offsets)
    if isinstance(domain, Region):
        wall_particle, wall = _ring_contacts(polygons, domain, tolerance)
    else:
        lower = boxes[:, :2] - [domain.x_min, domain.y_min]
        upper = [domain.x_max, domain.y_max] - boxes[:, 2:]
        wall_particle, wall = np.nonzero(np.hstack([lower, upper]) <= tolerance)
    return Contacts(*_pair_contacts(polygons, boxes, tolerance), wall_particle, wall)


def _contacts_of_cell(packing: Packing, cell: Cell) -> Contacts:
    """Of the contacts of the tiled cell, those of its own particles, and with images one of two."""
    whole, n = find_contacts(tiled(packing)), packing.x.size
    first, second = whole.pairs.T
    kept = (first < n) & (first < second % n)
    walls = (whole.wall_particle < n) & np.isin(whole.wall, () if cell.along_y else (1, 3))
    return Contacts(
        np.column_stack([first, second % n])[kept],
        whole.position[kept],
        whole.normal[kept],
        whole.wall_particle[walls],
        whole.wall[walls],
    )


def _ring_contacts(
    polygons: Polygons, region: Region, tolerance: float
) -> tuple[np.ndarray, np.ndarray]:
    """Particles that touch a ring of the region and the number of the ring, (n,) each, sorted."""
    nodes, offsets = region.rings.nodes, region.rings.offsets
    _, after = neighbours(offsets)
    tree = shapely.STRtree(shapely.linestrings(np.stack([nodes, nodes[after]], axis=1)))
    shapes = polygons.to_shapely()
    particle, edge = tree.query(shapes, predicate="dwithin", distance=tolerance)
    ring = np.searchsorted(offsets, edge, side="right") - 1
    touching = np.unique(np.column_stack([particle, ring]), axis=0)
    return touching[:, 0], touching[:, 1]


def _pair_contacts(
    polygons: Polygons, boxes: np.ndarray, tolerance: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pairs, positions and normals.

    Where two boundaries come close, a node of one is close to an edge of the other; a shared
    segment ends in such nodes. Each close node and edge votes for the edge's normal, unless the
    node's neighbours lie deeper behind the edge than those of a rival: where two nodes meet, that
    leaves the edges that separate the particles.
    """
    nodes = polygons.nodes
    before, after = neighbours(polygons.offsets)
    pairs = close_pairs(boxes, tolerance)
    row, node, edge = near_nodes_and_edges(nodes, polygons.offsets, boxes, pairs, tolerance)
    if node.size == 0:
        return np.empty((0, 2), dtype=np.int64), np.empty((0, 2)), np.empty((0, 2))
    _, starts, pair = np.unique(row, return_index=True, return_inverse=True)
    ends = pairs[row]

    start, along = nodes[edge], nodes[after[edge]] - nodes[edge]
    outward = np.column_stack([along[:, 1], -along[:, 0]])
    outward /= np.hypot(along[:, 0], along[:, 1])[:, None]
    depth = np.min([_dot(nodes[k] - start, outward) for k in (before[node], node, after[node])], 0)
    separates = depth >= np.maximum.reduceat(depth, starts)[pair] - tolerance
    of_first = edge < polygons.offsets[ends[:, 0] + 1]
    votes = np.where(of_first, 1.0, -1.0) * separates
    normal = np.add.reduceat(votes[:, None] * outward, starts)
    normal /= np.hypot(normal[:, 0], normal[:, 1])[:, None]

    share = np.clip(_dot(nodes[node] - start, along) / _dot(along, along), 0.0, 1.0)
    point = 0.5 * (nodes[node] + start + share[:, None] * along)
    tangent = np.column_stack([-normal[:, 1], normal[:, 0]])
    place = _dot(point - point[starts][pair], tangent[pair])
    middle = 0.5 * (np.minimum.reduceat(place, starts) + np.maximum.reduceat(place, starts))
    return ends[starts], point[starts] + middle[:, None] * tangent, normal


def _dot(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return u[:, 0] * v[:, 0] + u[:, 1] * v[:, 1]
