"""Outlines that are hard on floating point: edges nearly parallel, vertices nearly in line."""

from __future__ import annotations

import numpy as np

from grainfront.polygons import Polygons


def tilted(angle: float) -> Polygons:
    """A quadrilateral, 2 by 1, whose upper edge is tilted against the lower one, in radians."""
    rise = 2.0 * np.tan(angle)
    return Polygons.of([np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0 + rise], [0.0, 1.0]])])


def bulging(sagitta: float) -> Polygons:
    """A rectangle, 2 by 1, with a vertex in the middle of each long edge, bulging by `sagitta`."""
    low, high = -sagitta, 1.0 + sagitta
    return Polygons.of(
        [np.array([[0.0, 0.0], [1.0, low], [2.0, 0.0], [2.0, 1.0], [1.0, high], [0.0, 1.0]])]
    )


def sliver(aspect_ratio: float) -> Polygons:
    """A triangle with a base of `aspect_ratio` and a height of 1, its top off the middle."""
    return Polygons.of([np.array([[0.0, 0.0], [aspect_ratio, 0.0], [0.3 * aspect_ratio, 1.0]])])


def many_edges(n: int) -> Polygons:
    """An ellipse of aspect ratio 1.5 as a polygon of `n` vertices."""
    angle = 2.0 * np.pi * np.arange(n) / n
    return Polygons.of([np.column_stack([1.5 * np.cos(angle), np.sin(angle)])])
