"""Bounding boxes of polygons, and which of them are close."""

from __future__ import annotations

import numpy as np
import shapely


def bounding_boxes(nodes: np.ndarray, offsets: np.ndarray) -> np.ndarray:
    """Bounding boxes of ragged polygons: x_min, y_min, x_max, y_max; shape (n_polygons, 4)."""
    starts = offsets[:-1]
    return np.hstack(
        [np.minimum.reduceat(nodes, starts, axis=0), np.maximum.reduceat(nodes, starts, axis=0)]
    )


def close_pairs(boxes: np.ndarray, distance: float) -> np.ndarray:
    """Pairs (i, j), i < j, of boxes at most `distance` apart along both axes, shape (n_pairs, 2).

    Sorted by i, then j. At distance 0 the answer is exact, and touching boxes are a pair.
    """
    tree = shapely.STRtree(shapely.box(*boxes.T))
    grown = boxes + np.array([-distance, -distance, distance, distance])
    first, second = tree.query(shapely.box(*grown.T))
    kept = first < second
    pairs = np.column_stack([first[kept], second[kept]]).astype(np.int64)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def pairs_between(boxes: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Pairs (i, j) of a box and one of the others that meet, touching ones too, (n_pairs, 2)."""
    tree = shapely.STRtree(shapely.box(*others.T))
    return np.column_stack(tree.query(shapely.box(*boxes.T))).astype(np.int64)
