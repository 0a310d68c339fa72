"""Rooms of a polygon: what a disc is joined in, told by points and by edges."""

from __future__ import annotations

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Point, box

from grainfront.geometry.rooms import edges_of, holds_a_point, rooms_for_disc
from grainfront.geometry.signed_distance import ray_parity

TWO_HALLS = shapely.union_all([box(0, 0, 4, 4), box(4, 1.5, 6, 2.5), box(6, 0, 10, 4)])


def test_a_neck_parts_rooms_for_discs_that_do_not_fit_through():
    assert rooms_for_disc(TWO_HALLS, 0.49).size == 1
    assert rooms_for_disc(TWO_HALLS, 0.51).size == 2
    assert rooms_for_disc(TWO_HALLS, 2.1).size == 0
    assert edges_of(rooms_for_disc(TWO_HALLS, 2.1)).shape == (0, 4)


def test_a_room_without_a_point_is_told():
    rooms = rooms_for_disc(TWO_HALLS, 1.0)
    holds = holds_a_point(rooms, np.array([1.5, 2.5, 5.0]), np.array([2.0, 2.0, 2.0]))
    assert holds.tolist() == shapely.contains_xy(rooms, 2.0, 2.0).tolist()
    assert holds.sum() == 1


@settings(deadline=None)
@given(st.floats(-0.95, 10.95), st.floats(-0.95, 4.95))
def test_edges_tell_what_lies_inside(x, y):
    """Of polygons with holes, several at once; shapely is the oracle."""
    polygons = np.array([box(0, 0, 4, 4).difference(box(1, 1, 2, 3)), box(6, 0, 10, 4)])
    edges = edges_of(polygons)
    assert edges.shape == (12, 4)
    near = shapely.distance(shapely.boundary(polygons), Point(x, y)).min() < 1e-9
    assert near or ray_parity(edges, 0, 12, x, y) == shapely.contains_xy(polygons, x, y).any()
