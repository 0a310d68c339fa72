"""A prescribed volume fraction inside one packing: the effort follows the fraction so far.

Each placement closes a polygon of centres: the new particle, the pair it touches and those it
buries. Its area and the sectors of particles in it tell the volume fraction below the front at any
moment, without waiting for rows. Too loose, and the next particles get more trials; too dense, and
they get fewer (a controller with proportional and integral part).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from grainfront.geometry.support import cross
from grainfront.jit import inlined
from grainfront.packing.front import member_at
from grainfront.packing.state import BOTTOM_WALL, LEFT_WALL, RIGHT_WALL, Supply

# What the controller keeps count of between placements: area below the front, solid in it, solid
# of all particles, the integral part of the effort, and the sum of the efforts spent.
ENCLOSED, SOLID, PLACED_AREA, INTEGRAL, EFFORT_SUM, N_TALLIES = range(6)
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
# Least share of a turn that a placement adds to what lies under a particle of the pair. Small ones
# sink between large ones by less than a quarter turn, and none is put farther than three quarters
# round a particle.
OF_THE_PAIR = -0.25


class Control(NamedTuple):
    """What steers a packing to a volume fraction; efforts go from 0 (plain method) to 1."""

    aim: float  # volume fraction wanted below the front
    mean_area: float  # of the particles
    particle_area: np.ndarray  # (n_shapes,) of size 1, as the volume fraction counts it
    uniform: np.ndarray  # (n, 2) in [0, 1): rounds n_angle and n_loc of each particle
    area: np.ndarray  # (n,) of the particles placed
    tally: np.ndarray  # (N_TALLIES,)
    ring: np.ndarray  # (n + 8, 3) work space: polygon of centres, and the solid about each


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
        tally=tally,
        ring=np.empty((n + 8, 3)),
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
def add_corner(control, count, x, y, solid):
    """Append a corner to the polygon of centres."""
    control.ring[count, 0] = x
    control.ring[count, 1] = y
    control.ring[count, 2] = solid
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
def polygon_of_centres(control, front, placed, domain, i, k, x, y, solid):
    """Write the polygon that a particle at (x, y) on the pair (i, k) closes; its corner count.

    Where the front meets a wall, the polygon reaches to the wall.
    """
    count = 0
    for position in range(i, k + 1):
        member = member_at(front, position)
        if member >= 0:
            centre_x, centre_y = placed.disc[member, 0], placed.disc[member, 1]
            count = add_corner(control, count, centre_x, centre_y, control.area[member])
        elif member == BOTTOM_WALL:
            before = member_at(front, position - 1) if position > i else BOTTOM_WALL
            after = member_at(front, position + 1) if position < k else BOTTOM_WALL
            left = abscissa(placed, domain, before, x)
            right = abscissa(placed, domain, after, x)
            count = add_corner(control, count, left, domain.y_min, 0.0)
            count = add_corner(control, count, right, domain.y_min, 0.0)
        else:
            inner = member_at(front, position + 1 if member == LEFT_WALL else position - 1)
            level = placed.disc[inner, 1] if inner >= 0 else domain.y_min
            wall_x = domain.x_min if member == LEFT_WALL else domain.x_max
            first, second = (y, level) if member == LEFT_WALL else (level, y)
            count = add_corner(control, count, wall_x, first, 0.0)
            count = add_corner(control, count, wall_x, second, 0.0)
    return add_corner(control, count, x, y, solid)


@inlined
def sector(ring, before, n, after, least):
    """Share of a full turn, counter-clockwise, from the corner after n to the one before it.

    Of the shares that differ by whole turns, that from `least` to `least` + 1.
    """
    ax, ay = ring[after, 0] - ring[n, 0], ring[after, 1] - ring[n, 1]
    bx, by = ring[before, 0] - ring[n, 0], ring[before, 1] - ring[n, 1]
    turn = math.atan2(cross(ax, ay, bx, by), ax * bx + ay * by) / FULL_TURN
    return turn if turn >= least else turn + 1.0


@inlined
def account(control, supply, front, placed, domain, source, number, x, y, i, k):
    """Add what a new particle at (x, y) on the pair (i, k) closes; call it before any is buried."""
    area = control.particle_area[supply.shape[source]] * supply.size[source] ** 2
    control.area[number] = area
    count = polygon_of_centres(control, front, placed, domain, i, k, x, y, area)
    ring = control.ring
    doubled = 0.0
    solid = 0.0
    for n in range(count):
        before = n - 1 if n > 0 else count - 1
        after = n + 1 if n + 1 < count else 0
        doubled += cross(ring[n, 0] - x, ring[n, 1] - y, ring[after, 0] - x, ring[after, 1] - y)
        if ring[n, 2] > 0.0:
            # the pair stays on the front and loses what lies under it where the new particle sinks
            # in between; what is buried, and the new particle, have nothing to lose
            least = OF_THE_PAIR if n == 0 or n == count - 2 else 0.0
            solid += ring[n, 2] * sector(ring, before, n, after, least)
    tally = control.tally
    tally[ENCLOSED] += 0.5 * doubled
    tally[SOLID] += solid
    tally[PLACED_AREA] += area
    lack = (control.aim * tally[ENCLOSED] - tally[SOLID]) / control.mean_area
    rise = GAIN * lack * 0.5 * doubled / (INTEGRATION_AREAS * control.mean_area)
    tally[INTEGRAL] = min(max(tally[INTEGRAL] + rise, 0.0), 1.0)
