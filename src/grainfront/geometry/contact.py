"""Where a new particle touches two neighbours, found on the no-fit polygons without building them.

The centre of a particle N that slides round A moves on the boundary of the no-fit polygon A ⊕ −N
(Du et al. 2023, section 3). The boundaries of A ⊕ −N and B ⊕ −N leave their common tangent
downwards; both are walked edge by edge until they cross. Coordinates of N are relative to its
centre.
"""

from __future__ import annotations

from grainfront.geometry.support import after, at, before, climb, cross
from grainfront.jit import inlined

# Rounding turns an edge by about 1e-16; two edges that differ by less than this are parallel.
PARALLEL = 1e-12
# A guess that is not right after this many moves is given up.
GUESS_MOVES = 12


@inlined
def clockwise_edge(nodes, a0, na, i, trial, t0, nt, j):
    """The edge of A ⊕ −N that leaves (vertex i of A, vertex j of N) clockwise: (ex, ey, i, j)."""
    m = before(i, na)
    n = before(j, nt)
    ax = at(nodes, a0 + m, 0) - at(nodes, a0 + i, 0)
    ay = at(nodes, a0 + m, 1) - at(nodes, a0 + i, 1)
    bx = at(trial, t0 + j, 0) - at(trial, t0 + n, 0)
    by = at(trial, t0 + j, 1) - at(trial, t0 + n, 1)
    if cross(bx, by, ax, ay) > 0.0:
        return ax, ay, m, j
    return bx, by, i, n


@inlined
def counterclockwise_edge(nodes, a0, na, i, trial, t0, nt, j):
    """The edge of A ⊕ −N that leaves (vertex i of A, vertex j of N) counter-clockwise."""
    m = after(i, na)
    n = after(j, nt)
    ax = at(nodes, a0 + m, 0) - at(nodes, a0 + i, 0)
    ay = at(nodes, a0 + m, 1) - at(nodes, a0 + i, 1)
    bx = at(trial, t0 + j, 0) - at(trial, t0 + n, 0)
    by = at(trial, t0 + j, 1) - at(trial, t0 + n, 1)
    if cross(ax, ay, bx, by) > 0.0:
        return ax, ay, m, j
    return bx, by, i, n


@inlined
def crossing(nodes, ia, ib, trial, ja, jb, eax, eay, ebx, eby):
    """Where two edges of no-fit polygons cross that end at the given nodes of A, N and of B, N.

    The same edges give the same bits, however they were found.
    """
    pax = at(nodes, ia, 0) - at(trial, ja, 0) - eax
    pay = at(nodes, ia, 1) - at(trial, ja, 1) - eay
    wx = at(nodes, ib, 0) - at(trial, jb, 0) - ebx - pax
    wy = at(nodes, ib, 1) - at(trial, jb, 1) - eby - pay
    t = cross(wx, wy, ebx, eby) / cross(eax, eay, ebx, eby)
    t = min(max(t, 0.0), 1.0)
    return pax + t * eax, pay + t * eay


@inlined
def contact_with_polygons(nodes, a0, na, ia, b0, nb, ib, trial, t0, nt):
    """Centre of N in contact with A and B, to the left of A → B.

    `ia`, `ib` are the vertices of their common tangent. Returns (found, x, y, ia, ja, ib, jb), with
    the vertices of A, N and of B, N where the edges end that cross.
    """
    pax = at(nodes, a0 + ia, 0)
    pay = at(nodes, a0 + ia, 1)
    pbx = at(nodes, b0 + ib, 0)
    pby = at(nodes, b0 + ib, 1)
    ux = pbx - pax
    uy = pby - pay
    j = climb(trial, t0, nt, 0, uy, -ux)
    pax -= at(trial, t0 + j, 0)
    pay -= at(trial, t0 + j, 1)
    pbx -= at(trial, t0 + j, 0)
    pby -= at(trial, t0 + j, 1)
    eax, eay, ia, ja = clockwise_edge(nodes, a0, na, ia, trial, t0, nt, j)
    ebx, eby, ib, jb = counterclockwise_edge(nodes, b0, nb, ib, trial, t0, nt, j)
    depth_a = -cross(ux, uy, eax, eay)
    depth_b = -cross(ux, uy, ebx, eby)
    crossed = False
    for _ in range(2 * (na + nb + nt)):
        turn = cross(eax, eay, ebx, eby)
        if turn >= 0.0:
            along = eax * ebx + eay * eby
            if along >= 0.0 or turn > -PARALLEL * along:
                break  # the boundaries diverge
        if depth_a <= depth_b:
            endx = pax + eax
            endy = pay + eay
            crossed = cross(ebx, eby, endx - pbx, endy - pby) > 0.0
            if crossed:
                break
            pax, pay = endx, endy
            eax, eay, ia, ja = clockwise_edge(nodes, a0, na, ia, trial, t0, nt, ja)
            down = -cross(ux, uy, eax, eay)
            if down < -PARALLEL * abs(ux * eax + uy * eay):
                break  # the lower end of A ⊕ −N
            depth_a += down
        else:
            endx = pbx + ebx
            endy = pby + eby
            crossed = cross(eax, eay, endx - pax, endy - pay) < 0.0
            if crossed:
                break
            pbx, pby = endx, endy
            ebx, eby, ib, jb = counterclockwise_edge(nodes, b0, nb, ib, trial, t0, nt, jb)
            down = -cross(ux, uy, ebx, eby)
            if down < -PARALLEL * abs(ux * ebx + uy * eby):
                break  # the lower end of B ⊕ −N
            depth_b += down
    if not crossed:
        return False, 0.0, 0.0, ia, ja, ib, jb
    x, y = crossing(nodes, a0 + ia, b0 + ib, trial, t0 + ja, t0 + jb, eax, eay, ebx, eby)
    return True, x, y, ia, ja, ib, jb


