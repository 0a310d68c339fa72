"""The optimised search chooses what exhaustive search chooses, step by step.

Both packings start from the same state and are compared bit for bit, so that each step is chosen
from the same front until the first difference, of which there must be none.
"""

import numpy as np
import pytest

from grainfront.geometry.rings import polygon_areas
from grainfront.packing import PRUNED_FROM_N_LOC, search_of
from grainfront.packing.fronts import advance_to
from grainfront.packing.orientations import orientation_law
from grainfront.packing.prepare import prepare
from grainfront.packing.turns import N_PLACED
from grainfront.particles import Rectangle
from grainfront.polygons import Polygons


def jittered(count, elongation, rng):
    angle = (np.arange(count) + rng.uniform(-0.3, 0.3, count)) * 2.0 * np.pi / count
    nodes = np.column_stack([elongation * np.cos(angle), np.sin(angle)])
    x, y = nodes.T
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    centroid = (cross[:, None] * (nodes + np.roll(nodes, -1, axis=0))).sum(0) / cross.sum() / 3
    return (nodes - centroid) / 1.9


def rectangle(aspect_ratio):
    return np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [aspect_ratio / 2, 0.5]


def many(count, elongation, kinds=100):
    rng = np.random.default_rng(count)
    return [jittered(count, elongation, rng) for _ in range(kinds)]


FAMILIES = {
    "rectangles of 1.5": ([rectangle(1.5)], 110.0),
    "rectangles of 4": ([rectangle(4.0)], 150.0),
    "triangles": (many(3, 1.0), 55.0),
    "irregular hulls": (many(30, 1.4), 80.0),
}


def prepare_family(family, side, seed, n_angle, n_loc, smallest=0.5):
    hulls = Polygons.of(FAMILIES[family][0])
    rng = np.random.default_rng(seed)
    mean_area = polygon_areas(hulls.nodes, hulls.offsets).mean() * (smallest + 1.5) ** 2 / 2
    n = int(1.2 * side**2 / mean_area) + 50
    law = orientation_law(np.full(24, 1 / 24), np.linspace(0.0, 180.0, 6145))
    return prepare(
        hulls, rng.integers(0, hulls.count, n), rng.uniform(smallest, 2.0, n), [law],
        Rectangle(0.0, 0.0, side, side), n_angle, n_loc, rng,
    )  # fmt: skip


def assert_same_choices(side, *arguments):
    """Pack by both searches; the particles placed."""
    optimised = prepare_family(*arguments[:1], side, *arguments[1:])
    exhaustive = prepare_family(*arguments[:1], side, *arguments[1:])._replace(memory=None)
    assert optimised.memory is not None
    for state in (optimised, exhaustive):
        advance_to(state, 2**62)
    n, same = (int(state.counters[N_PLACED]) for state in (optimised, exhaustive))
    assert n == same
    for one, other in zip(optimised.placed, exhaustive.placed, strict=True):
        np.testing.assert_array_equal(one[:n], other[:n])
    return n


@pytest.mark.compiled
@pytest.mark.parametrize("family", FAMILIES)
@pytest.mark.parametrize("seed", [1, 2])
def test_the_choice_is_that_of_exhaustive_search(family, seed):
    assert assert_same_choices(FAMILIES[family][1], family, seed, 24, 20) > 1500


@pytest.mark.parametrize("family", FAMILIES)
def test_so_it_is_on_the_shortest_front_that_is_pruned(family):
    assert assert_same_choices(12.0, family, 3, 4, PRUNED_FROM_N_LOC) > 8


@pytest.mark.compiled
@pytest.mark.parametrize("family", FAMILIES)
def test_so_it_is_among_grains_of_very_different_sizes(family):
    assert assert_same_choices(40.0, family, 4, 24, 12, 0.1) > 150


@pytest.mark.parametrize(
    ("n_angle", "n_loc", "search"),
    [(1, 1, "exhaustive"), (24, 1, "exhaustive"), (24, 5, "exhaustive"), (1, 8, "pruned")],
)
def test_short_fronts_are_searched_exhaustively(n_angle, n_loc, search):
    state = prepare_family("triangles", 12.0, 0, n_angle, n_loc)
    assert search_of(n_angle, n_loc) == search
    assert (state.memory is None) == (search == "exhaustive")
