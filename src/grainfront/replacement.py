"""Nonconvex particles: each packed hull gives way to the outline it was taken from.

Du, Liu, Han & Deng (2023), section 4.3.4.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainfront.errors import InputError
from grainfront.geometry.exact import draw_into_hulls
from grainfront.geometry.rings import polygon_areas
from grainfront.particles import Packing
from grainfront.polygons import Polygons

MATCH_TOLERANCE = 1e-6
"""How far, in sizes, a packed hull may lie from the transformed hull of the database.

Rounding moves nodes by 1e-16 of their coordinates; another database's hulls are off by about 1.
"""


def replace_hulls(
    packing: Packing, outlines: Polygons, hulls: Polygons, hull_nodes: np.ndarray
) -> Packing:
    """Replace each packed hull by its own outline, under the same rotation, scaling and shift.

    `outlines` and `hulls` are those of the shape database: standardised, one an entry.
    `hull_nodes`, int64 of shape (n_hull_nodes,), holds the index into `outlines.nodes` of each node
    of `hulls`. Nodes of the hull keep the packed coordinates bit for bit. Any other node that
    rounding would put outside the packed hull is drawn to the hull's inside, by about a unit in the
    last place, so that disjoint hulls give disjoint outlines. Area and circumradius become those of
    the outlines. Raises InputError where the packing does not come from these shapes.
    """
    shape = packing.shape
    if packing.polygons.count and (shape.min() < 0 or shape.max() >= outlines.count):
        raise InputError(
            f"The packing names shapes {shape.min()} to {shape.max()}, "
            f"but the shape database has entries 0 to {outlines.count - 1}."
        )
    packed = packing.polygons
    hull_owner, hull_source = _gather(hulls, shape)
    expected = _transform(packing, hull_owner, hulls.nodes[hull_source])
    _check_same_hulls(packing, hulls, expected)

    owner, source = _gather(outlines, shape)
    nodes = _transform(packing, owner, outlines.nodes[source])
    offsets = np.zeros(packed.count + 1, dtype=np.int64)
    np.cumsum(outlines.node_counts[shape], out=offsets[1:])
    on_hull = offsets[hull_owner] + hull_nodes[hull_source] - outlines.offsets[shape[hull_owner]]
    nodes[on_hull] = packed.nodes
    movable = np.ones(len(nodes), dtype=np.bool_)
    movable[on_hull] = False
    centres = np.column_stack([packing.x, packing.y])
    draw_into_hulls(nodes, offsets, movable, packed.nodes, packed.offsets, centres)

    replaced = Polygons(nodes, offsets)
    relative = nodes - centres[owner]
    return replace(
        packing,
        polygons=replaced,
        area=polygon_areas(relative, offsets),
        circumradius=_largest(np.hypot(relative[:, 0], relative[:, 1]), offsets),
    )


def _gather(polygons: Polygons, shape: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For each node that the particles get: the particle, and the node's index in the database."""
    counts = polygons.node_counts[shape]
    owner = np.repeat(np.arange(shape.size), counts)
    within = np.arange(owner.size) - np.repeat(np.cumsum(counts) - counts, counts)
    return owner, polygons.offsets[shape[owner]] + within


def _transform(packing: Packing, owner: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    angle = np.radians(packing.orientation)
    cos, sin = (packing.size * np.cos(angle))[owner], (packing.size * np.sin(angle))[owner]
    x, y = nodes[:, 0], nodes[:, 1]
    return np.column_stack(
        [packing.x[owner] + (cos * x - sin * y), packing.y[owner] + (sin * x + cos * y)]
    )


def _check_same_hulls(packing: Packing, hulls: Polygons, expected: np.ndarray) -> None:
    counts, packed_counts = hulls.node_counts[packing.shape], packing.polygons.node_counts
    different = np.flatnonzero(counts != packed_counts)
    if different.size:
        i = different[0]
        raise InputError(
            f"Particle {i} has {packed_counts[i]} nodes, but the hull of its shape "
            f"{packing.shape[i]} has {counts[i]}: the packing is not made of these shapes."
        )
    off = np.abs(packing.polygons.nodes - expected).max(axis=1)
    off = np.flatnonzero(off > MATCH_TOLERANCE * np.repeat(packing.size, counts))
    if off.size:
        i = np.searchsorted(packing.polygons.offsets, off[0], side="right") - 1
        raise InputError(
            f"Particle {i} is not the hull of its shape {packing.shape[i]}, turned, scaled and "
            "moved: the packing is not made of these shapes."
        )


def _largest(values: np.ndarray, offsets: np.ndarray) -> np.ndarray:
    return np.maximum.reduceat(values, offsets[:-1])
