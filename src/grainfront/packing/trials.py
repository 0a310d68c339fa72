"""One trial: a particle in contact with a pair of the front, moved until nothing overlaps."""

from __future__ import annotations

from grainfront.geometry.contact import contact_with_polygons, contact_with_wall
from grainfront.geometry.overlap import overlapping
from grainfront.geometry.support import at
from grainfront.geometry.tangent import common_tangent
from grainfront.jit import inlined
from grainfront.packing.front import front_length, member_at, position_of
from grainfront.packing.state import BOTTOM_WALL, LEFT_WALL, RIGHT_WALL

# Neighbours along the front that are tested before the grid: nearly all overlaps are with these.
CHAIN_NEIGHBOURS = 6

RESOLVED, BLOCKED, TOO_HIGH = 1, 0, -1
NOTHING, BYPASSED = -1, -2


@inlined
def wall_line(domain, wall, reach, angle):
    """Inward normal and level of the line that the trial's centre must not cross."""
    if wall == LEFT_WALL:
        return 1.0, 0.0, domain.x_min + reach[angle, 0]
    if wall == BOTTOM_WALL:
        return 0.0, 1.0, domain.y_min + reach[angle, 1]
    return -1.0, 0.0, reach[angle, 2] - domain.x_max


@inlined
def tangent_of_pair(placed, a, b):
    """Vertices of two particles on their common tangent; see `common_tangent`."""
    disc = placed.disc
    a0, b0 = placed.offsets[a], placed.offsets[b]
    na, nb = placed.offsets[a + 1] - a0, placed.offsets[b + 1] - b0
    return common_tangent(
        placed.nodes, a0, na, disc[a, 0], disc[a, 1], b0, nb, disc[b, 0], disc[b, 1]
    )


@inlined
def contact_at_tangent(placed, trials, trial, a, b, tangent):
    """Centre of the trial in contact with two particles, given their tangent: (found, x, y)."""
    a0, b0 = placed.offsets[a], placed.offsets[b]
    na, nb = placed.offsets[a + 1] - a0, placed.offsets[b + 1] - b0
    found, x, y, _, _, _, _ = contact_with_polygons(
        placed.nodes, a0, na, tangent[0], b0, nb, tangent[1],
        trials.nodes, trial.start, trial.n_nodes,
    )  # fmt: skip
    return found, x, y


@inlined
def contact_of_pair(placed, domain, trials, trial, a, b):
    """Centre of the trial in contact with the members a and b: (found, x, y)."""
    if a >= 0 and b >= 0:
        return contact_at_tangent(placed, trials, trial, a, b, tangent_of_pair(placed, a, b))
    if a >= 0 or b >= 0:
        polygon = max(a, b)
        nx, ny, level = wall_line(domain, min(a, b), trials.reach, trial.angle)
        start = placed.offsets[polygon]
        count = placed.offsets[polygon + 1] - start
        return contact_with_wall(
            placed.nodes,
            start,
            count,
            a >= 0,
            nx,
            ny,
            level,
            trials.nodes,
            trial.start,
            trial.n_nodes,
        )
    y = domain.y_min + trials.reach[trial.angle, 1]
    if a == LEFT_WALL and b == BOTTOM_WALL:
        return True, domain.x_min + trials.reach[trial.angle, 0], y
    if a == BOTTOM_WALL and b == RIGHT_WALL:
        return True, domain.x_max - trials.reach[trial.angle, 2], y
    return False, 0.0, 0.0


@inlined
def overlaps_particle(placed, domain, trials, trial, q, x, y):
    """Whether the trial at (x, y) overlaps the placed particle q."""
    qx = at(placed.disc, q, 0)
    qy = at(placed.disc, q, 1)
    squared = (x - qx) * (x - qx) + (y - qy) * (y - qy)
    far = trial.circumradius + at(placed.disc, q, 2)
    if squared >= far * far:
        return False
    near = trial.inradius + at(placed.disc, q, 3) - 2.0 * domain.tolerance
    if squared < near * near:
        return True
    start = placed.offsets[q]
    return overlapping(
        placed.nodes, start, placed.offsets[q + 1] - start, qx, qy,
        trials.nodes, trial.start, trial.n_nodes, x, y, domain.tolerance,
    )  # fmt: skip


