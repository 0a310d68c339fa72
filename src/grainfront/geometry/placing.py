"""Radii of standardised polygons, and their placing."""

from __future__ import annotations

import math

from grainfront.geometry.support import after, cross
from grainfront.jit import inlined, kernel


@inlined
def place_polygon(nodes, first, count, size, orientation, x, y, target, start):
    """Write a standardised polygon scaled by `size`, turned by `orientation` degrees, at (x, y)."""
    angle = math.radians(orientation)
    c = math.cos(angle) * size
    s = math.sin(angle) * size
    for i in range(count):
        target[start + i, 0] = x + (c * nodes[first + i, 0] - s * nodes[first + i, 1])
        target[start + i, 1] = y + (s * nodes[first + i, 0] + c * nodes[first + i, 1])


@kernel
def radii_about_origin(nodes, offsets, circumradius, inradius):
    """Largest vertex distance and least edge distance of convex polygons around the origin.

    `circumradius` and `inradius`, of shape (n_polygons,), are written.
    """
    for p in range(offsets.size - 1):
        start = offsets[p]
        count = offsets[p + 1] - start
        largest = 0.0
        smallest = math.inf
        for i in range(count):
            ax = nodes[start + i, 0]
            ay = nodes[start + i, 1]
            n = start + after(i, count)
            ex = nodes[n, 0] - ax
            ey = nodes[n, 1] - ay
            largest = max(largest, math.hypot(ax, ay))
            smallest = min(smallest, cross(ex, ey, -ax, -ay) / math.hypot(ex, ey))
        circumradius[p] = largest
        inradius[p] = smallest
