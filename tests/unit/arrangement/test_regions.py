"""Regions and strata of points, against shapely and the definition."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront.arrangement.build import assign, region_map, resolve_regions
from grainfront.arrangement.regions import (
    Arrangement,
    GradedAlong,
    GradedByDistance,
    LocalLaws,
    Region,
)
from grainfront.arrangement.zones import Bars, Box, Circle, HalfPlane, Offset
from grainfront.errors import InputError
from grainfront.geometry.regions import MIXED, REST
from grainfront.laws import Constant
from grainfront.particles import Rectangle

DOMAIN = Rectangle(-3.0, 2.0, 9.0, 10.0)
LAWS = (LocalLaws(size=Constant(1.0)),)


def points(rng, n=400):
    return rng.uniform(DOMAIN.x_min, DOMAIN.x_max, n), rng.uniform(DOMAIN.y_min, DOMAIN.y_max, n)


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_the_first_region_that_holds_a_point_has_it(seed):
    rng = np.random.default_rng(seed)
    centres = rng.uniform((-3, 2), (9, 10), (3, 2))
    circle, *boxes = [tuple(centre) for centre in centres.tolist()]
    zones = [Circle(circle, rng.uniform(0.5, 4)), *(Box(c, *rng.uniform(1, 8, 2)) for c in boxes)]
    arrangement = Arrangement(tuple(Region(zone, LAWS) for zone in zones))
    x, y = points(rng)
    found = assign(region_map(arrangement, DOMAIN), x, y)
    expected = np.full(x.size, REST)
    for k, zone in reversed(list(enumerate(resolve_regions(arrangement, DOMAIN)))):
        expected[shapely.contains_xy(zone.polygon, x, y)] = k
    assert np.array_equal(found.region, expected)
    assert np.array_equal(found.stratum, expected)


def test_most_cells_know_their_region():
    regions = region_map(Arrangement((Region(Circle((3.0, 6.0), 3.0), LAWS),)), DOMAIN)
    assert 0 < np.mean(regions.owner == MIXED) < 0.1
    assert {REST, 0, MIXED} == set(regions.owner.tolist())


def test_strata_along_a_way_are_of_equal_steps_and_constant_beyond():
    before = Region(Circle((-2.0, 3.0), 0.5), LAWS)
    graded = Region(None, LAWS * 4, GradedAlong((0.0, 4.0), (3.0, 8.0)))
    x, y = points(np.random.default_rng(1))
    found = assign(region_map(Arrangement((before, graded)), DOMAIN), x, y)
    share = (0.6 * x + 0.8 * (y - 4.0)) / 5.0
    expected = np.where(found.region == 0, 0, 1 + np.clip(np.floor(4 * share), 0, 3))
    assert set(found.region) == {0, 1}
    assert np.array_equal(found.stratum, expected)


def test_strata_by_distance():
    graded = Region(Box((3.0, 6.0), 8.0, 6.0), LAWS * 3, GradedByDistance(0.0, -3.0))
    x, y = points(np.random.default_rng(2))
    found = assign(region_map(Arrangement((graded,)), DOMAIN), x, y)
    depth = np.minimum(4.0 - np.abs(x - 3.0), 3.0 - np.abs(y - 6.0))
    expected = np.where(depth > 0, np.floor(depth), REST)
    assert np.array_equal(found.stratum, expected)


def test_a_region_outside_the_domain_is_refused():
    far = Region(HalfPlane((0.0, 0.0), (0.0, 1.0)), LAWS)
    near = Region(Circle((3.0, 6.0), 3.0), LAWS)
    with pytest.raises(InputError, match=r"arrangement.regions\[1\].inside lies outside"):
        region_map(Arrangement((near, far)), DOMAIN)


def test_distances_are_kept_only_of_zones_that_are_graded_by_them():
    """Fifty circles took minutes and gigabytes, for distances that nobody asked for."""
    strata = (LocalLaws(orientation=Constant(1.0)), LocalLaws(orientation=Constant(2.0)))
    plain = Region(Circle((3.0, 6.0), 3.0), LAWS)
    graded = Region(Circle((3.0, 6.0), 2.0), strata, GradedByDistance(0.0, -1.0))
    field = region_map(Arrangement((plain, graded)), DOMAIN).field
    cells = field.columns * field.rows
    assert field.nearest_offsets[cells] == 0
    assert np.all(np.diff(field.nearest_offsets[cells:]) > 0)
    assert field.touching_offsets[cells] > 0


def test_a_region_of_which_nothing_is_left_is_refused_as_such():
    gone = Region(Offset(Circle((3.0, 6.0), 3.0), -4.0), LAWS)
    with pytest.raises(InputError, match=r"regions\[0\].inside: nothing is left of the zone"):
        region_map(Arrangement((gone,)), DOMAIN)


def test_what_is_wrong_with_a_zone_is_told_with_its_region():
    bars = Region(Bars(1e-6, 2e-6), LAWS)
    with pytest.raises(InputError, match=r"^arrangement.regions\[0\].inside: bars are 2e-06 apart"):
        region_map(Arrangement((bars,)), DOMAIN)
