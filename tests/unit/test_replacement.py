"""Nonconvex replacement: bit-identical hull nodes, exact containment, areas."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import shapely

from grainfront.certificate import certify
from grainfront.errors import InputError
from grainfront.particles import Rectangle
from grainfront.polygons import Polygons
from grainfront.replacement import replace_hulls


def dented_outline(rng, corners):
    """A random convex polygon with nodes added on its edges and in bays behind them."""
    angle = 2 * np.pi * (np.arange(corners) + rng.uniform(0, 0.6, corners)) / corners
    hull = np.column_stack([1.3 * np.cos(angle), 0.8 * np.sin(angle)])
    hull -= np.array(shapely.Polygon(hull).centroid.coords[0])
    nodes, on_hull = [], []
    for p, q in zip(hull, np.roll(hull, -1, axis=0), strict=True):
        on_hull.append(len(nodes))
        nodes.append(p)
        for share in np.sort(rng.random(rng.integers(0, 4))):
            depth = rng.choice([0.0, 1e-15, 0.05, 0.3])
            nodes.append((1 - depth) * (p + share * (q - p)))
    return np.array(nodes), np.array(on_hull)


@pytest.fixture(scope="module")
def shapes():
    rng = np.random.default_rng(11)
    found = [dented_outline(rng, rng.integers(3, 12)) for _ in range(25)]
    outlines = Polygons.of(nodes for nodes, _ in found)
    hulls = Polygons.of(nodes[on_hull] for nodes, on_hull in found)
    hull_nodes = np.concatenate(
        [start + on_hull for start, (_, on_hull) in zip(outlines.offsets, found, strict=False)]
    )
    assert (hulls.nodes == outlines.nodes[hull_nodes]).all()
    return outlines, hulls, hull_nodes


@pytest.fixture(scope="module", params=[0.0, 1e6])
def packing(request, shapes, packing_of):
    """Hulls on a lattice, turned and scaled at random; far from the origin rounding is coarse."""
    _, hulls, _ = shapes
    rng = np.random.default_rng(4)
    n, offset = 400, request.param
    shape = rng.integers(0, hulls.count, n)
    size, orientation = rng.uniform(0.1, 1.0, n), rng.uniform(0, 180, n)
    x, y = offset + 3.0 * (np.arange(n) % 20), offset + 3.0 * (np.arange(n) // 20)
    parts = []
    for i in range(n):
        c, s = np.cos(np.radians(orientation[i])), np.sin(np.radians(orientation[i]))
        turned = hulls.polygon(shape[i]) @ np.array([[c, s], [-s, c]])
        parts.append(np.array([x[i], y[i]]) + size[i] * turned)
    domain = Rectangle(offset - 2.0, offset - 2.0, offset + 60.0, offset + 60.0)
    return packing_of(
        parts, domain, x=x, y=y, size=size, orientation=orientation, shape=shape, left_over=7
    )


def test_hull_nodes_are_bit_identical(packing, shapes):
    outlines, hulls, hull_nodes = shapes
    replaced = replace_hulls(packing, *shapes)
    for i, s in enumerate(packing.shape):
        of_shape = hull_nodes[hulls.offsets[s] : hulls.offsets[s + 1]] - outlines.offsets[s]
        on_hull = replaced.polygons.polygon(i)[of_shape]
        assert on_hull.tobytes() == packing.polygons.polygon(i).tobytes()
    assert replaced.left_over == 7


def test_outlines_are_the_database_moved(packing, shapes):
    """Every node, back in the database's frame, is where it came from up to rounding."""
    outlines, *_ = shapes
    replaced = replace_hulls(packing, *shapes)
    rounding = 8 * np.spacing(np.abs(packing.polygons.nodes).max())
    for i, s in enumerate(packing.shape):
        c, sn = (
            np.cos(np.radians(packing.orientation[i])),
            np.sin(np.radians(packing.orientation[i])),
        )
        moved = replaced.polygons.polygon(i) - [packing.x[i], packing.y[i]]
        back = moved @ np.array([[c, -sn], [sn, c]]) / packing.size[i]
        assert np.abs(back - outlines.polygon(s)).max() <= rounding / packing.size[i]


def test_every_node_lies_in_its_packed_hull_exactly(packing, shapes):
    """Nodes on a hull's edge are what rounding would push across it."""
    replaced = replace_hulls(packing, *shapes)
    for i in range(0, packing.x.size, 4):
        hull = [tuple(map(Fraction, p)) for p in packing.polygons.polygon(i).tolist()]
        for x, y in replaced.polygons.polygon(i).tolist():
            x, y = Fraction(x), Fraction(y)
            assert all(
                (q[0] - p[0]) * (y - p[1]) >= (q[1] - p[1]) * (x - p[0])
                for p, q in zip(hull, hull[1:] + hull[:1], strict=True)
            )


def test_area_and_circumradius_are_those_of_the_outlines(packing, shapes):
    replaced = replace_hulls(packing, *shapes)
    outlines = replaced.polygons.to_shapely()
    assert replaced.area == pytest.approx(shapely.area(outlines), rel=1e-9)
    centres = shapely.points(packing.x, packing.y)
    reach = shapely.hausdorff_distance(centres, shapely.extract_unique_points(outlines))
    assert replaced.circumradius == pytest.approx(reach, rel=1e-12)


def test_certificate_of_touching_hulls_survives(shapes, packing_of):
    """Squares edge to edge give way to squares with bays; the edges keep their touching corners."""
    square = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    outline = np.insert(square, [1, 2], [[0.0, -0.5], [0.3, 0.1]], axis=0)
    x, y = np.arange(36) % 6 + 0.5, np.arange(36) // 6 + 0.5
    turned = np.full(36, 90.0)
    parts = [square[[1, 2, 3, 0]] + centre for centre in np.column_stack([x, y])]
    packed = packing_of(parts, x=x, y=y, orientation=turned)
    database = Polygons.of([outline]), Polygons.of([square]), np.array([0, 2, 4, 5])
    replaced = replace_hulls(packed, *database)
    assert certify(packed).holds
    certificate = certify(replaced)
    assert certificate.holds
    assert certificate.pairs_tested == 110


def test_certificate_of_a_replaced_packing(packing, shapes):
    assert certify(packing).holds
    assert certify(replace_hulls(packing, *shapes)).holds


def test_other_shapes_are_refused(packing, shapes):
    with pytest.raises(InputError, match="entries 0 to 24"):
        replace_hulls(replace(packing, shape=packing.shape + 10), *shapes)
    with pytest.raises(InputError, match="not made of these shapes"):
        replace_hulls(replace(packing, shape=(packing.shape + 1) % 25), *shapes)
    with pytest.raises(InputError, match="not the hull of its shape"):
        replace_hulls(replace(packing, orientation=packing.orientation + 5.0), *shapes)
