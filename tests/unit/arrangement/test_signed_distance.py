"""Signed distances against shapely, closed formulas and exact fractions."""

from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront.arrangement.fields import distance_at, inside_at, signed_distances
from grainfront.arrangement.resolve import resolve
from grainfront.arrangement.zones import (
    Bars,
    Box,
    Circle,
    Difference,
    HalfPlane,
    Intersection,
    Moved,
    Offset,
    Polygon,
    Union,
)
from grainfront.particles import Rectangle

DOMAIN = Rectangle(-3.0, 2.0, 9.0, 10.0)
SEEDS = st.integers(0, 2**32 - 1)
QUICK = settings(max_examples=20, deadline=None)


def points_in(domain, n, rng):
    return (
        rng.uniform(domain.x_min, domain.x_max, n),
        rng.uniform(domain.y_min, domain.y_max, n),
    )


def field_of(*zones, domain=DOMAIN):
    return signed_distances([resolve(zone, domain) for zone in zones], domain)


def star(rng, n, centre=(3.0, 6.0), radius=3.0):
    """A random simple polygon, far from convex."""
    angle = np.sort(rng.uniform(0, 2 * np.pi, n))
    r = radius * rng.uniform(0.2, 1.0, n)
    nodes = np.column_stack([centre[0] + r * np.cos(angle), centre[1] + r * np.sin(angle)])
    return Polygon(tuple(map(tuple, nodes.tolist())))


def random_zone(rng, depth):
    kind = rng.integers(3 if depth == 0 else 8)
    centre = tuple(rng.uniform((-2.0, 3.0), (8.0, 9.0)).tolist())
    match kind:
        case 0:
            return star(rng, int(rng.integers(12, 30)), centre, rng.uniform(1.0, 4.0))
        case 1:
            return Box(centre, *rng.uniform(0.5, 6.0, 2).tolist())
        case 2:
            return HalfPlane(centre, tuple(rng.normal(size=2).tolist()))
        case 3:
            width = rng.uniform(0.2, 1.0)
            return Bars(width, width * rng.uniform(1.2, 4.0), rng.uniform(0, 180), centre)
        case 4:
            about = (3.0, 6.0)
            return Moved(
                random_zone(rng, depth - 1), rng.uniform(0.5, 2), rng.uniform(0, 360), about
            )
    operation = (Union, Intersection, Difference)[kind - 5]
    return operation((random_zone(rng, depth - 1), random_zone(rng, depth - 1)))


@QUICK
@given(SEEDS)
def test_distance_and_side_are_those_of_shapely(seed):
    rng = np.random.default_rng(seed)
    zones = [resolve(random_zone(rng, 2), DOMAIN) for _ in range(2)]
    field = signed_distances(zones, DOMAIN)
    x, y = points_in(DOMAIN, 150, rng)
    points = shapely.points(x, y)
    diagonal = np.hypot(DOMAIN.width, DOMAIN.height)
    for k, zone in enumerate(zones):
        distance = distance_at(field, k, x, y)
        # what lies beyond the window is not looked for, and the window's own border is none
        expected = shapely.distance(zone.polygon.boundary, points) if zone.polygon.area else np.inf
        known = np.broadcast_to(expected < diagonal, x.shape)
        inside = shapely.contains(zone.polygon, points)
        assert np.array_equal(inside_at(field, k, x, y), inside)
        assert np.array_equal(np.signbit(distance), inside)
        assert np.abs(distance[known]) == pytest.approx(np.broadcast_to(expected, x.shape)[known])
        assert (np.abs(distance[~known]) >= diagonal).all()


def exactly_inside(nodes, x, y):
    """Whether a point lies inside a polygon, in fractions; None on its boundary."""
    nodes = [(Fraction(a), Fraction(b)) for a, b in nodes]
    x, y = Fraction(x), Fraction(y)
    inside = False
    for (ax, ay), (bx, by) in zip(nodes, nodes[1:] + nodes[:1], strict=True):
        side = (bx - ax) * (y - ay) - (by - ay) * (x - ax)
        if side == 0 and min(ax, bx) <= x <= max(ax, bx) and min(ay, by) <= y <= max(ay, by):
            return None
        if (ay <= y) != (by <= y):
            inside ^= (side < 0) == (by > ay)
    return inside


@QUICK
@given(SEEDS)
def test_the_side_is_exact_however_close_the_boundary_is(seed):
    rng = np.random.default_rng(seed)
    zone = star(rng, 16)
    field = field_of(zone)
    nodes = np.array(zone.nodes)
    first = rng.integers(len(nodes), size=60)
    share = np.where(rng.random(60) < 0.2, 0.0, rng.random(60))[:, None]
    on_edge = nodes[first] * (1 - share) + nodes[(first + 1) % len(nodes)] * share
    near = on_edge * (1 + rng.integers(-2, 3, size=on_edge.shape) * 2.0**-52)
    inside = inside_at(field, 0, *near.T)
    expected = [exactly_inside(zone.nodes, *point) for point in near.tolist()]
    for found, wanted in zip(inside, expected, strict=True):
        assert wanted is None or found == wanted


def test_walls_of_cells_and_nodes_on_them_do_not_mislead():
    """Edges run along the lines of the grid, nodes lie on its corners, and points on both."""
    domain = Rectangle(0.0, 0.0, 64.0, 64.0)
    steps = ((8, 8), (40, 8), (40, 24), (24, 24), (24, 40), (40, 40), (40, 56), (8, 56))
    field = field_of(Polygon(tuple((float(a), float(b)) for a, b in steps)), domain=domain)
    assert field.cell == 1.0
    x, y = (c.ravel() for c in np.meshgrid(np.arange(0, 64.5, 0.5), np.arange(0, 64.5, 0.5)))
    for a, b, found in zip(x, y, inside_at(field, 0, x, y), strict=True):
        wanted = exactly_inside(steps, a, b)
        assert wanted is None or found == wanted


