"""The plain Minkowski sum and the overlap check built on it (Du et al. 2023, section 3).

The packing kernels never build a sum; these are their oracles and tools for notebooks.
"""

from __future__ import annotations

import numpy as np

from grainfront.geometry.rings import polygon_areas

OVERLAPPING, TOUCHING, APART = -1, 0, 1


def minkowski_sum(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The Minkowski sum A ⊕ B of two convex polygons, by merging their edges by direction.

    `a` (n, 2) and `b` (m, 2) are counter-clockwise; so is the sum, of at most n + m nodes: parallel
    edges become one. It begins at its lowest node, the leftmost of several.
    """
    a, b = _from_lowest(a), _from_lowest(b)
    edges = np.concatenate([_edges(a), _edges(b)])
    edges = edges[np.argsort(_direction(edges), kind="stable")]
    nodes = a[0] + b[0] + np.concatenate([np.zeros((1, 2)), np.cumsum(edges, axis=0)[:-1]])
    before = np.roll(edges, 1, axis=0)
    turns = before[:, 0] * edges[:, 1] - before[:, 1] * edges[:, 0] != 0.0
    return nodes[turns]


def no_fit_polygon(a: np.ndarray, n: np.ndarray) -> np.ndarray:
    """The no-fit polygon A ⊕ −N: where the origin of N is while N touches A from outside."""
    return minkowski_sum(a, -np.asarray(n, dtype=np.float64))


def overlap_state(a: np.ndarray, b: np.ndarray, tolerance: float = 0.0) -> int:
    """Whether two convex polygons overlap (−1), touch within `tolerance` (0) or are apart (1).

    `a` (n, 2) and `b` (m, 2) are counter-clockwise, `tolerance` is a length. They overlap where the
    origin lies inside A ⊕ −B, and touch where it lies on its boundary (Du et al. 2023,
    Pseudocode 2, whose signs are not known to us).
    """
    boundary = no_fit_polygon(a, b)
    edges = np.roll(boundary, -1, axis=0) - boundary
    lengths = np.hypot(*edges.T)
    # signed distances of the origin from the edge lines, positive inside
    depths = (edges[:, 1] * boundary[:, 0] - edges[:, 0] * boundary[:, 1]) / lengths
    if depths.min() > tolerance:
        return OVERLAPPING
    along = np.clip(-np.einsum("ij,ij->i", boundary, edges) / lengths**2, 0.0, 1.0)
    nearest = np.hypot(*(boundary + along[:, None] * edges).T).min()
    return TOUCHING if nearest <= tolerance or depths.min() >= 0.0 else APART


def _from_lowest(polygon: np.ndarray) -> np.ndarray:
    """The polygon, beginning at its lowest node, the leftmost of several."""
    polygon = np.asarray(polygon, dtype=np.float64)
    if polygon.ndim != 2 or polygon.shape[1] != 2 or len(polygon) < 3:
        raise ValueError(f"a polygon has shape (n, 2) with n of 3 or more, not {polygon.shape}")
    if polygon_areas(polygon, np.array([0, len(polygon)]))[0] <= 0.0:
        raise ValueError("a polygon runs counter-clockwise round a positive area")
    return np.roll(polygon, -np.lexsort((polygon[:, 0], polygon[:, 1]))[0], axis=0)


def _edges(polygon: np.ndarray) -> np.ndarray:
    return np.roll(polygon, -1, axis=0) - polygon


def _direction(edges: np.ndarray) -> np.ndarray:
    """Angles in [0, 2π): the order in which a polygon from its lowest node meets its edges."""
    return np.mod(np.arctan2(edges[:, 1], edges[:, 0]), 2.0 * np.pi)
