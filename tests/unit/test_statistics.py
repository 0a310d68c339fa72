"""Statistics on packings whose answer is known, and against shapely."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Voronoi

from grainfront.errors import InputError
from grainfront.particles import Cell, Rectangle, Region
from grainfront.statistics import (
    CONTACT_TOLERANCE,
    N_BIN,
    compare_with_law,
    find_contacts,
    find_rooms,
    l2_error,
    measure,
    orientation_rose,
    size_correlation,
    void_ratio,
    volume_fraction,
    volume_fraction_between,
    volume_fraction_bulk,
)

UNIT_SQUARE = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])


def shifted(polygon, x, y):
    return polygon + np.array([x, y])


def square_lattice(columns, rows, side=1.0):
    return [shifted(side * UNIT_SQUARE, i, j) for j in range(rows) for i in range(columns)]


def voronoi_cells(count, rng):
    """Voronoi cells that fill the unit square, their seeds, and Voronoi's own ridges."""
    seeds = rng.random((count, 2))
    mirrored = [
        seeds,
        seeds * [-1, 1],
        [2, 0] - seeds * [1, -1],
        seeds * [1, -1],
        [0, 2] - seeds * [-1, 1],
    ]
    diagram = Voronoi(np.vstack(mirrored))
    cells = [diagram.vertices[diagram.regions[diagram.point_region[i]]] for i in range(count)]
    cells = [c if shapely.LinearRing(c).is_ccw else c[::-1] for c in cells]
    own = np.flatnonzero((diagram.ridge_points < count).all(axis=1))
    pairs = np.sort(diagram.ridge_points[own], axis=1)
    ends = diagram.vertices[[diagram.ridge_vertices[k] for k in own]]
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    return cells, seeds, pairs[order], ends[order]


def test_fractions_of_a_full_and_a_sparse_lattice(packing_of):
    full = packing_of(square_lattice(10, 8))
    assert volume_fraction(full) == pytest.approx(1.0, abs=1e-14)
    assert volume_fraction_bulk(full) == pytest.approx(1.0, abs=1e-14)
    assert void_ratio(volume_fraction(full)) == pytest.approx(0.0, abs=1e-14)
    sparse = packing_of(square_lattice(10, 8, 0.5), Rectangle(-0.5, -0.5, 9.5, 7.5))
    assert volume_fraction(sparse) == pytest.approx(0.25)
    assert void_ratio(volume_fraction(sparse)) == pytest.approx(3.0)


@given(axis=st.sampled_from([0, 1]), low=st.floats(-0.2, 0.5), width=st.floats(0.01, 0.6))
@settings(max_examples=30, deadline=None)
def test_the_fraction_between_two_lines_is_that_of_the_clipped_polygons(
    packing_of, axis, low, width
):
    cells = voronoi_cells(60, np.random.default_rng(4))[0]
    packing = packing_of(cells, Rectangle(0.0, 0.0, 1.0, 1.0))
    high = low + width
    box = shapely.box(low, 0.0, high, 1.0) if axis == 0 else shapely.box(0.0, low, 1.0, high)
    clipped = shapely.area(shapely.intersection(packing.polygons.to_shapely(), box)).sum()
    found = volume_fraction_between(packing, axis, low, high)
    assert found == pytest.approx(clipped / box.area, rel=1e-11, abs=1e-14)


def test_upright_edges_on_the_lines_count_too(packing_of):
    square = 2.0 * UNIT_SQUARE
    packing = packing_of([shifted(square, 1, 1), shifted(square, 5, 1)], Rectangle(0, 0, 6, 2))
    for axis, low, high, expected in ((0, 2, 4, 0), (0, 1, 5, 0.5), (1, 0.5, 1.5, 2 / 3)):
        assert volume_fraction_between(packing, axis, low, high) == pytest.approx(expected)


def test_bulk_clips_particles_exactly(packing_of):
    rng = np.random.default_rng(3)
    cells, *_ = voronoi_cells(200, rng)
    cells = [c.mean(axis=0) + 0.8 * (c - c.mean(axis=0)) for c in cells]
    packing = packing_of(cells, Rectangle(0.0, 0.0, 1.0, 1.0))
    margin = 2 * np.sqrt(packing.area.mean())
    inner = shapely.box(margin, margin, 1 - margin, 1 - margin)
    expected = shapely.union_all(packing.polygons.to_shapely()).intersection(inner).area
    assert volume_fraction_bulk(packing) == pytest.approx(expected / inner.area, rel=1e-12)


