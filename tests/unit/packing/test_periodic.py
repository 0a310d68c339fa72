"""Periodic cells: their tiles are disjoint, contacts count across the period, little is lost."""

from __future__ import annotations

import numpy as np
import pytest

from grainfront.certificate import certify
from grainfront.packing.orientations import orientation_law
from grainfront.packing.pack import fill
from grainfront.packing.periodic import pack_periodic
from grainfront.packing.prepare import prepare
from grainfront.particles import Cell, Rectangle, tiled
from grainfront.polygons import Polygons
from grainfront.statistics import find_contacts, volume_fraction, volume_fraction_bulk


def ellipse(aspect_ratio, nodes):
    angle = np.arange(nodes) * 2.0 * np.pi / nodes + 0.1
    return np.column_stack([aspect_ratio * np.cos(angle), np.sin(angle)]) / 2.0


FAMILIES = {
    "rectangles": [np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [0.75, 0.5]],
    "triangles": [np.array([[-0.5, -0.3], [0.5, -0.3], [0.0, 0.6]])],
    "hulls": [ellipse(1.3, 20), ellipse(1.6, 13)],
}


def particles(family, count, seed):
    """The first arguments of `prepare`, for particles of sizes 0.5 to 1."""
    hulls = Polygons.of(FAMILIES[family])
    rng = np.random.default_rng(seed)
    law = orientation_law(np.full(24, 1 / 24), np.linspace(0.0, 180.0, 6145))
    return hulls, rng.integers(0, hulls.count, count), rng.uniform(0.5, 1.0, count), law, rng


def pack(family, side, along_y, n_angle=2, n_loc=2, seed=0):
    hulls, shape, size, law, rng = particles(family, int(8.0 * (side + 12.0) ** 2), seed)
    return pack_periodic(
        hulls, np.full(hulls.count, 1.4), shape, size, law,
        Cell(0.0, 0.0, side, side, along_y), n_angle, n_loc, rng, 0.75 * 1.4,
    )  # fmt: skip


@pytest.mark.compiled
@pytest.mark.parametrize("along_y", [False, True])
@pytest.mark.parametrize("family", ["rectangles", "triangles", "hulls"])
def test_the_tiled_cell_has_no_exact_overlap(family, along_y):
    packing, _, before = pack(family, 15.0, along_y)
    whole = tiled(packing)
    assert whole.x.size == packing.x.size * (9 if along_y else 3)
    assert certify(whole).holds
    assert certify(packing).holds
    inside = [(packing.x >= 0.0) & (packing.x < 15.0), (packing.y >= 0.0) & (packing.y < 15.0)]
    assert np.all(inside)
    assert volume_fraction(packing) >= before


def test_a_particle_pushed_into_its_neighbours_image_is_found(packing_of):
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    row = [square, square + [1.0, 0.0]]
    for width, overlaps, contacts in ((2.0, 0, 1), (np.nextafter(2.0, 0.0), 1, 1), (2.5, 0, 1)):
        packing = packing_of(row, Cell(0.0, 0.0, width, 1.0, False))
        certificate = certify(packing)
        assert certificate.overlaps == overlaps
        assert certificate.across_wall == 0
        found = find_contacts(packing)
        across = width <= 2.0
        assert len(found.pairs) == contacts + across
        assert sorted(found.wall.tolist()) == [1, 1, 3, 3]
    assert len(find_contacts(packing_of(row, Cell(0.0, 0.0, 2.0, 1.0, True))).wall) == 0


@pytest.mark.compiled
@pytest.mark.parametrize("along_y", [False, True])
def test_closing_costs_little(along_y):
    hulls, shape, size, law, rng = particles("hulls", 4000, 0)
    empty = prepare(hulls, shape, size, [law], Rectangle(0.0, 0.0, 40.0, 40.0), 6, 6, rng)
    rectangle, _ = fill(empty, np.ones(hulls.count))
    packing, _, _ = pack("hulls", 30.0, along_y, 6, 6)
    bulk = volume_fraction_bulk(rectangle)
    assert bulk - 0.035 < volume_fraction_bulk(packing) < bulk + 0.01