def test_zones_that_touch_in_a_point():
    field = field_of(Union((Box((2.0, 5.0), 2.0, 2.0), Box((4.0, 7.0), 2.0, 2.0))))
    x, y = [2.5, 3.5, 2.5, 3.5, 3.0], [5.5, 5.5, 6.5, 6.5, 8.5]
    assert distance_at(field, 0, x, y) == pytest.approx([-0.5, 0.5, 0.5, -0.5, 0.5])


@QUICK
@given(SEEDS)
def test_half_planes_have_the_distance_of_their_line(seed):
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=2)
    point = rng.uniform((-3, 2), (9, 10))
    field = field_of(HalfPlane(tuple(point), tuple(normal)))
    x, y = points_in(DOMAIN, 100, rng)
    expected = (np.column_stack([x, y]) - point) @ normal / np.hypot(*normal)
    assert distance_at(field, 0, x, y) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("direction", [0.0, 90.0, 30.0])
def test_bars_repeat(direction):
    rng = np.random.default_rng(3)
    field = field_of(Bars(0.6, 1.5, direction, (1.0, 4.0)))
    x, y = points_in(DOMAIN, 500, rng)
    along = np.radians(direction)
    across = (y - 4.0) * np.cos(along) - (x - 1.0) * np.sin(along)
    from_centre_line = np.abs((across + 0.75) % 1.5 - 0.75)
    assert distance_at(field, 0, x, y) == pytest.approx(from_centre_line - 0.3, abs=1e-12)


def test_circles_and_round_corners_are_right_to_their_edges():
    rng = np.random.default_rng(4)
    x, y = points_in(DOMAIN, 500, rng)
    round_box = Offset(Box((3.0, 6.0), 3.0, 2.0), 1.0)
    field = field_of(Circle((3.0, 6.0), 2.0), round_box, Box((3.0, 6.0), 3.0, 2.0))
    sagitta = 1 - np.cos(np.radians(0.5))
    exact = np.hypot(x - 3.0, y - 6.0) - 2.0
    assert np.abs(distance_at(field, 0, x, y) - exact).max() <= 2.0 * sagitta * (1 + 1e-9)
    box = distance_at(field, 2, x, y)
    outside = box > 0
    grown = distance_at(field, 1, x, y)[outside] - (box[outside] - 1.0)
    assert np.abs(grown).max() <= sagitta * (1 + 1e-9)


@QUICK
@given(SEEDS)
def test_set_operations_have_the_sign_of_the_papers_equations(seed):
    """Minimum and maximum (Eqs. 5–7) have the sign, and never more than the distance."""
    rng = np.random.default_rng(seed)
    a, b = random_zone(rng, 0), random_zone(rng, 0)
    pair = (a, b)
    field = field_of(a, b, Union(pair), Intersection(pair), Difference(pair))
    x, y = points_in(DOMAIN, 200, rng)
    d = [distance_at(field, k, x, y) for k in range(5)]
    for exact, bound in (
        (d[2], np.minimum(d[0], d[1])),
        (d[3], np.maximum(d[0], d[1])),
        (d[4], np.maximum(d[0], -d[1])),
    ):
        assert np.array_equal(exact < 0, bound < 0)
        assert (np.abs(exact) >= np.abs(bound) - 1e-9).all()


@pytest.mark.parametrize("scale", [2.0**-40, 2.0**30])
def test_scaling_by_a_power_of_two_scales_every_bit(scale):
    rng = np.random.default_rng(5)
    zone = star(rng, 40)
    larger = Polygon(tuple((a * scale, b * scale) for a, b in zone.nodes))
    domain = Rectangle(*(scale * v for v in (-3.0, 2.0, 9.0, 10.0)))
    x, y = points_in(DOMAIN, 300, rng)
    distance = distance_at(field_of(larger, domain=domain), 0, scale * x, scale * y)
    assert np.array_equal(distance, scale * distance_at(field_of(zone), 0, x, y))


def test_far_from_the_origin():
    rng = np.random.default_rng(6)
    zone = star(rng, 40)
    shifted = Moved(zone, shift=(2.0**20, -(2.0**20)))
    domain = Rectangle(-3.0 + 2.0**20, 2.0 - 2.0**20, 9.0 + 2.0**20, 10.0 - 2.0**20)
    x, y = points_in(DOMAIN, 300, rng)
    distance = distance_at(field_of(shifted, domain=domain), 0, x + 2.0**20, y - 2.0**20)
    assert distance == pytest.approx(distance_at(field_of(zone), 0, x, y), abs=1e-8)


def test_without_any_boundary_in_sight_the_distance_is_infinite():
    field = field_of(HalfPlane((3.0, 1000.0), (0.0, 1.0)), Intersection((HalfPlane((0, 3), (0, 1)),
                     HalfPlane((0, 8), (0, -1)))))  # fmt: skip
    assert distance_at(field, 0, 3.0, 6.0) == pytest.approx(-994.0)
    assert distance_at(field, 1, 3.0, 6.0) == np.inf


def test_points_outside_the_grid_are_refused():
    with pytest.raises(ValueError, match="outside the domain"):
        distance_at(field_of(Box((3.0, 6.0), 1.0, 1.0)), 0, 0.0, 100.0)