def test_no_bulk_in_a_domain_of_few_particles(packing_of):
    assert np.isnan(volume_fraction_bulk(packing_of(square_lattice(4, 9))))


def test_l2_error_by_hand():
    """Shares 1/2, 1/4 in the bins and 1/4 outside, where 1/2 and 1/2 are prescribed."""
    error, noise = l2_error(
        np.array([0.0, 0.5, 1.5, 7.0]), np.array([0.0, 1.0, 2.0]), np.full(2, 0.5)
    )
    assert error == pytest.approx(0.25)
    assert noise == pytest.approx(np.sqrt(0.5 / 4))


def test_noise_level_is_the_error_of_independent_sampling():
    rng = np.random.default_rng(1)
    edges = np.linspace(0.0, 1.0, 25)
    probabilities = np.diff(edges**2)
    draws = np.sqrt(rng.random((400, 500)))
    errors = np.array([l2_error(values, edges, probabilities) for values in draws])
    assert np.sqrt(np.mean(errors[:, 0] ** 2)) == pytest.approx(errors[0, 1], rel=0.03)


@pytest.mark.parametrize("value", [0.0, 1.5, -3e9, 1e-9])
def test_constant_law(value):
    edges, probabilities = np.array([value, value]), np.ones(1)
    rounded = value * (1 + np.array([0.0, 1e-15, -1e-15]))
    assert l2_error(rounded, edges, probabilities) == (0.0, 0.0)
    rounded[2] += 1.0 + abs(value)
    assert l2_error(rounded, edges, probabilities)[0] == pytest.approx(1 / 3)


def test_rose_spreads_the_law_modulo_180():
    edges, probabilities = np.linspace(-30.0, 30.0, 9), np.full(8, 1 / 8)
    rose = orientation_rose(np.array([0.0, 7.4, 7.5, 179.9, 180.0, -1.0]), edges, probabilities)
    assert (rose.shares * 6).round(12).tolist() == [3, 1] + [0] * 21 + [2]
    expected = np.zeros(N_BIN)
    expected[[0, 1, 2, 3, -4, -3, -2, -1]] = 1 / 8
    assert rose.probabilities == pytest.approx(expected, abs=1e-14)
    for value, place in ((0.0, 0), (180.0, 0), (7.5, 1), (-1.0, 23)):
        constant = orientation_rose(np.zeros(1), np.full(2, value), np.ones(1))
        assert constant.probabilities.tolist() == np.eye(N_BIN)[place].tolist()


def posed(points, angle, scale, shift):
    c, s = np.cos(angle), np.sin(angle)
    return scale * (np.asarray(points, dtype=float) @ np.array([[c, s], [-s, c]]) + shift)


