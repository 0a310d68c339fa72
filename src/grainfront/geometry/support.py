"""Support vertices of convex polygons, and the slices that name a polygon inside a node array.

Conventions of all kernels here: a polygon is `nodes[start:start + count]`, counter-clockwise and
strictly convex; its vertices are numbered from 0. `nodes` is float64 of shape (n_nodes, 2).
"""

from __future__ import annotations

import numpy as np

from grainfront.jit import inlined


@inlined
def at(nodes, node, axis):
    """A coordinate of a node; an unsigned index saves the test for one that counts from the end."""
    return nodes[np.uint64(node), axis]


@inlined
def cross(ax, ay, bx, by):
    """z component of a × b: positive where b lies counter-clockwise of a."""
    return ax * by - ay * bx


@inlined
def after(i, count):
    """The next vertex counter-clockwise."""
    return i + 1 if i + 1 < count else 0


@inlined
def before(i, count):
    """The next vertex clockwise."""
    return i - 1 if i > 0 else count - 1


@inlined
def support(nodes, start, count, dx, dy):
    """Vertex that lies farthest in the direction (dx, dy); the first of several."""
    best = 0
    reach = at(nodes, start, 0) * dx + at(nodes, start, 1) * dy
    for i in range(1, count):
        value = at(nodes, start + i, 0) * dx + at(nodes, start + i, 1) * dy
        if value > reach:
            reach = value
            best = i
    return best


@inlined
def climb(nodes, start, count, i, dx, dy):
    """Vertex that lies farthest in the direction (dx, dy), climbing from vertex i."""
    reach = at(nodes, start + i, 0) * dx + at(nodes, start + i, 1) * dy
    turned = False
    for _ in range(count):
        n = after(i, count)
        value = at(nodes, start + n, 0) * dx + at(nodes, start + n, 1) * dy
        if value <= reach:
            break
        i, reach, turned = n, value, True
    if not turned:
        for _ in range(count):
            n = before(i, count)
            value = at(nodes, start + n, 0) * dx + at(nodes, start + n, 1) * dy
            if value <= reach:
                break
            i, reach = n, value
    return i
