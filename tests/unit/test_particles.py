"""Regions keep the polygons that they are made of, and refuse what is none."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront.errors import InputError
from grainfront.particles import Region

boxes = st.tuples(st.integers(0, 9), st.integers(0, 9), st.integers(1, 5), st.integers(1, 5)).map(
    lambda b: shapely.box(b[0], b[1], b[0] + b[2], b[1] + b[3])
)


@settings(max_examples=50, deadline=None)
@given(st.lists(boxes, min_size=1, max_size=5), st.lists(boxes, max_size=3))
def test_a_region_is_the_polygon_it_was_made_of(added, removed):
    polygon = shapely.union_all(added).difference(shapely.union_all(removed))
    if polygon.geom_type not in ("Polygon", "MultiPolygon") or polygon.is_empty:
        return
    region = Region.of(polygon)
    assert region.to_shapely().equals(polygon)
    assert region.area == polygon.area
    assert (region.x_min, region.y_min, region.x_max, region.y_max) == polygon.bounds
    again = Region.of(region.to_shapely())
    np.testing.assert_array_equal(again.rings.nodes, region.rings.nodes)
    for r in range(region.rings.count):
        outer = r in region.parts[:-1]
        assert shapely.is_ccw(shapely.linearrings(region.rings.polygon(r))) == outer


@pytest.mark.parametrize(
    ("shape", "says"),
    [
        (shapely.Point(0, 0), "is a Point, but must be a Polygon or MultiPolygon"),
        (shapely.Polygon(), "is an empty Polygon"),
        (shapely.Polygon([(0, 0), (1, 1), (1, 0), (0, 1)]), "no valid polygon: Self-intersection"),
        (shapely.Polygon([(0, 0), (1, 0), (1, np.inf)]), "no valid polygon: Invalid Coordinate"),
    ],
)
def test_what_is_no_polygon_is_refused(shape, says):
    with pytest.raises(InputError, match=says):
        Region.of(shape)


SQUARE = shapely.box(0, 0, 9, 9)
STAR = shapely.Polygon([(3, 3), (5, 4), (7, 3), (6, 5), (7, 7), (5, 6), (3, 7), (4, 5)])


def test_inclusions_are_cut_out_node_by_node():
    beside = shapely.box(7, 3, 9, 7)  # touches a tip of the star and the wall
    region = Region.of(SQUARE).without([STAR, beside])
    assert region.area == SQUARE.area - STAR.area - beside.area
    nodes = {tuple(node) for shape in (SQUARE, STAR, beside) for node in shape.exterior.coords}
    assert {tuple(node) for node in region.rings.nodes.tolist()} <= nodes


@pytest.mark.parametrize(
    ("inclusions", "says"),
    [
        ([STAR, shapely.box(6, 6, 8, 8)], "Inclusion 1 crosses"),
        ([shapely.box(8, 8, 10, 10)], "Inclusion 0 crosses the boundary"),
        ([shapely.LineString([(1, 1), (2, 2)])], "Inclusion 0 is a LineString"),
        ([SQUARE], "an empty"),
    ],
)
def test_inclusions_out_of_place_are_refused(inclusions, says):
    with pytest.raises(InputError, match=says):
        Region.of(SQUARE).without(inclusions)
