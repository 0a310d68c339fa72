"""Families of shapes."""

import numpy as np
import pytest
import shapely

from grainfront.errors import InputError
from grainfront.shapes import families
from grainfront.shapes.sources import (
    FourierGrains,
    RandomConvexPolygons,
    Rectangles,
    RegularPolygon,
)


def test_rectangles_are_evenly_spaced_in_aspect_ratio():
    found = families.rectangles(Rectangles((1.0, 3.0), 5))
    ratios = [np.ptp(found.polygon(i), axis=0)[0] for i in range(found.count)]
    np.testing.assert_allclose(ratios, [1, 1.5, 2, 2.5, 3])


def test_a_single_aspect_ratio_makes_one_rectangle():
    assert families.rectangles(Rectangles((1.5, 1.5), 9)).count == 1


@pytest.mark.parametrize("vertices", [3, 5, 12])
def test_regular_polygon_has_equal_edges_and_angles(vertices):
    nodes = families.regular_polygon(RegularPolygon(vertices)).polygon(0)
    edge = np.roll(nodes, -1, axis=0) - nodes
    np.testing.assert_allclose(np.hypot(*edge.T), 2 * np.sin(np.pi / vertices))
    assert nodes[0, 1] == pytest.approx(nodes[1, 1])
    assert shapely.LinearRing(nodes).is_ccw


@pytest.mark.parametrize("vertices", [3, 4, 12, 40])
def test_random_convex_polygons_are_convex_closed_and_of_exactly_so_many_vertices(vertices):
    family = RandomConvexPolygons(vertices, 20)
    found = families.random_convex_polygons(family, np.random.default_rng(1))
    for i in range(found.count):
        nodes = found.polygon(i)
        edge = np.roll(nodes, -1, axis=0) - nodes
        following = np.roll(edge, -1, axis=0)
        assert len(nodes) == vertices
        assert (edge[:, 0] * following[:, 1] - edge[:, 1] * following[:, 0]).min() > 0


def test_fourier_grains_have_the_spectrum_asked_for():
    family = FourierGrains(vertices=128, count=5, d2=0.2, d3=0.1, d8=0.02)
    found, rejected = families.fourier_grains(family, np.random.default_rng(1))
    assert rejected == 0
    for i in range(found.count):
        radius = np.hypot(*found.polygon(i).T)
        amplitude = 2 * np.abs(np.fft.rfft(radius)) / len(radius)
        np.testing.assert_allclose(
            amplitude[[1, 2, 3, 6, 8, 16]], [0, 0.2, 0.1, 0.025, 0.02, 0.005], atol=1e-12
        )


def test_fourier_grains_that_cross_themselves_are_drawn_again_and_counted():
    family = FourierGrains(count=50, d2=0.5, d3=0.4, d8=0.1)
    found, rejected = families.fourier_grains(family, np.random.default_rng(1))
    assert rejected > 0
    assert shapely.is_valid(found.to_shapely()).all()


def test_a_spectrum_that_always_crosses_is_bad_input():
    with pytest.raises(InputError, match="smaller amplitudes"):
        families.fourier_grains(FourierGrains(count=1, d2=5.0), np.random.default_rng(1))


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: families.rectangles(Rectangles((0.5, 2.0), 3)), "aspect_ratio"),
        (lambda: families.rectangles(Rectangles((1.0, float("nan")), 3)), "aspect_ratio"),
        (lambda: families.rectangles(Rectangles((1.0, 2.0), 0)), "count is 0"),
        (lambda: families.regular_polygon(RegularPolygon(2)), "vertices is 2"),
        (
            lambda: families.random_convex_polygons(
                RandomConvexPolygons(2, 1), np.random.default_rng()
            ),
            "vertices is 2",
        ),
    ],
)
def test_impossible_families_are_bad_input(build, message):
    with pytest.raises(InputError, match=message):
        build()
