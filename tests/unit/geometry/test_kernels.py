"""Tangent, contact and overlap kernels against the Minkowski sum and shapely, which build it."""

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from grainfront.geometry.contact import (
    contact_from_guess,
    contact_with_polygons,
    contact_with_wall,
)
from grainfront.geometry.minkowski import OVERLAPPING, no_fit_polygon, overlap_state
from grainfront.geometry.overlap import overlapping
from grainfront.geometry.tangent import common_tangent
from grainfront.jit import kernel

few = settings(max_examples=150, deadline=None)
counts = st.integers(3, 40)
seeds = st.integers(0, 2**32 - 1)
# Positions come from a few dozen operations on coordinates of about 1.
CLOSE = 1e-9


@kernel
def tangent_kernel(nodes, na, ax, ay, nb, bx, by):
    return common_tangent(nodes, 0, na, ax, ay, na, nb, bx, by)


@kernel
def contact_kernel(nodes, na, ia, nb, ib, trial):
    return contact_with_polygons(nodes, 0, na, ia, na, nb, ib, trial, 0, trial.shape[0])


@kernel
def guess_kernel(nodes, na, ia, ja, nb, ib, jb, trial):
    return contact_from_guess(nodes, 0, na, ia, ja, na, nb, ib, jb, trial, 0, trial.shape[0])


@kernel
def wall_kernel(nodes, clockwise, nx, ny, level, trial):
    return contact_with_wall(
        nodes, 0, nodes.shape[0], clockwise, nx, ny, level, trial, 0, trial.shape[0]
    )


@kernel
def overlap_kernel(nodes, qx, qy, trial, x, y, tolerance):
    return overlapping(nodes, 0, nodes.shape[0], qx, qy, trial, 0, trial.shape[0], x, y, tolerance)


def convex_polygon(rng, count):
    """A convex polygon of size 0.4 to 2 on a jittered ellipse round the origin, (count, 2)."""
    angle = (np.arange(count) + rng.uniform(-0.35, 0.35, count)) * 2.0 * np.pi / count
    nodes = np.column_stack([rng.uniform(0.2, 1.0) * np.cos(angle), np.sin(angle)])
    return turned(nodes, rng.uniform(0.0, 2.0 * np.pi)) * rng.uniform(0.2, 1.0)


def turned(nodes, angle):
    c, s = np.cos(angle), np.sin(angle)
    return nodes @ np.array([[c, s], [-s, c]])


def two_neighbours(rng, na, nb):
    """Disjoint polygons A round the origin and B, and B's centre."""
    a, b = convex_polygon(rng, na), convex_polygon(rng, nb)
    centre = turned(np.array([[rng.uniform(0.3, 2.5), 0.0]]), rng.uniform(0.0, 2.0 * np.pi))[0]
    assume(shapely.distance(shapely.Polygon(a), shapely.Polygon(b + centre)) > 1e-6)
    return a, b + centre, centre


@few
@given(seeds, counts, counts)
def test_both_polygons_lie_right_of_their_common_tangent(seed, na, nb):
    a, b, centre = two_neighbours(np.random.default_rng(seed), na, nb)
    nodes = np.concatenate([a, b])
    i, j = tangent_kernel(nodes, na, 0.0, 0.0, nb, *centre)
    u = b[j] - a[i]
    sides = u[0] * (nodes - a[i])[:, 1] - u[1] * (nodes - a[i])[:, 0]
    assert sides.max() <= CLOSE


def expected_contact(a, b, centre, n):
    """The crossing of the no-fit polygons that lies farthest left of A → B, by shapely."""
    boundaries = [shapely.LinearRing(no_fit_polygon(polygon, n)) for polygon in (a, b)]
    crossings = shapely.get_coordinates(shapely.intersection(*boundaries))
    left = centre[0] * crossings[:, 1] - centre[1] * crossings[:, 0]
    return crossings[np.argmax(left)] if len(crossings) else None


@few
@given(seeds, counts, counts, counts)
def test_contact_is_the_outer_crossing_of_the_no_fit_polygons(seed, na, nb, nn):
    rng = np.random.default_rng(seed)
    a, b, centre = two_neighbours(rng, na, nb)
    n = convex_polygon(rng, nn)
    nodes = np.concatenate([a, b])
    i, j = tangent_kernel(nodes, na, 0.0, 0.0, nb, *centre)
    found, x, y, *_ = contact_kernel(nodes, na, i, nb, j, n)
    expected = expected_contact(a, b, centre, n)
    assert found == (expected is not None)
    if found:
        np.testing.assert_allclose((x, y), expected, atol=CLOSE)


