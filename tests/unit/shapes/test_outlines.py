"""Outlines of rasterised shapes whose descriptors are known."""

import numpy as np
import pytest
import shapely
from scipy.special import ellipe

from grainfront.polygons import Polygons
from grainfront.shapes.descriptors import clean_outline, describe, hull_indices
from grainfront.shapes.outlines import raw_contour, simplify, smooth_outline, trace_labels


def ellipse_mask(size, aspect_ratio, centre, turn):
    """Pixels whose centres lie in an ellipse."""
    long, short = 0.5 * size * aspect_ratio, 0.5 * size
    n = int(long) + 4
    y, x = np.mgrid[-n : n + 1, -n : n + 1]
    x, y = x - centre[0], y - centre[1]
    u, v = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
    return (u / long) ** 2 + (v / short) ** 2 < 1


def random_poses(size, aspect_ratio, count, seed):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        yield ellipse_mask(size, aspect_ratio, rng.uniform(0, 1, 2), rng.uniform(0, np.pi))


def final_outline(mask):
    return clean_outline(simplify(smooth_outline(mask)))


def described(outlines):
    hulls = Polygons.of([outline[hull_indices(outline)] for outline in outlines])
    return describe(Polygons.of(outlines), hulls)


@pytest.mark.parametrize("aspect_ratio", [1.0, 1.2, 1.5, 2.0, 3.0])
@pytest.mark.parametrize(("size", "count"), [(15, 200), (22, 80), (40, 40), (80, 15), (160, 5)])
def test_ellipses_of_known_shape_are_found_without_bias(size, aspect_ratio, count):
    outlines = [final_outline(m) for m in random_poses(size, aspect_ratio, count, seed=1)]
    mean = {k: v.mean() for k, v in described(outlines).items()}
    perimeter = 2 * size * aspect_ratio * ellipe(1 - aspect_ratio**-2)
    assert mean["size"] == pytest.approx(size, rel=0.005)
    assert mean["aspect_ratio"] == pytest.approx(aspect_ratio, rel=0.005)
    assert mean["perimeter"] == pytest.approx(perimeter, rel=0.005)
    assert mean["circularity"] == pytest.approx(aspect_ratio**-0.5, rel=0.01)


def test_the_raw_contour_does_have_the_bias():
    lengths = [
        shapely.LinearRing(np.column_stack([c.real, c.imag])).length
        for c in map(raw_contour, random_poses(60, 1.5, 20, seed=2))
    ]
    assert np.mean(lengths) == pytest.approx(1.055 * 180 * ellipe(5 / 9), rel=0.005)


def lobed_radius(angle):
    """A grain of three lobes with hollows between, of mean radius 1."""
    return 1 + 0.12 * np.cos(2 * angle + 0.3) + 0.28 * np.cos(3 * angle)


def lobed_mask(radius, centre, turn):
    n = int(1.4 * radius) + 4
    y, x = np.mgrid[-n : n + 1, -n : n + 1]
    x, y = x - centre[0], y - centre[1]
    return np.hypot(x, y) < radius * lobed_radius(np.arctan2(y, x) - turn)


# S is twice the mean radius here; the hollows fill a little where they are few pixels deep.
@pytest.mark.parametrize(
    ("radius", "count", "within"), [(15, 60, 0.15), (30, 30, 0.06), (60, 8, 0.04)]
)
def test_regularity_of_a_lobed_grain_is_free_of_the_staircase(radius, count, within):
    angle = np.linspace(0.0, 2.0 * np.pi, 20001)[:-1]
    exact = lobed_radius(angle) * np.array([np.cos(angle), np.sin(angle)])
    known = {k: v[0] for k, v in described([exact.T]).items()}
    rng = np.random.default_rng(5)
    masks = [
        lobed_mask(radius, rng.uniform(0, 1, 2), rng.uniform(0, 2 * np.pi)) for _ in range(count)
    ]
    found = described([final_outline(mask) for mask in masks])
    raw = described(
        [clean_outline(np.column_stack([c.real, c.imag])) for c in map(raw_contour, masks)]
    )
    assert found["perimeter"].mean() == pytest.approx(radius * known["perimeter"], rel=0.005)
    assert np.median(found["regularity"]) == pytest.approx(known["regularity"], abs=within)
    assert np.median(raw["regularity"]) < known["regularity"] - 0.4


