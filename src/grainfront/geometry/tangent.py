"""The outer common tangent of two convex polygons."""

from __future__ import annotations

from grainfront.geometry.support import after, before, cross, support
from grainfront.jit import inlined


@inlined
def common_tangent(nodes, a0, na, ax, ay, b0, nb, bx, by):
    """Vertices of A and B on their common tangent with both polygons to the right of A → B.

    (ax, ay) and (bx, by) are any points inside A and B. The tangent is also that of A ⊕ −N and
    B ⊕ −N for every N, since both supports gain the same term. Where an edge lies on the tangent,
    the vertex nearer to the other polygon is taken.
    """
    nx = -(by - ay)
    ny = bx - ax
    i = support(nodes, a0, na, nx, ny)
    j = support(nodes, b0, nb, nx, ny)
    for _ in range(na + nb):
        px = nodes[a0 + i, 0]
        py = nodes[a0 + i, 1]
        qx = nodes[b0 + j, 0]
        qy = nodes[b0 + j, 1]
        ux = qx - px
        uy = qy - py
        n = before(i, na)
        c = cross(ux, uy, nodes[a0 + n, 0] - px, nodes[a0 + n, 1] - py)
        if c > 0.0 or (
            c == 0.0 and (nodes[a0 + n, 0] - px) * ux + (nodes[a0 + n, 1] - py) * uy > 0
        ):
            i = n
            continue
        n = after(i, na)
        if cross(ux, uy, nodes[a0 + n, 0] - px, nodes[a0 + n, 1] - py) > 0.0:
            i = n
            continue
        n = after(j, nb)
        c = cross(ux, uy, nodes[b0 + n, 0] - qx, nodes[b0 + n, 1] - qy)
        if c > 0.0 or (
            c == 0.0 and (nodes[b0 + n, 0] - qx) * ux + (nodes[b0 + n, 1] - qy) * uy < 0
        ):
            j = n
            continue
        n = before(j, nb)
        if cross(ux, uy, nodes[b0 + n, 0] - qx, nodes[b0 + n, 1] - qy) > 0.0:
            j = n
            continue
        break
    return i, j
