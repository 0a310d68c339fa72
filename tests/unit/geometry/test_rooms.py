"""Rooms of a polygon: what a disc is joined in, told by points and by edges."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Point, box

from grainfront.geometry.rooms import Occupancy, edges_of, rooms_for_disc
from grainfront.geometry.signed_distance import ray_parity

TWO_HALLS = shapely.union_all([box(0, 0, 4, 4), box(4, 1.5, 6, 2.5), box(6, 0, 10, 4)])


def test_a_neck_parts_rooms_for_discs_that_do_not_fit_through():
    assert rooms_for_disc(TWO_HALLS, 0.49).size == 1
    rooms = rooms_for_disc(TWO_HALLS, 0.51)
    assert rooms.size == 2
    halls = shapely.union_all([box(0, 0, 4, 4), box(6, 0, 10, 4)])
    reached = shapely.area(shapely.intersection(rooms, halls))
    assert reached == pytest.approx(16 - (4 - np.pi) * 0.51**2, rel=0.001)
    assert rooms_for_disc(TWO_HALLS, 2.1).size == 0


def test_particles_are_counted_in_the_room_that_holds_their_centre():
    rooms = rooms_for_disc(TWO_HALLS, 1.0)
    left = int(np.argmin(shapely.get_x(shapely.centroid(rooms))))
    occupancy = Occupancy(rooms)
    occupancy.add(np.array([1.5, 5.0]), np.array([2.0, 2.0]))
    occupancy.add(np.array([2.5]), np.array([3.9]))
    assert (occupancy.particles[left], occupancy.particles[1 - left]) == (2, 0)


@settings(deadline=None)
@given(st.floats(-0.95, 10.95), st.floats(-0.95, 4.95))
def test_edges_tell_what_lies_inside(x, y):
    """Of a polygon with a hole; shapely is the oracle."""
    polygon = box(0, 0, 10, 4).difference(box(1, 1, 2, 3))
    edges = edges_of(polygon)
    assert edges.shape == (8, 4)
    near = shapely.distance(polygon.boundary, Point(x, y)) < 1e-9
    assert near or ray_parity(edges, 0, 8, x, y) == shapely.contains_xy(polygon, x, y)
