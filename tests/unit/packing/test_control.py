"""The controller's account of the area below the front and of the solid in it."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from grainfront.packing.control import EFFORT_SUM, ENCLOSED, SOLID, make_control
from grainfront.packing.front import front_length, member_at
from grainfront.packing.fronts import advance_to
from grainfront.packing.orientations import orientation_law
from grainfront.packing.prepare import prepare
from grainfront.packing.state import BOTTOM_WALL, LEFT_WALL, RIGHT_WALL
from grainfront.particles import Rectangle
from grainfront.polygons import Polygons


def steered(corners, particles, seed, aim=0.75, smallest=0.5, length=1.0):
    """A packing of some polygons with an effort left to the controller, `particles` placed.

    They are `length` times as long; each range of a factor from `smallest` to 1 has as many sizes.
    """
    angle = 2.0 * np.pi * np.arange(corners) / corners
    hull = np.column_stack([np.cos(angle), np.sin(angle)]) * [length, 1.0] / 1.8
    rng = np.random.default_rng(seed)
    size = smallest ** rng.random(2000)
    empty = prepare(
        Polygons.of([hull]),
        np.zeros(size.size, dtype=np.int64),
        size,
        [orientation_law(np.full(12, 1 / 12), np.linspace(0.0, 180.0, 3073))],
        Rectangle(-1.0, 2.0, 6.0, 9.0),
        6,
        4,
        rng,
    )
    control = make_control(aim, 0.5, np.ones(1), empty.supply, rng)
    state = empty.steered(control, rng)
    advance_to(state, particles)
    assert state.n_placed == particles or state.finished
    return state


def line_of_the_front(state):
    """The points of the front from wall to wall, and the particle at each (or −1)."""
    walls, disc = state.domain, state.placed.disc
    members = [member_at(state.front, n) for n in range(front_length(state.front))]
    points, owner = [], []
    for n, member in enumerate(members):
        if member >= 0:
            points.append(disc[member, :2])
            owner.append(member)
            continue
        beside = members[n + 1] if member == LEFT_WALL else members[n - 1]
        if member == BOTTOM_WALL:
            left, right = members[n - 1], members[n + 1]
            x = [
                walls.x_min if left == LEFT_WALL else disc[left, 0],
                walls.x_max if right == RIGHT_WALL else disc[right, 0],
            ]
            points += [(x[0], walls.y_min), (x[1], walls.y_min)]
            owner += [-1, -1]
        else:
            level = disc[beside, 1] if beside >= 0 else walls.y_min
            points.append((walls.x_min if member == LEFT_WALL else walls.x_max, level))
            owner.append(-1)
    return np.array(points), np.array(owner)


@pytest.mark.parametrize(("corners", "length"), [(3, 1.0), (4, 1.0), (7, 1.0), (8, 5.0)])
@pytest.mark.parametrize(
    ("particles", "smallest"),
    [*((n, 0.5) for n in (1, 2, 5, 12, 30, 45)), (100, 0.05), (250, 0.05), (250, 0.02)],
)
def test_the_account_is_that_of_the_polygon_below_the_front(corners, length, particles, smallest):
    scale = 1.0 if length == 1.0 else 0.2
    state = steered(corners, particles, corners, 0.75, scale * smallest, length)
    particles = state.n_placed
    points, owner = line_of_the_front(state)
    walls = state.domain
    corners_below = [(walls.x_max, walls.y_min), (walls.x_min, walls.y_min)]
    below = shapely.Polygon([*points, *corners_below])
    tally = state.control.tally
    assert tally[ENCLOSED] == pytest.approx(below.area, rel=1e-9, abs=1e-9)

    area = state.supply.size[state.placed.source[:particles]] ** 2
    assert np.array_equal(state.control.area[:particles], area)
    on_front = owner[owner >= 0]
    solid = area.sum() - area[on_front].sum()
    for n, member in enumerate(owner):
        if member >= 0:
            turn = angle_below(points[n - 1], points[n], points[n + 1])
            solid += area[member] * turn / (2.0 * np.pi)
    assert tally[SOLID] == pytest.approx(solid, rel=1e-9, abs=1e-9)


def angle_below(before, here, after):
    """Angle on the right hand of the way from `before` over `here` to `after`."""
    first, second = complex(*(before - here)), complex(*(after - here))
    return float(np.angle(second / first) % (2.0 * np.pi))


def test_more_effort_is_spent_where_solid_is_missing():
    loose = steered(4, 40, seed=1, aim=0.9).control.tally
    dense = steered(4, 40, seed=1, aim=0.5).control.tally
    assert loose[EFFORT_SUM] > dense[EFFORT_SUM]
    assert 0.0 <= dense[EFFORT_SUM] <= loose[EFFORT_SUM] <= 40.0
