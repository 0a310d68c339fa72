"""The outer common tangent of two convex polygons."""

from __future__ import annotations

from grainfront.geometry.support import after, before, cross, support
from grainfront.jit import inlined


@inlined
def beyond_tangent(nodes, start, i, n, ux, uy, inward):
    """Whether vertex n lies left of the line along u through vertex i, or on it and nearer.

    `inward` is 1 where nearer to the other polygon is forward along u, and −1 where it is backward.
    """
    ex = nodes[start + n, 0] - nodes[start + i, 0]
    ey = nodes[start + n, 1] - nodes[start + i, 1]
    side = cross(ux, uy, ex, ey)
    return side > 0.0 or (side == 0.0 and inward * (ux * ex + uy * ey) > 0.0)


@inlined
def common_tangent(nodes, a0, na, ax, ay, b0, nb, bx, by):
    """Vertices of A and B on their common tangent with both polygons to the right of A → B.

    (ax, ay) and (bx, by) are any points inside A and B. The tangent is also that of A ⊕ −N and
    B ⊕ −N for every N, since both supports gain the same term. Where an edge lies on the tangent,
    the vertex nearer to the other polygon is taken.
    """
    i = support(nodes, a0, na, -(by - ay), bx - ax)
    j = support(nodes, b0, nb, -(by - ay), bx - ax)
    for _ in range(na + nb):
        ux = nodes[b0 + j, 0] - nodes[a0 + i, 0]
        uy = nodes[b0 + j, 1] - nodes[a0 + i, 1]
        if beyond_tangent(nodes, a0, i, before(i, na), ux, uy, 1):
            i = before(i, na)
        elif beyond_tangent(nodes, a0, i, after(i, na), ux, uy, 1):
            i = after(i, na)
        elif beyond_tangent(nodes, b0, j, after(j, nb), ux, uy, -1):
            j = after(j, nb)
        elif beyond_tangent(nodes, b0, j, before(j, nb), ux, uy, -1):
            j = before(j, nb)
        else:
            break
    return i, j
