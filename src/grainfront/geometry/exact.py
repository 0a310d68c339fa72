"""Exact decisions on float64 coordinates: sides of lines, convexity, simplicity, separation.

Every function here answers as exact rational arithmetic on the stored coordinates would. A floating
point filter decides almost always; what it leaves open is decided with Python's integers, which is
possible because every float64 is an integer times a power of two.
"""

from __future__ import annotations

from numba import njit, objmode

from grainfront.jit import kernel

# Shewchuk (1997, doi 10.1007/PL00009321): the determinant of `orientation`, evaluated in float64,
# is off by at most (3 + 16 u) u times the sum of its two products' magnitudes, u = 2**-53.
# The fourth u covers the rounding of the bound itself and, above the floor, any underflow.
FILTER_ERROR = 4 * 2.0**-53
FILTER_FLOOR = 2.0**-960

UNDECIDED = 2


def _exact_orientation(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> int:
    ratios = [v.as_integer_ratio() for v in (ax, ay, bx, by, cx, cy)]
    common = max(denominator for _, denominator in ratios)
    ax, ay, bx, by, cx, cy = (n * (common // d) for n, d in ratios)
    determinant = (ax - cx) * (by - cy) - (ay - cy) * (bx - cx)
    return (determinant > 0) - (determinant < 0)


@kernel
def _filtered_orientation(ax, ay, bx, by, cx, cy):
    left_a, left_b = ax - cx, by - cy
    right_a, right_b = ay - cy, bx - cx
    left, right = left_a * left_b, right_a * right_b
    determinant = left - right
    magnitude = abs(left) + abs(right)
    if magnitude > FILTER_FLOOR:
        if determinant > FILTER_ERROR * magnitude:
            return 1
        if determinant < -FILTER_ERROR * magnitude:
            return -1
    # Differences are zero only of equal numbers: edges along an axis, shared nodes.
    if (left_a == 0.0 or left_b == 0.0) and (right_a == 0.0 or right_b == 0.0):
        return 0
    return UNDECIDED


@njit  # not a `kernel`: numba warns of Python objects in one that works without the lock
def _decide(ax, ay, bx, by, cx, cy):
    with objmode(sign="int64"):
        sign = _exact_orientation(ax, ay, bx, by, cx, cy)
    return sign


@kernel
def orientation(ax, ay, bx, by, cx, cy):
    """Side of the line a → b on which c lies: 1 left, 0 on it, -1 right.

    The coordinates are finite floats; the answer is exact.
    """
    sign = _filtered_orientation(ax, ay, bx, by, cx, cy)
    if sign == UNDECIDED:
        sign = _decide(ax, ay, bx, by, cx, cy)
    return sign


@kernel
def _before(px, py, qx, qy):
    return px < qx or (px == qx and py < qy)


@kernel
def is_convex(nodes):
    """Whether the nodes, shape (n, 2), run counter-clockwise once round a convex polygon.

    Nodes on a straight edge are allowed, repeated nodes are not.
    """
    n = nodes.shape[0]
    minima = 0
    turns = False
    for i in range(n):
        px, py = nodes[i - 1, 0], nodes[i - 1, 1]
        qx, qy = nodes[i, 0], nodes[i, 1]
        rx, ry = nodes[(i + 1) % n, 0], nodes[(i + 1) % n, 1]
        sign = orientation(px, py, qx, qy, rx, ry)
        if sign < 0 or (qx == rx and qy == ry):
            return False
        turns = turns or sign > 0
        # Left turns alone allow several rounds; each round has one lexicographic minimum.
        if _before(qx, qy, px, py) and _before(qx, qy, rx, ry):
            minima += 1
    return turns and minima == 1


@kernel
def is_simple(nodes, order):
    """Whether the nodes, shape (n, 2), run counter-clockwise round a simple polygon.

    The boundary must not touch itself, and no node may be repeated. `order`, int64 of shape (n,),
    sorts the edges by the x of their left ends; edge i ends at node i.
    """
    n = nodes.shape[0]
    lowest = 0
    for i in range(n):
        px, py = nodes[i - 1, 0], nodes[i - 1, 1]
        qx, qy = nodes[i, 0], nodes[i, 1]
        rx, ry = nodes[(i + 1) % n, 0], nodes[(i + 1) % n, 1]
        if qx == rx and qy == ry:
            return False
        folded = _before(px, py, qx, qy) != _before(qx, qy, rx, ry)
        if folded and orientation(px, py, qx, qy, rx, ry) == 0:
            return False
        if _before(qx, qy, nodes[lowest, 0], nodes[lowest, 1]):
            lowest = i
    if _edges_meet(nodes, order):
        return False
    px, py = nodes[lowest - 1, 0], nodes[lowest - 1, 1]
    qx, qy = nodes[lowest, 0], nodes[lowest, 1]
    rx, ry = nodes[(lowest + 1) % n, 0], nodes[(lowest + 1) % n, 1]
    return orientation(px, py, qx, qy, rx, ry) > 0


@kernel
def _edges_meet(nodes, order):
    """Whether two edges that do not follow each other meet: a sweep over the edges from left."""
    n = nodes.shape[0]
    for k in range(n):
        i = order[k]
        right = max(nodes[i - 1, 0], nodes[i, 0])
        for m in range(k + 1, n):
            j = order[m]
            if min(nodes[j - 1, 0], nodes[j, 0]) > right:
                break
            if 1 < abs(i - j) < n - 1 and _segments_meet(nodes, i, j):
                return True
    return False


@kernel
def _segments_meet(nodes, i, j):
    """Whether the edges that end at nodes i and j meet, given that their ranges of x do."""
    ax, ay, bx, by = nodes[i - 1, 0], nodes[i - 1, 1], nodes[i, 0], nodes[i, 1]
    cx, cy, dx, dy = nodes[j - 1, 0], nodes[j - 1, 1], nodes[j, 0], nodes[j, 1]
    if max(ay, by) < min(cy, dy) or max(cy, dy) < min(ay, by):
        return False
    if orientation(ax, ay, bx, by, cx, cy) * orientation(ax, ay, bx, by, dx, dy) > 0:
        return False
    return orientation(cx, cy, dx, dy, ax, ay) * orientation(cx, cy, dx, dy, bx, by) <= 0


@kernel
def convex_hull(nodes, order, hull):
    """Find the convex hull of nodes, shape (n, 2), and return its number of nodes.

    Its nodes, counter-clockwise, go to the front of `hull`, int64 of shape (2 n,), as indices into
    `nodes`; nodes inside an edge of the hull are left out. `order` sorts the nodes by x, then y.
    Andrew (1979), doi 10.1016/0020-0190(79)90072-3.
    """
    n = order.size
    size = 0
    for chain in range(2):
        start = size
        for k in range(n):
            node = order[k] if chain == 0 else order[n - 1 - k]
            while size >= start + 2:
                p, q = hull[size - 2], hull[size - 1]
                px, py, qx, qy = nodes[p, 0], nodes[p, 1], nodes[q, 0], nodes[q, 1]
                if orientation(px, py, qx, qy, nodes[node, 0], nodes[node, 1]) > 0:
                    break
                size -= 1
            hull[size] = node
            size += 1
        size -= 1
    return size


@kernel
def hull_contains(hull, x, y):
    """Whether the point lies in the closed convex polygon `hull`, shape (n, 2)."""
    for i in range(hull.shape[0]):
        if orientation(hull[i - 1, 0], hull[i - 1, 1], hull[i, 0], hull[i, 1], x, y) < 0:
            return False
    return True


@kernel
def hull_surrounds(hull, x, y):
    """Whether the point lies in the interior of the convex polygon `hull`, shape (n, 2)."""
    for i in range(hull.shape[0]):
        if orientation(hull[i - 1, 0], hull[i - 1, 1], hull[i, 0], hull[i, 1], x, y) <= 0:
            return False
    return True


@kernel
def edges_surround(edges, x, y):
    """Whether a point that is on no edge lies inside the rings that edges form: even-odd rule.

    Edge i runs from `edges[2 i]` to `edges[2 i + 1]`.
    """
    inside = False
    for i in range(0, edges.shape[0], 2):
        px, py, qx, qy = edges[i, 0], edges[i, 1], edges[i + 1, 0], edges[i + 1, 1]
        if (py > y) != (qy > y):
            left = orientation(px, py, qx, qy, x, y) > 0
            inside = inside != (left == (qy > py))
    return inside


@kernel
def _separated_by_edge_of(a, b):
    exact = False
    inside = 0
    for i in range(a.shape[0]):
        px, py, qx, qy = a[i - 1, 0], a[i - 1, 1], a[i, 0], a[i, 1]
        outside = True
        for k in range(b.shape[0]):
            # The node that ruled out the last edge is likely to rule out the next one.
            j = (inside + k) % b.shape[0]
            side = _filtered_orientation(px, py, qx, qy, b[j, 0], b[j, 1])
            if side == UNDECIDED:
                exact = True
                side = _decide(px, py, qx, qy, b[j, 0], b[j, 1])
            if side > 0:
                outside = False
                inside = j
                break
        if outside:
            return True, exact
    return False, exact


@kernel
def hulls_disjoint(a, b):
    """Whether two convex polygons, shapes (n, 2) and (m, 2), share no interior point.

    One of them may be a segment, of two nodes, which the other's interior then is to be free of.
    They share none if and only if the line of some edge of one has the whole other polygon on its
    closed outer side. Returns that, and whether the filter had to be helped by exact arithmetic.
    """
    disjoint, exact = _separated_by_edge_of(a, b)
    if not disjoint:
        disjoint, exact_again = _separated_by_edge_of(b, a)
        exact = exact or exact_again
    return disjoint, exact


@kernel
def draw_into_hulls(nodes, offsets, movable, hull_nodes, hull_offsets, centres):
    """Draw nodes that lie outside their convex polygon towards its inside, in place.

    Polygon i has `nodes[offsets[i]:offsets[i + 1]]`, must lie in
    `hull_nodes[hull_offsets[i]:hull_offsets[i + 1]]`, and has the interior point `centres[i]`,
    shape (n_polygons, 2). Only nodes marked in `movable` move, by steps that double from 2**-53 of
    the way to that point until the node is inside.
    """
    for i in range(offsets.size - 1):
        hull = hull_nodes[hull_offsets[i] : hull_offsets[i + 1]]
        for k in range(offsets[i], offsets[i + 1]):
            x, y = nodes[k, 0], nodes[k, 1]
            step = 2.0**-53
            while movable[k] and step <= 1.0 and not hull_contains(hull, nodes[k, 0], nodes[k, 1]):
                nodes[k, 0] = x + step * (centres[i, 0] - x)
                nodes[k, 1] = y + step * (centres[i, 1] - y)
                step *= 2.0
