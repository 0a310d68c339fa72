"""Descriptors against closed forms, shapely and brute force."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront.polygons import Polygons
from grainfront.shapes.descriptors import (
    circumscribed_radius,
    clean_outline,
    describe,
    feret,
    hull_indices,
    inscribed_radius,
    regularity,
)

SEEDS = st.integers(0, 2**32 - 1)


def random_outline(seed, nodes=24, roughness=0.5):
    """A star-shaped, generally nonconvex outline about the origin."""
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.uniform(0, 2 * np.pi, nodes))
    angle += np.arange(nodes) * 1e-3
    radius = 1 + roughness * rng.uniform(-1, 1, nodes)
    outline = radius[:, None] * np.column_stack([2 * np.cos(angle), np.sin(angle)])
    polygon = shapely.Polygon(outline)
    return outline if polygon.is_valid else shapely.get_coordinates(polygon.convex_hull)[:0:-1]


def describe_one(outline):
    hull = outline[hull_indices(outline)]
    return {k: v[0] for k, v in describe(Polygons.of([outline]), Polygons.of([hull])).items()}


def rotated(outline, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return outline @ [[c, s], [-s, c]]


@given(SEEDS)
@settings(max_examples=40, deadline=None)
def test_size_is_the_least_width_over_all_directions(seed):
    outline = random_outline(seed)
    found = feret(outline[hull_indices(outline)])
    assert found.size == pytest.approx(
        shapely.length(shapely.minimum_width(shapely.MultiPoint(outline))), rel=1e-12
    )
    angles = np.radians(np.arange(0, 180, 0.05))
    widths = np.ptp(outline @ [np.cos(angles), np.sin(angles)], axis=0)
    assert found.size <= widths.min() * (1 + 1e-12)
    assert widths.min() == pytest.approx(found.size, rel=5e-3)


@given(SEEDS)
@settings(max_examples=40, deadline=None)
def test_length_and_orientation_are_perpendicular_to_the_width(seed):
    outline = random_outline(seed)
    size, length, orientation = feret(outline[hull_indices(outline)])
    level = rotated(outline, -orientation)
    assert 0 <= orientation < 180
    np.testing.assert_allclose(np.ptp(level, axis=0), [length, size], rtol=1e-12)


@pytest.mark.parametrize("turn", [0.0, 1e-14, 17.0, 45.0, 89.0])
def test_square_ties_go_to_the_smallest_angle(turn):
    square = rotated(np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]]), turn)
    found = feret(square)
    assert found.size == pytest.approx(1, rel=1e-12)
    assert found.orientation == pytest.approx(turn, abs=1e-9)


def test_an_orientation_a_hair_below_180_is_0():
    sliver = rotated(np.array([[0, 0], [3, 0], [3, 1], [0, 1.0]]), -1e-13)
    assert feret(sliver).orientation == 0.0


def test_rectangle():
    found = describe_one(rotated(np.array([[0, 0], [4, 0], [4, 3], [0, 3.0]]), 30))
    expected = {
        "size": 3, "length": 4, "aspect_ratio": 4 / 3, "orientation": 30, "area": 12,
        "hull_area": 12, "perimeter": 14, "convex_perimeter": 14, "convexity": 1,
        "inscribed_radius": 1.5, "circumscribed_radius": 2.5, "circularity": np.sqrt(0.6),
        "regularity": np.inf,
    }  # fmt: skip
    assert found == pytest.approx(expected, rel=1e-9)


def test_ellipse_as_a_fine_polygon():
    angle = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    found = describe_one(rotated(np.column_stack([3 * np.cos(angle), np.sin(angle)]), 70))
    assert found["size"] == pytest.approx(2, rel=1e-5)
    assert found["aspect_ratio"] == pytest.approx(3, rel=1e-5)
    assert found["orientation"] == pytest.approx(70, abs=0.2)
    assert found["circularity"] == pytest.approx(np.sqrt(1 / 3), rel=1e-5)
    assert found["perimeter"] == pytest.approx(13.3648932206, rel=1e-5)  # 12 E(8/9)


def test_five_pointed_star():
    angle = np.pi / 2 + np.arange(10) * np.pi / 5
    inner = np.sin(np.pi / 10) / np.sin(7 * np.pi / 10)
    radius = np.where(np.arange(10) % 2 == 0, 1.0, inner)
    found = describe_one(radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))
    edge = np.sqrt(1 + inner**2 - 2 * inner * np.cos(np.pi / 5))
    hull_edge = 2 * np.sin(np.pi / 5)
    assert found["perimeter"] == pytest.approx(10 * edge)
    assert found["convex_perimeter"] == pytest.approx(5 * hull_edge)
    assert found["regularity"] == pytest.approx(np.log10(10 * edge / (10 * edge - 5 * hull_edge)))
    assert found["convexity"] == pytest.approx(hull_edge / (2 * edge))
    # The largest circle touches the five reflex nodes, none of the edges' interiors.
    assert found["inscribed_radius"] == pytest.approx(inner, rel=1e-9)
    assert found["circumscribed_radius"] == pytest.approx(1, rel=1e-12)
    assert found["size"] == pytest.approx(1 + np.cos(np.pi / 5))


@given(SEEDS)
@settings(max_examples=30, deadline=None)
def test_circumscribed_circle_against_all_pairs_and_triples(seed):
    points = random_outline(seed, nodes=9)
    radii = [circle_radius(points, i) for i in combinations_of(len(points))]
    assert circumscribed_radius(points) == pytest.approx(min(radii), rel=1e-9)


def combinations_of(n):
    from itertools import combinations

    return [*combinations(range(n), 2), *combinations(range(n), 3)]


def circle_radius(points, index):
    """Radius of the circle carried by two or three points, infinite if it misses another point."""
    p = points[list(index)]
    if len(p) == 2:
        centre = p.mean(axis=0)
    else:
        try:
            centre = np.linalg.solve(2 * (p[1:] - p[0]), (p[1:] ** 2 - p[0] ** 2).sum(axis=1))
        except np.linalg.LinAlgError:
            return np.inf
    radius = np.hypot(*(p[0] - centre))
    inside = np.hypot(*(points - centre).T) <= radius * (1 + 1e-9)
    return radius if inside.all() else np.inf


@given(SEEDS)
@settings(max_examples=20, deadline=None)
def test_no_point_of_a_fine_grid_has_a_wider_clearance_than_the_inscribed_circle(seed):
    outline = random_outline(seed)
    radius = inscribed_radius(outline)
    polygon = shapely.Polygon(outline)
    x, y = np.meshgrid(np.linspace(-3, 3, 241), np.linspace(-1.5, 1.5, 121))
    grid = shapely.points(x.ravel(), y.ravel())
    clearance = shapely.distance(polygon.exterior, grid[shapely.contains(polygon, grid)])
    assert clearance.max() <= radius * (1 + 1e-9)
    # A grid of step h has a point within h/sqrt(2) of the centre, whose clearance lacks no more.
    assert radius <= clearance.max() + 0.025 / np.sqrt(2)


@given(SEEDS, st.integers(-40, 40))
@settings(max_examples=20, deadline=None)
def test_descriptors_scale_by_powers_of_two_bit_for_bit(seed, exponent):
    outline = random_outline(seed)
    hull = outline[hull_indices(outline)]
    found, scaled = feret(hull), feret(np.ldexp(hull, exponent))
    assert scaled.size == np.ldexp(found.size, exponent)
    assert scaled.length == np.ldexp(found.length, exponent)
    assert scaled.orientation == found.orientation


def test_regularity_of_a_known_excess():
    np.testing.assert_allclose(regularity(np.array([10.0, 4.0]), np.array([9.0, 4.0])), [1, np.inf])


def test_collinear_and_repeated_nodes_are_cleaned_away():
    outline = np.array(
        [[0, 0], [1, 1e-13], [2, 0], [2, 0], [2, 2], [1, 2 - 1e-12], [1e-12, 2], [0, 2]], float
    )
    cleaned = clean_outline(outline)
    np.testing.assert_allclose(
        cleaned[hull_indices(cleaned)], [[0, 0], [2, 0], [2, 2], [0, 2]], atol=1e-11
    )
    assert len(cleaned) == 4


def test_a_reflex_outline_whose_tongue_touches_the_hull_is_moved_inside_it():
    outline = np.array([[0, 0], [0.5, 1], [1, 0], [1.5, 1], [2, 0], [2, 3], [0, 3.0]])
    cleaned = clean_outline(outline)
    assert hull_indices(cleaned).tolist() == [0, 4, 5, 6]
    assert 1e-10 < cleaned[2, 1] < 1e-8


@given(SEEDS)
@settings(max_examples=30, deadline=None)
def test_hull_holds_the_outline_and_is_strictly_convex(seed):
    outline = clean_outline(random_outline(seed, nodes=40))
    hull = outline[hull_indices(outline)]
    edge = np.roll(hull, -1, axis=0) - hull
    turn = (
        edge[:, 0] * np.roll(edge, -1, axis=0)[:, 1] - edge[:, 1] * np.roll(edge, -1, axis=0)[:, 0]
    )
    assert turn.min() > 0
    assert shapely.Polygon(hull).covers(shapely.Polygon(outline))