@inlined
def contact_from_guess(nodes, a0, na, ia, ja, b0, nb, ib, jb, trial, t0, nt):
    """As `contact_with_polygons`, from a guess of the two edges that cross.

    The guess is what was returned for a similar N: the vertices of A, N and B, N where the edges
    end. It starts from the edges of A and B that end there and moves each along its no-fit polygon
    until the two lines cross within both. Returns (found, x, y, ia, ja, ib, jb); not found where
    the guess is too far off to tell.
    """
    ma, mb = ia, ib
    ia = after(ia, na)
    ib = before(ib, nb)
    eax = at(nodes, a0 + ma, 0) - at(nodes, a0 + ia, 0)
    eay = at(nodes, a0 + ma, 1) - at(nodes, a0 + ia, 1)
    ebx = at(nodes, b0 + mb, 0) - at(nodes, b0 + ib, 0)
    eby = at(nodes, b0 + mb, 1) - at(nodes, b0 + ib, 1)
    ja = climb(trial, t0, nt, ja, eay, -eax)
    jb = climb(trial, t0, nt, jb, -eby, ebx)
    ka = ja
    kb = jb
    pax = at(nodes, a0 + ia, 0) - at(trial, t0 + ja, 0)
    pay = at(nodes, a0 + ia, 1) - at(trial, t0 + ja, 1)
    pbx = at(nodes, b0 + ib, 0) - at(trial, t0 + jb, 0)
    pby = at(nodes, b0 + ib, 1) - at(trial, t0 + jb, 1)
    for _ in range(GUESS_MOVES):
        turn = cross(eax, eay, ebx, eby)
        if turn >= 0.0:
            break
        wx = pbx - pax
        wy = pby - pay
        along_a = cross(wx, wy, ebx, eby)
        along_b = cross(wx, wy, eax, eay)
        if along_a < turn:
            pax += eax
            pay += eay
            ia, ja = ma, ka
            eax, eay, ma, ka = clockwise_edge(nodes, a0, na, ia, trial, t0, nt, ja)
        elif along_b < turn:
            pbx += ebx
            pby += eby
            ib, jb = mb, kb
            ebx, eby, mb, kb = counterclockwise_edge(nodes, b0, nb, ib, trial, t0, nt, jb)
        elif along_a > 0.0:
            ma, ka = ia, ja
            eax, eay, ia, ja = counterclockwise_edge(nodes, a0, na, ma, trial, t0, nt, ka)
            pax += eax
            pay += eay
            eax, eay = -eax, -eay
        elif along_b > 0.0:
            mb, kb = ib, jb
            ebx, eby, ib, jb = clockwise_edge(nodes, b0, nb, mb, trial, t0, nt, kb)
            pbx += ebx
            pby += eby
            ebx, eby = -ebx, -eby
        else:
            x, y = crossing(nodes, a0 + ma, b0 + mb, trial, t0 + ka, t0 + kb, eax, eay, ebx, eby)
            return True, x, y, ma, ka, mb, kb
    return False, 0.0, 0.0, ia, ja, ib, jb


@inlined
def contact_with_wall(nodes, a0, na, clockwise, nx, ny, level, trial, t0, nt):
    """Centre of N in contact with A and with a wall: (found, x, y).

    N's centre touches the wall where n · centre = `level`, n = (nx, ny) pointing into the domain.
    The boundary of A ⊕ −N is walked from its point farthest from the wall, clockwise where the wall
    follows A along the front, counter-clockwise where it precedes A.
    """
    i = climb(nodes, a0, na, 0, nx, ny)
    j = climb(trial, t0, nt, 0, -nx, -ny)
    px = at(nodes, a0 + i, 0) - at(trial, t0 + j, 0)
    py = at(nodes, a0 + i, 1) - at(trial, t0 + j, 1)
    above = nx * px + ny * py - level
    if above < 0.0:
        return False, 0.0, 0.0
    for _ in range(na + nt):
        if clockwise:
            ex, ey, i, j = clockwise_edge(nodes, a0, na, i, trial, t0, nt, j)
        else:
            ex, ey, i, j = counterclockwise_edge(nodes, a0, na, i, trial, t0, nt, j)
        rise = nx * ex + ny * ey
        if above + rise < 0.0:
            t = min(above / -rise, 1.0)
            return True, px + t * ex, py + t * ey
        if rise > PARALLEL * abs(nx * ey - ny * ex):
            return False, 0.0, 0.0  # A ⊕ −N ends before the wall
        px += ex
        py += ey
        above += rise
    return False, 0.0, 0.0
