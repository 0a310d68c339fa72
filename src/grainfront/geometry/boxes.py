"""Bounding boxes of polygons, and what comes close to them."""

from __future__ import annotations

import numpy as np
import shapely

from grainfront.jit import kernel


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


@kernel
def mark_near_boxes(nodes, offsets, boxes, pairs, distance, near_nodes, near_edges):
    """Mark the nodes and edges of either polygon of each pair that are near the other one's box.

    Near is at most `distance` along both axes; an edge counts by its own bounding box, and edge k
    starts at node k. `near_nodes` and `near_edges`, boolean of shape (n_nodes,), are added to.
    """
    for pair in range(pairs.shape[0]):
        for side in range(2):
            first, last = offsets[pairs[pair, side]], offsets[pairs[pair, side] + 1]
            other = pairs[pair, 1 - side]
            left, bottom = boxes[other, 0] - distance, boxes[other, 1] - distance
            right, top = boxes[other, 2] + distance, boxes[other, 3] + distance
            for k in range(first, last):
                x, y = nodes[k, 0], nodes[k, 1]
                after = k + 1 if k + 1 < last else first
                end_x, end_y = nodes[after, 0], nodes[after, 1]
                if left <= x <= right and bottom <= y <= top:
                    near_nodes[k] = True
                if (
                    min(x, end_x) <= right
                    and max(x, end_x) >= left
                    and min(y, end_y) <= top
                    and max(y, end_y) >= bottom
                ):
                    near_edges[k] = True