@inlined
def crosses_wall(domain, trials, trial, wall, x, y):
    """Whether the trial at (x, y) crosses a wall."""
    nx, ny, level = wall_line(domain, wall, trials.reach, trial.angle)
    return nx * x + ny * y < level - domain.tolerance


@inlined
def overlaps_member(placed, domain, trials, trial, member, x, y):
    """Whether the trial at (x, y) overlaps a member of the front."""
    if member >= 0:
        return overlaps_particle(placed, domain, trials, trial, member, x, y)
    return crosses_wall(domain, trials, trial, member, x, y)


@inlined
def nearer(best, position, i, k):
    """The position nearer to the pair (i, k) along the front, BYPASSED if it lies between them."""
    if i < position < k or best == BYPASSED:
        return BYPASSED
    if best == NOTHING:
        return position
    distance = i - position if position < i else position - k
    best_distance = i - best if best < i else best - k
    if distance < best_distance or (distance == best_distance and position < best):
        return position
    return best


@inlined
def overlapped_anywhere(front, placed, grid, domain, trials, trial, i, k, x, y):
    """Position of the nearest member that the trial overlaps, by the walls and the grid.

    NOTHING where it is free, BYPASSED where it overlaps a particle that left the front or that
    the pair has passed over already.
    """
    found = NOTHING
    a = member_at(front, i)
    b = member_at(front, k)
    if a != LEFT_WALL and crosses_wall(domain, trials, trial, LEFT_WALL, x, y):
        found = nearer(found, 0, i, k)
    if b != RIGHT_WALL and crosses_wall(domain, trials, trial, RIGHT_WALL, x, y):
        found = nearer(found, front_length(front) - 1, i, k)
    if BOTTOM_WALL not in (a, b) and crosses_wall(domain, trials, trial, BOTTOM_WALL, x, y):
        return BYPASSED
    for n in range(grid.level.shape[0]):
        if grid.occupied[n] == 0:
            continue
        cell = grid.level[n, 0]
        columns = int(grid.level[n, 2])
        rows = int(grid.level[n, 3])
        reach = trial.circumradius + grid.level[n, 1]
        left = max(int((x - reach - domain.x_min) / cell), 0)
        right = min(int((x + reach - domain.x_min) / cell), columns - 1)
        bottom = max(int((y - reach - domain.y_min) / cell), 0)
        top = min(int((y + reach - domain.y_min) / cell), rows - 1)
        for row in range(bottom, top + 1):
            first = int(grid.level[n, 4]) + row * columns
            for index in range(first + left, first + right + 1):
                q = grid.head[index]
                while q >= 0:
                    if (
                        q != a
                        and q != b
                        and overlaps_particle(placed, domain, trials, trial, q, x, y)
                    ):
                        if front.slot[q] < 0:
                            return BYPASSED
                        found = nearer(found, position_of(front, q), i, k)
                        if found == BYPASSED:
                            return found
                    q = grid.next[q]
    return found


@inlined
def overlapped_neighbour(front, placed, domain, trials, trial, i, k, x, y):
    """Position of the nearest neighbour along the front that the trial overlaps, or NOTHING."""
    last = front_length(front) - 1
    for d in range(1, CHAIN_NEIGHBOURS + 1):
        if i >= d and overlaps_member(placed, domain, trials, trial, member_at(front, i - d), x, y):
            return i - d
        if k + d <= last and overlaps_member(
            placed, domain, trials, trial, member_at(front, k + d), x, y
        ):
            return k + d
    return NOTHING


@inlined
def overlapped(front, placed, grid, domain, trials, trial, i, k, x, y):
    """Position of the member that the trial is moved on to; see `overlapped_anywhere`."""
    position = overlapped_neighbour(front, placed, domain, trials, trial, i, k, x, y)
    if position == NOTHING:
        position = overlapped_anywhere(front, placed, grid, domain, trials, trial, i, k, x, y)
    return position
