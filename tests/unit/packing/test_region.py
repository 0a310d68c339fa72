"""Packings in domains of any shape: inside them exactly, as dense as in rectangles, all filled."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Point, Polygon, affinity, box

from grainfront.certificate import certify
from grainfront.errors import InputError
from grainfront.geometry.rings import polygon_areas
from grainfront.packing.fronts import advance_to
from grainfront.packing.orientations import orientation_law
from grainfront.packing.pack import fill
from grainfront.packing.prepare import prepare
from grainfront.packing.region import outside_pieces
from grainfront.packing.steering import Steering
from grainfront.particles import Rectangle, Region
from grainfront.polygons import Polygons
from grainfront.statistics import find_contacts, find_rooms, volume_fraction_bulk


def l_shape(side):
    half = side / 2
    return Polygon([(0, 0), (side, 0), (side, half), (half, half), (half, side), (0, side)])


def hopper(side):
    """A funnel with an outlet a fifth as wide as itself."""
    nodes = [(0.4, 0), (0.6, 0), (0.6, 0.1), (1, 0.5), (1, 1), (0, 1), (0, 0.5), (0.4, 0.1)]
    return Polygon(side * np.array(nodes))


DOMAINS = {
    "L": l_shape,
    "circle": lambda side: Point(0.0, 0.0).buffer(side / 2, quad_segs=12),
    "hopper": hopper,
    "square with a hole": lambda side: box(0, 0, side, side).difference(
        Point(side / 2, side / 2).buffer(side / 5)
    ),
    "two islands": lambda side: shapely.union_all(
        [box(0, 0, 0.4 * side, side), box(0.6 * side, 0.3 * side, side, side)]
    ),
}


def ellipse(aspect_ratio, nodes):
    angle = np.arange(nodes) * 2.0 * np.pi / nodes + 0.1
    return np.column_stack([aspect_ratio * np.cos(angle), np.sin(angle)]) / 2.0


RECTANGLE = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [0.75, 0.5]
FAMILIES = {
    "rectangles": [RECTANGLE],
    "triangles": [np.array([[-0.5, -0.3], [0.5, -0.3], [0.0, 0.6]])],
    "hulls": [ellipse(1.3, 20), ellipse(1.6, 13)],
}


def particles(family, area, smallest, seed):
    """The arguments of `prepare` but the domain: enough particles to fill an area."""
    hulls = Polygons.of(FAMILIES[family])
    rng = np.random.default_rng(seed)
    mean_area = polygon_areas(hulls.nodes, hulls.offsets).min() * (smallest + 1.0) ** 2 / 4
    n = int(1.5 * area / mean_area) + 30
    law = orientation_law(np.full(24, 1 / 24), np.linspace(0.0, 180.0, 6145))
    return hulls, rng.integers(0, hulls.count, n), rng.uniform(smallest, 1.0, n), law, rng


def pack(family, domain, n_angle, n_loc, seed=0, smallest=0.5):
    hulls, shape, size, law, rng = particles(family, domain.area, smallest, seed)
    empty = prepare(hulls, shape, size, [law], domain, n_angle, n_loc, rng)
    return fill(empty, np.ones(hulls.count))[0]


# Share of the choices; 0, 4 of 721 and 1 of 317 were seen, at most.
MOST_OTHERS = {"rectangles": 0.0, "triangles": 0.006, "hulls": 0.005}


@pytest.mark.compiled
@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("name", DOMAINS)
def test_nearly_every_choice_is_that_of_exhaustive_search(family, name):
    """The bounds among obstacles are not proven: 8 of these 6,133 choices are others."""
    region = Region.of(DOMAINS[name](18.0))
    hulls, shape, size, law, rng = particles(family, region.area, 0.5, 1)
    pruned = prepare(hulls, shape, size, [law], region, 12, 9, rng)
    exhaustive = pruned._replace(memory=None)
    others = 0
    while not exhaustive.finished:
        number = exhaustive.n_placed + 1
        choice = exhaustive.copy()._replace(memory=pruned.memory)
        advance_to(choice, number)
        advance_to(exhaustive, number)
        discs = [state.placed.disc[: state.n_placed] for state in (choice, exhaustive)]
        others += not np.array_equal(*discs)
    assert exhaustive.n_placed > 100
    assert others <= MOST_OTHERS[family] * exhaustive.n_placed


@pytest.mark.compiled
@pytest.mark.parametrize("width", [1.7, 2.0, 3.0])
def test_a_shaft_is_filled_to_its_top(width):
    """One grain wide: it is never left by a front whose lowest places are taken."""
    packing = pack("rectangles", Region.of(box(0, 0, width, 60)), 24, 20)
    assert packing.area.sum() > 0.5 * packing.domain.area
    assert np.diff(np.sort(packing.y)).max() < 2.0


@pytest.mark.compiled
@pytest.mark.parametrize("effort", [(1, 1), (4, 3), (24, 20)])
@pytest.mark.parametrize(("width", "height"), [(150.0, 1.2), (1.2, 150.0)])
def test_a_domain_as_narrow_as_a_grain_is_filled(width, height, effort):
    """Most orientations that the law asks for do not fit: the others are taken."""
    packing = pack("hulls", Rectangle(0.0, 0.0, width, height), *effort)
    assert packing.area.sum() > 0.5 * packing.domain.area


@pytest.mark.compiled
@pytest.mark.parametrize("effort", [(1, 1), (4, 3), (12, 10)])
def test_rooms_behind_thin_walls_are_filled(effort):
    """Particles on the other side of a wall are near, but not in the way."""
    disc, inner = (Point(10, 10).buffer(radius, quad_segs=12) for radius in (6.0, 5.9))
    outside = box(0, 0, 20, 20).difference(disc)
    packing = pack("hulls", Region.of(outside.union(inner)), *effort)
    shapes = packing.polygons.to_shapely()
    for room in (inner, outside):
        assert shapely.area(shapely.intersection(shapes, room)).sum() > 0.6 * room.area


@pytest.mark.compiled
@pytest.mark.parametrize("neck", [0.3, 0.8, 1.0])
def test_shafts_joined_by_necks_about_as_wide_as_particles_are_filled(neck):
    """Whether a front gets through a neck is up to chance."""
    shafts = [box(3.1 * n, 0, 3.1 * n + 3, 15) for n in range(5)]
    necks = [
        box(3.1 * n - 0.2, y, 3.1 * n, y + neck) for n, y in ((1, 0), (2, 14), (3, 0), (4, 14))
    ]
    packing = pack("rectangles", Region.of(shapely.union_all(shafts + necks)), 4, 3, smallest=0.7)
    shapes = packing.polygons.to_shapely()
    for shaft in shafts:
        assert shapely.area(shapely.intersection(shapes, shaft)).sum() > 0.5 * shaft.area


@pytest.mark.compiled
@pytest.mark.parametrize("effort", [(1, 1), (4, 3), (12, 10)])
@pytest.mark.parametrize(("width", "smallest"), [(1.3, 0.8), (0.85, 0.7)])
def test_a_slanted_shaft_as_narrow_as_its_particles_is_filled(width, smallest, effort):
    """Its bounding rectangle does not tell which particles are too wide for it."""
    shaft = Region.of(affinity.rotate(box(0, 0, width, 80), 30))
    packing = pack("hulls", shaft, *effort, smallest=smallest)
    assert packing.area.sum() > 0.5 * shaft.area


coordinates = st.tuples(st.integers(0, 12), st.integers(0, 12))


@pytest.mark.compiled
@settings(max_examples=40, deadline=None)
@given(
    st.lists(coordinates, min_size=3, max_size=9, unique=True),
    st.lists(coordinates, min_size=3, max_size=4, unique=True),
    st.sampled_from(sorted(FAMILIES)),
    st.sampled_from([(1, 1), (4, 3), (3, 8)]),
    st.sampled_from([0.0, 1e3, -1e6]),
    st.integers(0, 2**32 - 1),
)
def test_every_particle_is_inside_exactly(outer, hole, family, effort, shift, seed):
    shape = Polygon(outer).buffer(0)
    shape = shape.difference(Polygon(hole).buffer(0).buffer(-0.3, quad_segs=2))
    shape = shapely.transform(shape, lambda nodes: nodes + [shift, -shift])
    if shape.is_empty or shape.geom_type not in ("Polygon", "MultiPolygon"):
        return
    packing = pack(family, Region.of(shape), *effort, seed)
    if packing.x.size:
        certificate = certify(packing)
        assert (certificate.overlaps, certificate.across_wall) == (0, 0)
        outside = shapely.difference(packing.polygons.to_shapely(), packing.domain.to_shapely())
        assert shapely.area(outside).max() <= 1e-9 * max(1.0, abs(shift))


@pytest.mark.compiled
@pytest.mark.parametrize("name", DOMAINS)
def test_no_part_of_a_domain_stays_empty(name):
    """Nowhere in the domain is there room for a circle of two particles across."""
    region = Region.of(DOMAINS[name](14.0))
    packing = pack("rectangles", region, 2, 2)
    assert find_rooms(packing).empty_area == 0.0
    void = region.to_shapely().difference(shapely.union_all(packing.polygons.to_shapely()))
    assert void.buffer(-1.1).is_empty


@pytest.mark.compiled
def test_both_legs_below_a_beam_are_filled():
    """A front that begins in one leg reaches the other from above."""
    legs = box(0, 6, 12, 12).union(box(0, 0, 3, 6)).union(box(9, 1, 12, 6))
    packing = pack("hulls", Region.of(legs), 3, 8)
    shapes = packing.polygons.to_shapely()
    for leg in (box(0, 0, 3, 6), box(9, 1, 12, 6)):
        assert shapely.area(shapely.intersection(shapes, leg)).sum() > 0.6 * leg.area


@pytest.mark.compiled
@pytest.mark.parametrize("effort", [(1, 1), (12, 10)])
@pytest.mark.parametrize("name", [name for name in DOMAINS if name != "two islands"])
def test_the_bulk_is_as_dense_as_that_of_a_rectangle(name, effort):
    """0.02 is three standard deviations of a thousand particles; larger ones come within 0.01."""
    rectangle = pack("hulls", Rectangle(0.0, 0.0, 40.0, 40.0), *effort)
    packing = pack("hulls", Region.of(DOMAINS[name](40.0)), *effort)
    bulk = volume_fraction_bulk(packing)
    assert bulk == pytest.approx(volume_fraction_bulk(rectangle), abs=0.02)


@pytest.mark.compiled
@pytest.mark.parametrize("effort", [(1, 1), (12, 10)])
def test_a_rectangle_given_as_polygon_is_filled_as_the_rectangle(effort):
    fractions, contacts = [], []
    for domain in (Rectangle(0.0, 0.0, 30.0, 30.0), Region.of(box(0, 0, 30, 30))):
        packing = pack("hulls", domain, *effort)
        fractions.append(packing.area.sum() / domain.area)
        contacts.append(len(np.unique(find_contacts(packing).wall_particle)))
    assert fractions[1] == pytest.approx(fractions[0], abs=0.01)
    assert contacts[1] == pytest.approx(contacts[0], rel=0.15)


@pytest.mark.compiled
def test_inclusions_are_packed_around():
    """A star, whose notches are filled too, and a square beside it."""
    angle = np.arange(10) * np.pi / 5
    radius = np.where(np.arange(10) % 2, 1.5, 4.0)
    star = Polygon(6 + np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]))
    inclusions = [star, box(0.5, 0.5, 2, 2)]
    region = Region.of(box(0, 0, 12, 12)).without(inclusions)
    packing = pack("hulls", region, 3, 3)
    assert certify(packing).holds
    shapes = packing.polygons.to_shapely()
    assert not shapely.intersects(shapely.union_all(inclusions).buffer(-1e-9), shapes).any()
    assert set(find_contacts(packing).wall.tolist()) == {0, 1, 2}
    assert packing.area.sum() > 0.7 * region.area


def test_a_target_is_refused():
    hulls, shape, size, law, rng = particles("hulls", 100.0, 0.5, 0)
    state = prepare(hulls, shape, size, [law], Region.of(l_shape(10.0)), 2, 2, rng)
    with pytest.raises(InputError, match="rectangles only"):
        Steering(state, np.ones(hulls.count), rng)


def test_a_domain_narrower_than_its_particles_stays_empty():
    assert pack("rectangles", Region.of(box(0, 0, 9, 0.4)), 1, 1).x.size == 0


@pytest.mark.parametrize("name", DOMAINS)
def test_the_pieces_outside_are_convex_and_make_up_the_outside(name):
    region = Region.of(DOMAINS[name](14.0))
    pieces = outside_pieces(region)
    shapes = pieces.to_shapely()
    known = {tuple(node) for node in region.rings.nodes.tolist()}
    border = shapely.total_bounds(shapes)
    for node in map(tuple, pieces.nodes.tolist()):
        assert node in known or {node[0], node[1]} <= set(border.tolist())
    np.testing.assert_allclose(shapely.area(shapes), shapely.area(shapely.convex_hull(shapes)))
    around = box(*border)
    assert shapely.area(shapes).sum() == pytest.approx(around.area - region.area)
    assert shapely.union_all(shapes).symmetric_difference(
        around.difference(region.to_shapely())
    ).area == pytest.approx(0.0, abs=1e-9)
