"""Whether two convex polygons overlap, decided on their no-fit polygon without building it.

N at the point c overlaps Q where c lies inside Q ⊕ −N (Du et al. 2023, section 3). The boundary is
walked from the support vertex in the direction of c to the edge that c lies behind or beyond.
"""

from __future__ import annotations

from grainfront.geometry.contact import clockwise_edge, counterclockwise_edge
from grainfront.geometry.support import climb, cross
from grainfront.jit import inlined


@inlined
def beyond_edge(ex, ey, wx, wy, tolerance):
    """Whether w lies right of the edge e, or at most `tolerance` left of it."""
    depth = cross(ex, ey, wx, wy)
    return depth <= 0.0 or depth * depth <= tolerance * tolerance * (ex * ex + ey * ey)


@inlined
def overlapping(nodes, q0, nq, qx, qy, trial, t0, nt, x, y, tolerance):
    """Whether N centred at (x, y) penetrates Q, centred at (qx, qy), by more than `tolerance`.

    The tolerance is to be far shorter than the edges (a packing's is some 1e-15 of the domain).
    Near a corner between edges of its length, a penetration below it may count as an overlap.
    """
    dx = x - qx
    dy = y - qy
    i = climb(nodes, q0, nq, 0, dx, dy)
    j = climb(trial, t0, nt, 0, -dx, -dy)
    vx = nodes[q0 + i, 0] - qx - trial[t0 + j, 0]
    vy = nodes[q0 + i, 1] - qy - trial[t0 + j, 1]
    if cross(vx, vy, dx, dy) >= 0.0:
        for _ in range(nq + nt):
            ex, ey, i, j = counterclockwise_edge(nodes, q0, nq, i, trial, t0, nt, j)
            if beyond_edge(ex, ey, dx - vx, dy - vy, tolerance):
                return False
            vx += ex
            vy += ey
            if cross(vx, vy, dx, dy) <= 0.0:
                return True
    else:
        for _ in range(nq + nt):
            ex, ey, i, j = clockwise_edge(nodes, q0, nq, i, trial, t0, nt, j)
            if beyond_edge(-ex, -ey, dx - vx, dy - vy, tolerance):
                return False
            vx += ex
            vy += ey
            if cross(vx, vy, dx, dy) >= 0.0:
                return True
    return True
