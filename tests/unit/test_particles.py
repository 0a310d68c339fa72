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
