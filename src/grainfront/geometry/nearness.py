"""Where the boundaries of polygons come close."""

from __future__ import annotations

import math

import numpy as np

from grainfront.jit import inlined, kernel


@inlined
def distance_to_segment(x, y, ax, ay, bx, by):
    """Distance of the point (x, y) from the segment a → b."""
    along_x, along_y = bx - ax, by - ay
    squared = along_x * along_x + along_y * along_y
    share = (x - ax) * along_x + (y - ay) * along_y
    if share <= 0.0:
        return math.hypot(x - ax, y - ay)
    if share >= squared:
        return math.hypot(x - bx, y - by)
    return abs((ay - y) * along_x - (ax - x) * along_y) / math.sqrt(squared)


@kernel
def _find_near(nodes, offsets, boxes, pairs, distance, scratch, found):
    """As `near_nodes_and_edges`, into `found`, (n, 3), as far as it holds them: how many.

    `scratch` has room for the nodes of any polygon.
    """
    count = 0
    for pair in range(pairs.shape[0]):
        for side in range(2):
            this, other = pairs[pair, side], pairs[pair, 1 - side]
            # both polygons lie in their boxes, so that only what is near both matters
            left = max(boxes[this, 0], boxes[other, 0]) - distance
            bottom = max(boxes[this, 1], boxes[other, 1]) - distance
            right = min(boxes[this, 2], boxes[other, 2]) + distance
            top = min(boxes[this, 3], boxes[other, 3]) + distance
            n_near = 0
            for node in range(offsets[this], offsets[this + 1]):
                x, y = nodes[node, 0], nodes[node, 1]
                if left <= x <= right and bottom <= y <= top:
                    scratch[n_near] = node
                    n_near += 1
            if n_near == 0:
                continue
            before = offsets[other + 1] - 1
            for after in range(offsets[other], offsets[other + 1]):
                edge, before = before, after
                ax, ay = nodes[edge, 0], nodes[edge, 1]
                bx, by = nodes[after, 0], nodes[after, 1]
                if max(ax, bx) < left or min(ax, bx) > right:
                    continue
                if max(ay, by) < bottom or min(ay, by) > top:
                    continue
                for k in range(n_near):
                    node = scratch[k]
                    x, y = nodes[node, 0], nodes[node, 1]
                    if distance_to_segment(x, y, ax, ay, bx, by) <= distance:
                        if count < found.shape[0]:
                            found[count, 0] = pair
                            found[count, 1] = node
                            found[count, 2] = edge
                        count += 1
    return count


def near_nodes_and_edges(
    nodes: np.ndarray, offsets: np.ndarray, boxes: np.ndarray, pairs: np.ndarray, distance: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nodes of one and edges of the other polygon of each pair that are at most `distance` apart.

    `pairs`, (n_pairs, 2), holds those whose `boxes` are that close. Gives the row of the pair,
    ascending, the node and the edge, int64 of shape (n,) each; edge k starts at node k.
    """
    scratch = np.empty(int(np.diff(offsets).max(initial=0)), dtype=np.int64)
    found = np.empty((0, 3), dtype=np.int64)
    count = _find_near(nodes, offsets, boxes, pairs, distance, scratch, found)
    found = np.empty((count, 3), dtype=np.int64)
    _find_near(nodes, offsets, boxes, pairs, distance, scratch, found)
    pair, node, edge = found.T
    return pair, node, edge