@few
@given(seeds, counts, counts, counts, st.floats(-0.3, 0.3))
def test_a_guess_from_a_similar_orientation_gives_the_same_bits(seed, na, nb, nn, turn):
    rng = np.random.default_rng(seed)
    a, b, centre = two_neighbours(rng, na, nb)
    n = convex_polygon(rng, nn)
    nodes = np.concatenate([a, b])
    i, j = tangent_kernel(nodes, na, 0.0, 0.0, nb, *centre)
    found, _, _, ia, ja, ib, jb, *_ = contact_kernel(nodes, na, i, nb, j, turned(n, turn))
    assume(found)
    found, x, y, *_ = contact_kernel(nodes, na, i, nb, j, n)
    guessed, gx, gy, *_ = guess_kernel(nodes, na, ia, ja, nb, ib, jb, n)
    if guessed:
        assert found and (gx, gy) == (x, y)


def test_most_guesses_are_right():
    rng = np.random.default_rng(0)
    right = tried = 0
    while tried < 200:
        a, b = convex_polygon(rng, 20), convex_polygon(rng, 20) + [1.6, 0.0]
        n, nodes = convex_polygon(rng, 20), np.concatenate([a, b])
        i, j = tangent_kernel(nodes, 20, 0.0, 0.0, 20, 1.6, 0.0)
        found, _, _, ia, ja, ib, jb, *_ = contact_kernel(nodes, 20, i, 20, j, turned(n, 0.13))
        if found and contact_kernel(nodes, 20, i, 20, j, n)[0]:
            tried += 1
            right += guess_kernel(nodes, 20, ia, ja, 20, ib, jb, n)[0]
    assert right >= 180


@few
@given(seeds, counts, counts, st.booleans())
def test_contact_with_a_wall_is_the_crossing_of_its_level(seed, na, nn, clockwise):
    rng = np.random.default_rng(seed)
    a, n = convex_polygon(rng, na), convex_polygon(rng, nn)
    boundary = no_fit_polygon(a, n)
    level = rng.uniform(boundary[:, 1].min(), boundary[:, 1].max())
    found, x, y = wall_kernel(a, clockwise, 0.0, 1.0, level, n)
    line = shapely.LineString([(-9.0, level), (9.0, level)])
    crossings = shapely.get_coordinates(shapely.LinearRing(boundary).intersection(line))
    expected = crossings[:, 0].max() if clockwise else crossings[:, 0].min()
    assert found
    np.testing.assert_allclose((x, y), (expected, level), atol=CLOSE)


@pytest.mark.parametrize("clockwise", [True, False])
def test_no_contact_with_a_wall_out_of_reach(clockwise):
    rng = np.random.default_rng(1)
    a, n = convex_polygon(rng, 7), convex_polygon(rng, 5)
    assert not wall_kernel(a, clockwise, 0.0, 1.0, -5.0, n)[0]
    assert not wall_kernel(a, clockwise, 0.0, 1.0, 5.0, n)[0]


@few
@given(seeds, counts, counts)
def test_overlap_is_a_point_inside_the_no_fit_polygon(seed, nq, nn):
    rng = np.random.default_rng(seed)
    q, n = convex_polygon(rng, nq), convex_polygon(rng, nn)
    place = shapely.Polygon(no_fit_polygon(q, n))
    for x, y in rng.uniform(-2.0, 2.0, (20, 2)):
        assume(shapely.distance(place.exterior, shapely.Point(x, y)) > CLOSE)
        overlaps = overlap_kernel(q, 0.0, 0.0, n, x, y, 0.0)
        assert overlaps == place.contains(shapely.Point(x, y))
        assert overlaps == (overlap_state(q, n + [x, y]) == OVERLAPPING)
        area = shapely.intersection(shapely.Polygon(q), shapely.Polygon(n + [x, y])).area
        assert overlaps == (area > 0.0)


@few
@given(seeds, counts, counts, st.floats(1e-9, 1e-3))
def test_overlap_accepts_penetrations_up_to_the_tolerance(seed, nq, nn, part_of_edge):
    rng = np.random.default_rng(seed)
    q, n = convex_polygon(rng, nq), convex_polygon(rng, nn)
    boundary = no_fit_polygon(q, n)
    k = rng.integers(len(boundary))
    edge = boundary[(k + 1) % len(boundary)] - boundary[k]
    inward = np.array([-edge[1], edge[0]]) / np.hypot(*edge)
    tolerance = part_of_edge * np.hypot(*edge)
    middle = boundary[k] + 0.5 * edge
    assert not overlap_kernel(q, 0.0, 0.0, n, *(middle + 0.9 * tolerance * inward), tolerance)
    if (
        shapely.Polygon(boundary)
        .buffer(-1.2 * tolerance)
        .intersects(shapely.Point(middle + 1.3 * tolerance * inward))
    ):
        assert overlap_kernel(q, 0.0, 0.0, n, *(middle + 1.3 * tolerance * inward), tolerance)


def test_equal_squares_side_by_side_carry_a_third_flat_on_both():
    square = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    nodes = np.concatenate([square, square + [1.0, 0.0]])
    i, j = tangent_kernel(nodes, 4, 0.0, 0.0, 4, 1.0, 0.0)
    found, x, y, *_ = contact_kernel(nodes, 4, i, 4, j, square)
    assert found and y == 1.0 and 0.0 <= x <= 1.0
    assert not overlap_kernel(square, 0.0, 0.0, square, x, y, 1e-15)