RIGHT_TRIANGLE = np.array([[0.0, 0.0], [1.0, -1.0], [1.0, 1.0]])
CONTACTS = {
    # A square of side 1 round the origin, and what touches it: other polygon, position, normal.
    "shared segment": (shifted(UNIT_SQUARE, 1.0, 0.6), (0.5, 0.3), (1, 0)),
    "whole edges": (shifted(UNIT_SQUARE, 1.0, 0.0), (0.5, 0.0), (1, 0)),
    "long edge": (shifted(2 * UNIT_SQUARE, 0.1, 1.5), (0.0, 0.5), (0, 1)),
    "node on edge": (shifted(RIGHT_TRIANGLE, 0.5, 0.2), (0.5, 0.2), (1, 0)),
    "edge on node": (np.array([[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), (0.5, 0.5), (1, 1)),
    "corner to corner": (shifted(UNIT_SQUARE, 1.0, 1.0), (0.5, 0.5), (1, 1)),
    "gap": (shifted(UNIT_SQUARE, 1.0 + 0.5 * CONTACT_TOLERANCE, 0.0), (0.5, 0.0), (1, 0)),
    "penetration": (shifted(UNIT_SQUARE, 1.0 - 1e-14, 0.0), (0.5, 0.0), (1, 0)),
}


@pytest.mark.parametrize("case", CONTACTS)
@pytest.mark.parametrize("swapped", [False, True])
@settings(max_examples=20, deadline=None)
@given(
    angle=st.floats(0.0, 6.3),
    scale=st.sampled_from([1e-9, 1.0, 1e9]),
    shift=st.tuples(st.floats(-100, 100), st.floats(-100, 100)),
)
def test_position_and_normal_of_a_contact(packing_of, case, swapped, angle, scale, shift):
    other, position, normal = CONTACTS[case]
    parts = [posed(p, angle, scale, shift) for p in (UNIT_SQUARE, other)]
    packing = packing_of(parts[::-1] if swapped else parts, size=np.full(2, scale))
    contacts = find_contacts(packing)
    assert contacts.pairs.tolist() == [[0, 1]]
    expected = posed([position], angle, scale, shift)
    assert np.abs(contacts.position - expected).max() <= CONTACT_TOLERANCE * scale
    direction = posed([normal], angle, 1.0, (0.0, 0.0)) / np.hypot(*normal)
    assert contacts.normal == pytest.approx(-direction if swapped else direction, abs=1e-5)


def test_neighbours_beyond_the_tolerance_do_not_touch(packing_of):
    gap = 1.01 * CONTACT_TOLERANCE
    assert (
        find_contacts(packing_of([UNIT_SQUARE, shifted(UNIT_SQUARE, 1.0 + gap, 0.0)])).pairs.size
        == 0
    )


def test_contacts_of_voronoi_cells(packing_of):
    """Cells touch along Voronoi's ridges, whose normals join the seeds."""
    cells, seeds, pairs, ends = voronoi_cells(150, np.random.default_rng(5))
    size = np.full(150, np.sqrt(1 / 150))
    packing = packing_of(cells, Rectangle(0.0, 0.0, 1.0, 1.0), size=size)
    contacts = find_contacts(packing)
    assert contacts.pairs.tolist() == pairs.tolist()
    assert contacts.position == pytest.approx(ends.mean(axis=1), abs=1e-9)
    normal = seeds[pairs[:, 1]] - seeds[pairs[:, 0]]
    normal /= np.hypot(*normal.T)[:, None]
    assert contacts.normal == pytest.approx(normal, abs=1e-6)


def test_contacts_are_shapelys_pairs_within_the_tolerance(packing_of):
    """Nonconvex stars, some moved so that a node just touches its neighbour."""
    rng = np.random.default_rng(2)
    angle = np.arange(12) * np.pi / 6
    radius = np.where(np.arange(12) % 2, 0.3, 0.5)
    star = np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
    gaps = rng.choice([0.0, 0.5, 0.9, 1.1, 3.0, 1e5], 40) * CONTACT_TOLERANCE
    packing = packing_of([shifted(star, x, 0.0) for x in np.cumsum(1.0 + gaps)])
    shapes = packing.polygons.to_shapely()
    i, j = np.triu_indices(40, 1)
    near = shapely.dwithin(shapes[i], shapes[j], CONTACT_TOLERANCE)
    assert 10 < near.sum() < 30
    assert find_contacts(packing).pairs.tolist() == np.column_stack([i, j])[near].tolist()


def test_everything_about_a_square_lattice(packing_of):
    n = 12
    size = 1.0 + 0.01 * (np.arange(n * n) % n)
    just_below_180 = np.full(n * n, 180.0 - 1e-12)
    packing = packing_of(square_lattice(n, n), size=size, orientation=just_below_180)
    laws = {
        "size": ("size", np.array([1.0, 1.055, 1.11]), np.array([0.5, 0.5])),
        "aspect_ratio": (packing.aspect_ratio, np.ones(2), np.ones(1)),
        "orientation": ("orientation", np.array([-5.0, 5.0]), np.ones(1)),
    }
    statistics = measure(packing, laws)
    edges, corners = 2 * n * (n - 1), 2 * (n - 1) ** 2
    assert statistics.particles == n * n
    assert statistics.contact_pairs == edges + corners
    assert statistics.coordination_number == 2 * (edges + corners) / n**2
    assert statistics.wall_contacts == 4 * n
    assert np.bincount(statistics.contacts.wall).tolist() == [n] * 4
    shares = np.zeros(9)
    shares[[3, 5, 8]] = np.array([4, 4 * (n - 2), (n - 2) ** 2]) / n**2
    assert statistics.contact_shares == pytest.approx(shares)
    assert statistics.contacts_per_particle.sum() == 2 * statistics.contact_pairs
    assert [d.l2_error for d in statistics.distributions.values()] == [0.0, 0.0, 0.0]
    assert statistics.orientation_rose.probabilities[[0, -1]].tolist() == [0.5, 0.5]
    assert statistics.volume_fraction_bulk == pytest.approx(1.0)
    correlation = statistics.size_correlation
    assert correlation.x == pytest.approx(1.0)
    assert (correlation.y, correlation.centre) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert correlation.noise_level == 1 / n


def test_equal_sizes_cannot_segregate(packing_of):
    correlation = size_correlation(packing_of(square_lattice(5, 5)))
    assert (correlation.x, correlation.y, correlation.centre) == (0.0, 0.0, 0.0)


def test_an_empty_packing_is_refused(packing_of):
    packing = packing_of([UNIT_SQUARE], x=np.empty(0))
    with pytest.raises(InputError, match="without particles"):
        measure(packing, {})


def test_shares_are_of_all_values():
    compared = compare_with_law(np.array([0.1, 0.2, 5.0]), np.array([0.0, 1.0]), np.ones(1))
    assert compared.shares.tolist() == [2 / 3]


def test_fractions_of_a_region_are_those_of_its_area(packing_of):
    """A lattice of small squares fills a ring by a quarter, wherever the bulk is cut."""
    hole = shapely.box(30, 30, 50, 50)
    region = Region.of(shapely.box(0, 0, 80, 80).difference(hole))
    squares = [
        shifted(0.5 * UNIT_SQUARE, i + 0.5, j + 0.5)
        for i in range(80)
        for j in range(80)
        if not hole.covers(shapely.Point(i + 0.5, j + 0.5))
    ]
    packing = packing_of(squares, region)
    assert region.area == 6000.0
    assert volume_fraction(packing) == pytest.approx(0.25)
    assert volume_fraction_bulk(packing) == pytest.approx(0.25, rel=0.01)


def test_slices_of_a_region_and_of_a_cell(packing_of):
    """Between lines, particles and domain count with what lies there; cells begin again."""
    ring = shapely.box(0, 0, 6, 6).difference(shapely.box(2, 2, 4, 4))
    packing = packing_of([shifted(UNIT_SQUARE, 1, 3)], Region.of(ring))
    assert volume_fraction_between(packing, 0, 1.0, 3.0) == pytest.approx(0.5 / 10)
    assert volume_fraction_between(packing, 1, 2.5, 3.5) == pytest.approx(1.0 / 4)
    for along_y in (False, True):
        packing = packing_of(
            [shifted(UNIT_SQUARE, 0, 4)], Cell(0.0, 0.0, 6.0, 4.25, along_y), y=np.array([4.0])
        )
        assert volume_fraction_between(packing, 0, 5.0, 6.0) == pytest.approx(0.5 / 4.25)
        assert volume_fraction_between(packing, 0, 0.0, 1.0) == pytest.approx(0.5 / 4.25)
        above = 0.25 / 6 if along_y else 0.0
        assert volume_fraction_between(packing, 1, 0.0, 1.0) == pytest.approx(above)


def test_contacts_with_the_rings_of_a_region(packing_of):
    """Squares touch the outer ring, the ring of the hole, both or neither."""
    frame = shapely.box(0, 0, 9, 9).difference(shapely.box(1, 3, 6, 6))
    squares = [
        shifted(UNIT_SQUARE, *centre) for centre in ((0.5, 4.5), (6.5, 4.5), (4, 0.5), (8, 8))
    ]
    contacts = find_contacts(packing_of(squares, Region.of(frame)))
    found = list(zip(contacts.wall_particle.tolist(), contacts.wall.tolist(), strict=True))
    assert found == [(0, 0), (0, 1), (1, 1), (2, 0)]


def test_a_room_without_particles_is_told(packing_of):
    """Two rooms joined by a corridor that is narrower than the particle, which is in one."""
    rooms = [shapely.box(0, 0, 4, 4), shapely.box(10, 0, 13, 4), shapely.box(4, 1, 10, 1.5)]
    packing = packing_of([shifted(UNIT_SQUARE, 2, 2)], Region.of(shapely.union_all(rooms)))
    found = find_rooms(packing)
    corners = 8 * (0.25 - np.pi / 16)  # of the rooms, where a disc of radius 1/2 does not fit
    assert found.area.sum() == pytest.approx(28 - corners, rel=0.005)
    assert found.empty_area == pytest.approx(12 - corners / 2, rel=0.005)
