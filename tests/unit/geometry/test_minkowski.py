"""The Minkowski sum against shapely's convex hull of the vertex sums."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront.geometry.minkowski import (
    APART,
    OVERLAPPING,
    TOUCHING,
    minkowski_sum,
    no_fit_polygon,
    overlap_state,
)

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
few = settings(max_examples=100, deadline=None)
seeds = st.integers(0, 2**32 - 1)


def convex_hull(rng, n):
    hull = shapely.convex_hull(shapely.MultiPoint(rng.normal(size=(n, 2))))
    return shapely.get_coordinates(shapely.orient_polygons(hull, exterior_cw=False))[:-1]


@few
@given(seeds, st.integers(3, 30), st.integers(3, 30))
def test_sum_is_the_convex_hull_of_the_vertex_sums(seed, n, m):
    rng = np.random.default_rng(seed)
    a, b = convex_hull(rng, n), convex_hull(rng, m)
    sums = shapely.MultiPoint((a[:, None] + b[None]).reshape(-1, 2)).convex_hull
    result = shapely.Polygon(minkowski_sum(a, b))
    assert result.exterior.is_ccw
    assert result.hausdorff_distance(sums) < 1e-12
    assert len(minkowski_sum(a, b)) <= len(a) + len(b)


def test_parallel_edges_become_one():
    expected = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    np.testing.assert_array_equal(minkowski_sum(SQUARE, SQUARE), expected)
    np.testing.assert_array_equal(no_fit_polygon(SQUARE, SQUARE), expected - 1.0)


@few
@given(seeds, st.integers(3, 20), st.integers(3, 20))
def test_overlap_state_agrees_with_overlay(seed, n, m):
    rng = np.random.default_rng(seed)
    a, b = convex_hull(rng, n), convex_hull(rng, m) + rng.uniform(-4.0, 4.0, 2)
    common = shapely.intersection(shapely.Polygon(a), shapely.Polygon(b)).area
    assert overlap_state(a, b) == (OVERLAPPING if common > 0.0 else APART)
    assert overlap_state(a, b) == overlap_state(b, a)


@pytest.mark.parametrize(
    ("shift", "tolerance", "state"),
    [
        ((1.0, 0.0), 0.0, TOUCHING),  # edge on edge
        ((1.0, 1.0), 0.0, TOUCHING),  # corner on corner
        ((1.0, 0.4), 0.0, TOUCHING),
        ((1.0 - 2**-50, 0.0), 0.0, OVERLAPPING),
        ((1.0 - 2**-50, 0.0), 1e-12, TOUCHING),
        ((1.0 + 2**-50, 0.0), 0.0, APART),
        ((1.0 + 2**-50, 0.0), 1e-12, TOUCHING),
        ((1.1, 1.1), 0.12, APART),  # 0.141 from corner to corner
        ((0.0, 0.0), 0.0, OVERLAPPING),
        ((3.0, -2.0), 0.0, APART),
    ],
)
def test_overlap_state_of_squares(shift, tolerance, state):
    assert overlap_state(SQUARE, SQUARE + shift, tolerance) == state


@pytest.mark.parametrize("bad", [SQUARE[:2], SQUARE[::-1], np.zeros((4, 2)), np.zeros(6)])
def test_what_is_no_polygon_is_refused(bad):
    with pytest.raises(ValueError, match="polygon"):
        minkowski_sum(bad, SQUARE)