@pytest.mark.parametrize("aspect_ratio", [1.0, 2.0])
def test_corners_of_rectangles_survive(aspect_ratio):
    rng = np.random.default_rng(3)
    size = 40.0
    y, x = np.mgrid[:120, :120]
    perimeters, areas = [], []
    for _ in range(20):
        turn, centre = rng.uniform(0, np.pi), rng.uniform(59, 60, 2)
        u = (x - centre[0]) * np.cos(turn) + (y - centre[1]) * np.sin(turn)
        v = (y - centre[1]) * np.cos(turn) - (x - centre[0]) * np.sin(turn)
        polygon = shapely.Polygon(
            final_outline((abs(u) < size * aspect_ratio / 2) & (abs(v) < size / 2))
        )
        perimeters.append(polygon.length)
        areas.append(polygon.area)
    assert np.mean(areas) == pytest.approx(size**2 * aspect_ratio, rel=0.005)
    # Corners are rounded at a radius r of about 1.5 pixels: 4 (2 - pi/2) r is 2 % of 160.
    assert np.mean(perimeters) == pytest.approx(2 * size * (1 + aspect_ratio), rel=0.02)


def test_outlines_are_simple_counter_clockwise_and_moderate():
    for mask in random_poses(40, 1.5, 10, seed=4):
        outline = final_outline(mask)
        ring = shapely.LinearRing(outline)
        assert ring.is_simple and ring.is_ccw
        assert 25 <= len(outline) <= 60
        assert ring.is_valid


def test_area_of_the_mask_is_kept():
    mask = next(random_poses(40, 1.5, 1, seed=5))
    assert shapely.Polygon(final_outline(mask)).area == pytest.approx(mask.sum(), rel=1e-3)


def test_touching_labels_are_traced_each_by_itself():
    labels = np.zeros((80, 120), int)
    y, x = np.mgrid[:80, :120]
    labels[np.hypot(x - 40, y - 40) < 20] = 1
    labels[(np.hypot(x - 79, y - 40) < 20) & (labels == 0)] = 7
    outlines, counts = trace_labels(labels, 30, 0.9)
    assert counts["kept"] == 2
    centroids = shapely.get_coordinates(shapely.centroid(outlines.to_shapely()))
    np.testing.assert_allclose(centroids, [[40, 40], [79, 40]], atol=0.5)


def test_every_drop_is_counted_by_its_reason():
    labels = np.zeros((120, 200), int)
    y, x = np.mgrid[:120, :200]
    labels[np.hypot(x - 40, y - 40) < 20] = 1
    labels[np.hypot(x - 40, y - 40) < 6] = 0  # a hole in grain 1
    labels[np.hypot(x, y - 100) < 15] = 2  # at the border
    labels[np.hypot(x - 100, y - 20) < 3] = 3  # a speck
    labels[(abs(x - 130) < 20) & (abs(y - 80) < 3)] = 4  # a cross: a clump
    labels[(abs(x - 130) < 3) & (abs(y - 80) < 20)] = 4
    outlines, counts = trace_labels(labels, 36, 0.85)
    assert outlines.count == 1
    assert counts == {
        "found": 4, "kept": 1, "border": 1, "speck": 1, "clump": 1, "self_crossing": 0, "hole": 1
    }  # fmt: skip
    hole_filled = shapely.area(outlines.to_shapely()[0])
    assert hole_filled == pytest.approx(np.pi * 20**2, rel=0.01)
