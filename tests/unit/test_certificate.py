"""The certificate against rational arithmetic and against shapely."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront.certificate import certify
from grainfront.errors import InputError
from grainfront.geometry.exact import is_convex, is_simple, orientation
from grainfront.geometry.outlines import interiors_meet, lies_inside
from grainfront.particles import Rectangle, Region

UNIT_SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
ULP = 2.0**-52
EXAMPLES = settings(max_examples=50, deadline=None)


def rational(polygon):
    return [(Fraction(x), Fraction(y)) for x, y in np.asarray(polygon).tolist()]


def cross(p, q, r):
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def rational_area(points):
    return (
        sum(cross((0, 0), p, q) for p, q in zip(points, points[1:] + points[:1], strict=True)) / 2
    )


def rational_clip(a, b):
    """Intersection of two convex polygons by Sutherland and Hodgman, in fractions."""
    clipped = rational(a)
    corners = rational(b)
    for p, q in zip(corners, corners[1:] + corners[:1], strict=True):
        kept = []
        for s, t in zip(clipped, clipped[1:] + clipped[:1], strict=True):
            side_s, side_t = cross(p, q, s), cross(p, q, t)
            if side_s >= 0:
                kept.append(s)
            if side_s * side_t < 0:
                u = side_s / (side_s - side_t)
                kept.append((s[0] + u * (t[0] - s[0]), s[1] + u * (t[1] - s[1])))
        clipped = kept
    return clipped


def rational_hull(points):
    """Convex hull in fractions, as floats, counter-clockwise."""
    points = sorted(set(rational(points)))
    hull = []
    for chain in (points, points[::-1]):
        start = len(hull)
        for r in chain:
            while len(hull) >= start + 2 and cross(hull[-2], hull[-1], r) <= 0:
                hull.pop()
            hull.append(r)
        hull.pop()
    return np.array([[float(x), float(y)] for x, y in hull])


def edges_from_left(polygon):
    return np.argsort(np.minimum(polygon[:, 0], np.roll(polygon[:, 0], 1)))


def simple(polygon):
    return bool(is_simple(polygon, edges_from_left(polygon)))


# Coordinates a few units in the last place beside small integers meet every degenerate case.
near_integers = st.tuples(st.integers(1, 4), st.integers(-2, 2)).map(
    lambda c: c[0] + c[1] * ULP * 2
)
near_lattice = st.lists(st.tuples(near_integers, near_integers), min_size=3, max_size=7)
lattice = st.lists(
    st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=3, max_size=8, unique=True
)


@EXAMPLES
@given(near_lattice, near_lattice)
def test_hulls_are_decided_as_rational_arithmetic_does(packing_of, first, second):
    a, b = rational_hull(first), rational_hull(second)
    if len(a) < 3 or len(b) < 3:
        return
    found = certify(packing_of([a, b])).overlaps
    assert found == (rational_area(rational_clip(a, b)) > 0)


@EXAMPLES
@given(st.floats(0.0, 6.3), st.floats(1e-6, 1e6), st.floats(-1e6, 1e6), st.integers(-3, 3))
def test_one_unit_in_the_last_place_decides(packing_of, angle, scale, shift, ulps):
    """A node beside the middle of a slanted edge, moved by single units in the last place."""
    along = scale * np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    start = np.array([shift, -shift])
    below = np.array([start, start + along, start + 0.5 * along + across])
    tip = 0.5 * (below[0] + below[1])
    tip += ulps * np.spacing(np.abs(tip)) * np.sign(across)
    above = np.array([tip, tip - across - along, tip - across + along])
    if rational_area(rational(below)) <= 0 or rational_area(rational(above)) <= 0:
        return
    expected = rational_area(rational_clip(below, above)) > 0
    assert certify(packing_of([below, above])).overlaps == expected


@pytest.mark.parametrize("exponent", [0, -500, -528, -534])
def test_orientation_is_exact(exponent):
    """Points of one line and their nearest neighbours, where rounded determinants mislead.

    Kettner et al. (2008), doi 10.1016/j.comgeo.2007.06.003; scaled down into underflow.
    """
    scale = 2.0**exponent
    for a, b in (((12.0, 12.0), (24.0, 24.0)), ((17.3, 17.3), (24.1, 24.1))):
        a, b = (scale * a[0], scale * a[1]), (scale * b[0], scale * b[1])
        for i, j in np.ndindex(24, 24):
            c = scale * (0.5 + i * 2.0**-53), scale * (0.5 + j * 2.0**-53)
            determinant = cross(*(tuple(map(Fraction, p)) for p in (a, b, c)))
            assert orientation(*a, *b, *c) == (determinant > 0) - (determinant < 0)


def test_touching_is_no_overlap_and_one_ulp_is(packing_of):
    beside = UNIT_SQUARE + np.array([1.0, 0.0])
    assert certify(packing_of([UNIT_SQUARE, beside])).overlaps == 0
    inside = beside.copy()
    inside[[0, 3], 0] = np.nextafter(1.0, 0.0)
    certificate = certify(packing_of([UNIT_SQUARE, inside]))
    assert certificate.overlapping_pairs.tolist() == [[0, 1]]
    assert not certificate.holds


@pytest.mark.filterwarnings("ignore::RuntimeWarning:shapely")  # areas overflow; they are no part
@pytest.mark.parametrize("exponent", [-600, -500, -30, 0, 30, 500, 600])
def test_scale_free_beyond_underflow_and_overflow(packing_of, exponent):
    """At 2**±600 the products of the filter leave the range of float64."""
    slanted = np.array([[0.0, 0.0], [3.0, 1.0], [0.5, 2.0]])
    tip = np.array([[1.5, 0.5], [0.0, -2.0], [4.0, -2.0]])
    overlapping = tip + np.array([0.0, 2.0**-50])
    scale = 2.0**exponent
    assert certify(packing_of([scale * slanted, scale * tip])).overlaps == 0
    assert certify(packing_of([scale * slanted, scale * overlapping])).overlaps == 1


def test_lattice_of_touching_hexagons(packing_of):
    """Rounded hexagons penetrate or not by units in the last place: the fractions decide."""
    angle = np.pi / 6 + np.arange(6) * np.pi / 3
    hexagon = np.column_stack([np.cos(angle), np.sin(angle)])
    centres = [(np.sqrt(3) * (i + 0.5 * (j % 2)), 1.5 * j) for i in range(6) for j in range(6)]
    packing = packing_of([hexagon + centre for centre in centres])
    certificate = certify(packing)
    expected = [
        [i, j]
        for i in range(36)
        for j in range(i + 1, 36)
        if rational_area(
            rational_clip(packing.polygons.polygon(i), packing.polygons.polygon(j)) or [(0, 0)]
        )
        > 0
    ]
    assert certificate.overlapping_pairs.tolist() == expected
    assert 0 < certificate.pairs_exact <= certificate.pairs_tested


def test_walls_are_exact(packing_of):
    domain = Rectangle(0.0, 0.0, 1.0, 1.0)
    assert certify(packing_of([UNIT_SQUARE], domain)).holds
    for corner, value in (((1, 0), np.nextafter(1.0, 2.0)), ((0, 1), -5e-324)):
        crossing = UNIT_SQUARE.copy()
        crossing[corner] = value
        certificate = certify(packing_of([0.5 * UNIT_SQUARE + 0.25, crossing], domain))
        assert certificate.particles_across_wall.tolist() == [1]


FRAME = shapely.box(0, 0, 9, 9).difference(shapely.Polygon([(3, 3), (6, 3.5), (6, 6), (4, 6)]))


def test_the_boundary_of_a_region_is_exact(packing_of):
    """A slanted wall of the hole, a node on it, and the same one unit further."""
    along = np.array([[1.0, 1.0], [6.0, 1.0], [6.0, 3.5], [3.0, 3.0]])
    assert certify(packing_of([along], Region.of(FRAME))).holds
    for node, value in ((2, np.nextafter(3.5, 4.0)), (3, np.nextafter(3.0, 4.0))):
        crossing = along.copy()
        crossing[node, 1] = value
        certificate = certify(packing_of([along * 0.5, crossing], Region.of(FRAME)))
        assert certificate.particles_across_wall.tolist() == [1]


def test_whoever_is_all_in_a_hole_or_between_parts_is_outside(packing_of):
    in_hole = 0.1 * UNIT_SQUARE + 5.0
    assert certify(packing_of([in_hole], Region.of(FRAME))).across_wall == 1
    parts = shapely.MultiPolygon([shapely.box(0, 0, 2, 2), shapely.box(4, 0, 6, 2)])
    squares = [UNIT_SQUARE + [x, 0.5] for x in (0.5, 2.5, 4.5, 1.5)]
    certificate = certify(packing_of(squares, Region.of(parts)))
    assert certificate.particles_across_wall.tolist() == [1, 3]


def test_an_outline_may_reach_round_a_corner_of_its_region(packing_of):
    """Its hull crosses the boundary, the outline does not."""
    ell = np.array([[0, 0], [9, 0], [9, 3], [3, 3], [3, 9], [0, 9]], dtype=float)
    region = Region.of(shapely.Polygon(ell))
    assert certify(packing_of([ell], region)).holds
    inner = ell.copy()
    inner[3] = np.nextafter(3.0, 4.0)
    assert certify(packing_of([inner], region)).across_wall == 1


@EXAMPLES
@given(lattice, lattice)
def test_inside_a_region_is_decided_as_overlay_does(packing_of, first, second):
    """On a small lattice the area of what sticks out is far above rounding."""
    polygon, ring = np.array(first, dtype=float), np.array(second, dtype=float)
    if not (simple(polygon) and simple(ring)):
        return
    region = Region.of(shapely.Polygon(ring))
    outside = shapely.difference(shapely.Polygon(polygon), region.to_shapely()).area > 1e-9
    assert certify(packing_of([polygon], region)).holds == (not outside)
    edges = np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)
    assert lies_inside(polygon, edges) == (not outside)


@EXAMPLES
@given(lattice, lattice)
def test_outlines_are_decided_as_overlay_does(packing_of, first, second):
    """On a small lattice the area of an overlap is far above rounding."""
    a, b = np.array(first, dtype=float), np.array(second, dtype=float)
    if not (simple(a) and simple(b)):
        return
    expected = shapely.intersection(shapely.Polygon(a), shapely.Polygon(b)).area > 1e-9
    assert interiors_meet(a, b) == expected
    assert certify(packing_of([a, b])).overlaps == expected


def test_interlocking_outlines_are_disjoint_until_they_move(packing_of):
    notch = np.array([[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]], dtype=float)
    tooth = np.array([[1, 1], [2, 1], [2, 4], [1, 4]], dtype=float)
    assert certify(packing_of([notch, tooth])).holds
    moved = tooth - [ULP, 0.0]
    assert certify(packing_of([notch, moved])).overlaps == 1
    assert certify(packing_of([notch, notch])).overlaps == 1
    leg = np.array([[0, 0], [1, 0], [1, 3], [0.5, 2], [0, 3]], dtype=float)
    assert interiors_meet(notch, leg)
    within = 0.5 * leg + np.array([0.25, 0.5])
    assert interiors_meet(notch, within)
    assert interiors_meet(within, notch)


@EXAMPLES
@given(lattice)
def test_simplicity_and_convexity_are_those_of_shapely(points):
    polygon = np.array(points, dtype=float)
    shape = shapely.Polygon(polygon)
    counter_clockwise = shapely.is_valid(shape) and shapely.is_ccw(shape.exterior)
    assert simple(polygon) == counter_clockwise
    convex = counter_clockwise and shape.area == shapely.convex_hull(shape).area
    assert bool(is_convex(polygon)) == convex


def test_a_polygon_that_winds_twice_is_not_convex():
    """A pentagram turns left at every node."""
    angle = 4 * np.pi / 5 * np.arange(5)
    pentagram = np.column_stack([np.cos(angle), np.sin(angle)])
    assert is_convex(pentagram[[0, 3, 1, 4, 2]])
    assert not is_convex(pentagram)
    assert not simple(pentagram)


def test_many_random_particles(packing_of):
    """Candidate pairs are complete: shapely's overlay over all pairs finds the same overlaps."""
    rng = np.random.default_rng(7)
    angle = np.sort(rng.uniform(0, 2 * np.pi, (150, 12)), axis=1)
    radius = rng.uniform(0.2, 1.0, (150, 1))
    centre = rng.uniform(0, 12, (150, 1, 2))
    parts = centre + np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=2)
    packing = packing_of(parts)
    shapes = packing.polygons.to_shapely()
    i, j = np.triu_indices(150, 1)
    overlap = shapely.area(shapely.intersection(shapes[i], shapes[j])) > 1e-12
    found = certify(packing)
    assert found.overlapping_pairs.tolist() == np.column_stack([i, j])[overlap].tolist()


@pytest.mark.parametrize(
    ("polygon", "fault"),
    [
        (UNIT_SQUARE[:2], "has 2 nodes"),
        (UNIT_SQUARE * [1.0, np.nan], "not finite"),
        (UNIT_SQUARE[::-1], "counter-clockwise"),
        (UNIT_SQUARE[[0, 2, 1, 3]], "not simple"),
        (UNIT_SQUARE[[0, 1, 1, 2, 3]], "not simple"),
    ],
)
def test_what_is_no_polygon_is_refused(packing_of, polygon, fault):
    domain = Rectangle(0.0, 0.0, 9.0, 9.0)
    with pytest.raises(InputError, match=f"article 1 .*{fault}"):
        certify(packing_of([UNIT_SQUARE, polygon], domain))
