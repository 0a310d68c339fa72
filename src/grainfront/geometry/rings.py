"""Ragged rings as plain arrays: neighbours and areas, without compiled code.

Ring r has the nodes `offsets[r]` to `offsets[r + 1]`, the first not repeated at the end.
"""

from __future__ import annotations

import numpy as np


def neighbours(offsets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Index of the node before and of the node after each node round its ring, (n_nodes,) each."""
    index = np.arange(offsets[-1])
    before, after = index - 1, index + 1
    before[offsets[:-1]] = offsets[1:] - 1
    after[offsets[1:] - 1] = offsets[:-1]
    return before, after


def polygon_areas(nodes: np.ndarray, offsets: np.ndarray) -> np.ndarray:
    """Areas of ragged polygons, (n_polygons,), positive where counter-clockwise.

    `nodes`, (n_nodes, 2), may hold more nodes than the rings have.
    """
    if offsets.size == 1:
        return np.empty(0)
    _, after = neighbours(offsets)
    x, y = nodes[: offsets[-1]].T
    return 0.5 * np.add.reduceat(x * y[after] - x[after] * y, offsets[:-1])
