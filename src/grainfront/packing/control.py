"""A prescribed volume fraction inside one packing: the effort follows the fraction so far.

Each placement closes a polygon of centres: the new particle, the pair it touches and those it
buries. Their areas add up to the area below the line of centres of the front; solid below it is all
that is buried, and of each particle on the front the sector below the line. So the volume fraction
below the front is known at any moment, without waiting for rows. Too loose, and the next particles
get more trials; too dense, and they get fewer (a controller with proportional and integral part).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grainfront.geometry.support import cross
from grainfront.jit import inlined
from grainfront.packing.front import member_at
from grainfront.packing.state import BOTTOM_WALL, LEFT_WALL, RIGHT_WALL, Supply

# What the controller keeps count of between placements: area below the front, solid in it, the
# integral part of the effort, and the sum of the efforts spent.
ENCLOSED, SOLID, INTEGRAL, EFFORT_SUM, N_TALLIES = range(5)
# Volume fraction gained from effort 0 to 1, by order of magnitude: rectangles and gravel 0.1 to
# 0.2. Half or twice as much only makes the controller slower or quicker.
RISE = 0.15
# Effort for each mean particle area of solid that is missing below the front. A lack is made up
# for within 1 / (RISE × GAIN), some 200 mean particle areas: a few rows of a thousand particles.
GAIN = 0.03
# The integral part gathers over this many mean particle areas of packing: four times as long as a
# lack takes, so that the two do not swing against one another (critical damping).
INTEGRATION_AREAS = 4.0 / (RISE * GAIN)
# Effort goes into n_angle alone at first, up to this power of the most: of all pairs with the same
# volume fraction these are the cheapest, up to 1.9 times as cheap as equal powers of both
# (rectangles of λ = 1.5 and 4, gravel). Beyond, both rise. The knee lies where a third of the way
# is gone in volume fraction too.
KNEE, KNEE_OF_ANGLE = 0.35, 0.56
FULL_TURN = 2.0 * math.pi


class Control(NamedTuple):
    """What steers a packing to a volume fraction; efforts go from 0 (plain method) to 1."""

    aim: float  # volume fraction wanted below the front
    mean_area: float  # of the particles
    particle_area: np.ndarray  # (n_shapes,) of size 1, as the volume fraction counts it
    uniform: np.ndarray  # (n, 2) in [0, 1): rounds n_angle and n_loc of each particle
    area: np.ndarray  # (n,) of the particles placed
    below: np.ndarray  # (n,) share of each that lies below the front
    tally: np.ndarray  # (N_TALLIES,)
    ring: np.ndarray  # (n + 8, 2) work space: a polygon of centres


def make_control(
    aim: float,
    effort: float,
    particle_area: np.ndarray,
    supply: Supply,
    rng: np.random.Generator,
) -> Control:
    """A controller that starts with an effort; `particle_area`, (n_shapes,), is that of size 1."""
    n = supply.size.size
    tally = np.zeros(N_TALLIES)
    tally[INTEGRAL] = min(max(effort, 0.0), 1.0)
    return Control(
        aim=aim,
        mean_area=float(np.mean(particle_area[supply.shape] * supply.size**2)),
        particle_area=particle_area,
        uniform=rng.random((n, 2)),
        area=np.empty(n),
        below=np.empty(n),
        tally=tally,
        ring=np.empty((n + 8, 2)),
    )


@inlined
def effort_now(control):
    """The effort that the lack of solid below the front asks for, from 0 to 1."""
    tally = control.tally
    lack = (control.aim * tally[ENCLOSED] - tally[SOLID]) / control.mean_area
    return min(max(tally[INTEGRAL] + GAIN * lack, 0.0), 1.0)


@inlined
def round_at_random(value, uniform):
    """The whole number below or above a value, so that the mean is the value."""
    return int(value + uniform % 1.0)


@inlined
def exponents(effort):
    """Powers of the most n_angle and the most n_loc that an effort stands for."""
    if effort < KNEE:
        return KNEE_OF_ANGLE * effort / KNEE, 0.0
    beyond = (effort - KNEE) / (1.0 - KNEE)
    return KNEE_OF_ANGLE + (1.0 - KNEE_OF_ANGLE) * beyond, beyond


@inlined
def spend(control, effort, source, offset, most_n_angle, most_n_loc):
    """n_angle and n_loc for a particle, rounded at random."""
    of_angle, of_loc = exponents(effort)
    n_angle = round_at_random(most_n_angle**of_angle, control.uniform[source, 0] + offset)
    n_loc = round_at_random(most_n_loc**of_loc, control.uniform[source, 1] + offset)
    return min(n_angle, most_n_angle), min(n_loc, most_n_loc)


@inlined
def add_corner(control, count, x, y):
    """Append a corner to the polygon of centres."""
    control.ring[count, 0] = x
    control.ring[count, 1] = y
    return count + 1


@inlined
def abscissa(placed, domain, member, other):
    """x of a member of the front next to the bottom; of `other` where that is the bottom itself."""
    if member == LEFT_WALL:
        return domain.x_min
    if member == RIGHT_WALL:
        return domain.x_max
    return other if member == BOTTOM_WALL else placed.disc[member, 0]


@inlined
def polygon_of_centres(control, front, placed, domain, i, k, x, y):
    """Write the polygon that a particle at (x, y) on the pair (i, k) closes; its corner count.

    Where the front meets a wall, the polygon reaches to the wall.
    """
    count = 0
    for position in range(i, k + 1):
        member = member_at(front, position)
        if member >= 0:
            count = add_corner(control, count, placed.disc[member, 0], placed.disc[member, 1])
        elif member == BOTTOM_WALL:
            before = member_at(front, position - 1) if position > i else BOTTOM_WALL
            after = member_at(front, position + 1) if position < k else BOTTOM_WALL
            left = abscissa(placed, domain, before, x)
            right = abscissa(placed, domain, after, x)
            count = add_corner(control, count, left, domain.y_min)
            count = add_corner(control, count, right, domain.y_min)
        else:
            inner = member_at(front, position + 1 if member == LEFT_WALL else position - 1)
            level = placed.disc[inner, 1] if inner >= 0 else domain.y_min
            wall_x = domain.x_min if member == LEFT_WALL else domain.x_max
            first, second = (y, level) if member == LEFT_WALL else (level, y)
            count = add_corner(control, count, wall_x, first)
            count = add_corner(control, count, wall_x, second)
    return add_corner(control, count, x, y)


@inlined
def enclosed(control, front, placed, domain, i, k, x, y):
    """Area of the polygon that a particle at (x, y) on the pair (i, k) closes."""
    count = polygon_of_centres(control, front, placed, domain, i, k, x, y)
    ring = control.ring
    doubled = 0.0
    for n in range(count):
        m = n + 1 if n + 1 < count else 0
        doubled += cross(ring[n, 0] - x, ring[n, 1] - y, ring[m, 0] - x, ring[m, 1] - y)
    return 0.5 * doubled


@inlined
def point_of(placed, domain, member, x, y):
    """Centre of a member of the front; of a wall, the point that faces its neighbour at (x, y)."""
    if member >= 0:
        return placed.disc[member, 0], placed.disc[member, 1]
    if member == BOTTOM_WALL:
        return x, domain.y_min
    return domain.x_min if member == LEFT_WALL else domain.x_max, y


@inlined
def share_below(back_x, back_y, x, y, ahead_x, ahead_y):
    """Share of the turn about (x, y) that lies below the front, which comes from `back`."""
    ax, ay = ahead_x - x, ahead_y - y
    bx, by = back_x - x, back_y - y
    turn = math.atan2(cross(bx, by, ax, ay), ax * bx + ay * by) / FULL_TURN
    return turn if turn >= 0.0 else turn + 1.0


@inlined
def set_below(control, particle, share):
    """Set the share of a particle below the front; what that adds to the solid there."""
    added = control.area[particle] * (share - control.below[particle])
    control.below[particle] = share
    return added


@inlined
def account(control, supply, front, placed, domain, source, number, x, y, i, k):
    """Account for a new particle at (x, y) on the pair (i, k); call it before any is buried."""
    size = supply.size[source]
    control.area[number] = control.particle_area[supply.shape[source]] * (size * size)
    control.below[number] = 0.0
    a, b = member_at(front, i), member_at(front, k)
    ax, ay = point_of(placed, domain, a, x, y)
    bx, by = point_of(placed, domain, b, x, y)
    solid = set_below(control, number, share_below(ax, ay, x, y, bx, by))
    if a >= 0:
        back_x, back_y = point_of(placed, domain, member_at(front, i - 1), ax, ay)
        solid += set_below(control, a, share_below(back_x, back_y, ax, ay, x, y))
    if b >= 0:
        ahead_x, ahead_y = point_of(placed, domain, member_at(front, k + 1), bx, by)
        solid += set_below(control, b, share_below(x, y, bx, by, ahead_x, ahead_y))
    for position in range(i + 1, k):
        member = member_at(front, position)
        if member >= 0:
            solid += set_below(control, member, 1.0)
    area = enclosed(control, front, placed, domain, i, k, x, y)
    tally = control.tally
    tally[ENCLOSED] += area
    tally[SOLID] += solid
    lack = (control.aim * tally[ENCLOSED] - tally[SOLID]) / control.mean_area
    rise = GAIN * lack * area / (INTEGRATION_AREAS * control.mean_area)
    tally[INTEGRAL] = min(max(tally[INTEGRAL] + rise, 0.0), 1.0)
