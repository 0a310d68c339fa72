"""Particles drawn from a database: their laws, their variety, and shortfalls told."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront import laws
from grainfront.draw import CLOSEST_SHAPES, closest_shapes, coverage, draw_particles
from grainfront.errors import InputError

SIZE = laws.Lognormal(1.3, 0.35, minimum=0.6, maximum=2.8)
ASPECT_RATIO = laws.Normal(1.5, 0.3, minimum=1.1, maximum=2.2)


def error(law, values):
    edges, p = law.bins(24)
    share = np.histogram(values, edges)[0] / len(values)
    return np.sqrt(np.sum((share - p) ** 2))


def small_database(rng):
    """300 aspect ratios, unlike the law but at least one in each of its bins."""
    edges, _ = ASPECT_RATIO.bins(24)
    middles = (edges[1:] + edges[:-1]) / 2
    return rng.permutation(np.concatenate([middles, 1.0 + rng.gamma(2.0, 0.15, 276)]))


def test_size_and_descriptor_follow_their_laws_from_a_small_database():
    rng = np.random.default_rng(1)
    descriptor = small_database(rng)
    assert coverage(descriptor, ASPECT_RATIO).empty_bins == 0
    for seed in range(4):
        shape, size = draw_particles(
            300, SIZE, 15_000, np.random.default_rng(seed), (descriptor, ASPECT_RATIO)
        )
        assert shape.dtype == np.int64 and shape.shape == size.shape == (15_000,)
        assert error(SIZE, size) <= 1e-3
        assert error(ASPECT_RATIO, descriptor[shape]) <= 1e-3
        assert abs(np.corrcoef(size, descriptor[shape])[0, 1]) < 4 / np.sqrt(15_000)


def test_bins_without_a_shape_are_told_and_filled_from_their_neighbours():
    rng = np.random.default_rng(2)
    edges, p = ASPECT_RATIO.bins(24)
    descriptor = rng.uniform(edges[0], edges[20], 500)
    told = coverage(descriptor, ASPECT_RATIO)
    assert told.empty_bins == 4
    assert told.empty_probability == pytest.approx(p[20:].sum())
    assert told.shapes_per_bin.sum() == 500
    shape, _ = draw_particles(500, SIZE, 5000, rng, (descriptor, ASPECT_RATIO))
    top = np.argsort(descriptor)[-CLOSEST_SHAPES:]
    assert np.isin(shape, top).mean() >= p[20:].sum() * 0.98


def test_a_bin_that_the_law_leaves_empty_needs_no_shape():
    law = laws.Histogram((1.0, 1.5, 2.0, 2.5), (1, 0, 1))
    told = coverage(np.concatenate([np.linspace(1, 1.49, 99), np.linspace(2, 2.5, 99)]), law, 3)
    assert told == (pytest.approx(np.array([99, 0, 99])), 0, 0.0)


def test_a_constant_law_finds_the_shape_that_rounding_left_next_to_it():
    descriptor = np.array([1.0, 1.5 + 2e-15, 2.0])
    assert coverage(descriptor, laws.Constant(1.5)).empty_bins == 0
    assert coverage(descriptor, laws.Constant(1.7)).empty_probability == 1.0
    rng = np.random.default_rng(0)
    shape, _ = draw_particles(3, SIZE, 50, rng, (descriptor, laws.Constant(1.5)))
    assert (shape == 1).all()


@settings(max_examples=40, deadline=None)
@given(
    descriptor=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=30),
    wanted=st.lists(st.floats(0.0, 1.0), min_size=1, max_size=10),
    seed=st.integers(0, 100),
)
def test_the_shape_picked_is_among_the_closest_of_its_bin(descriptor, wanted, seed):
    """Against a plain search over every shape."""
    edges = np.linspace(0.0, 1.0, 5)
    descriptor, wanted = np.array(descriptor), np.array(wanted)
    picked = closest_shapes(descriptor, wanted, edges, np.random.default_rng(seed))
    for value, shape in zip(wanted, picked, strict=True):
        same_bin = laws.bin_of(edges, descriptor) == laws.bin_of(edges, value)
        candidates = descriptor[same_bin] if same_bin.any() else descriptor
        distances = np.sort(np.abs(candidates - value))
        assert abs(descriptor[shape] - value) <= distances[:CLOSEST_SHAPES][-1]
        assert same_bin[shape] or not same_bin.any()


def test_all_of_the_closest_shapes_are_used():
    descriptor = np.linspace(0.0, 1.0, 101)
    picked = closest_shapes(
        descriptor, np.full(1000, 0.5), np.array([0.0, 1.0]), np.random.default_rng(0)
    )
    assert set(picked) == {48, 49, 50, 51, 52}
    assert np.bincount(picked)[48:].min() > 150


def test_shapes_without_a_finite_descriptor_are_never_matched():
    rng = np.random.default_rng(4)
    descriptor = np.where(np.arange(100) % 2, np.inf, np.linspace(0.5, 2.0, 100))
    shape, _ = draw_particles(100, SIZE, 1000, rng, (descriptor, laws.Uniform(0.5, 2.5)))
    assert (shape % 2 == 0).all()
    with pytest.raises(InputError, match="finite"):
        draw_particles(3, SIZE, 10, rng, (np.full(3, np.inf), laws.Uniform(0.5, 2.5)))


def test_a_law_apart_from_all_shapes_is_refused():
    descriptor = np.array([1.1, 1.3, 1.5])
    rng = np.random.default_rng(4)
    for law in (laws.Constant(1.5 * (1 + 1e-12)), laws.Constant(1.2), laws.Uniform(1.4, 9.0)):
        assert draw_particles(3, SIZE, 10, rng, (descriptor, law))[0].size == 10
    for law in (laws.Constant(50.0), laws.Uniform(1.6, 2.0), laws.Uniform(1.0, 1.05)):
        with pytest.raises(InputError, match=r"must meet the values of .* 1\.1 to 1\.5"):
            draw_particles(3, SIZE, 10, rng, (descriptor, law))
        with pytest.raises(InputError, match="must meet the values"):
            coverage(descriptor, law)


def test_without_a_matched_law_every_shape_is_used_equally_often_in_random_order():
    shape, size = draw_particles(37, SIZE, 37 * 20 + 5, np.random.default_rng(1))
    assert set(np.bincount(shape, minlength=37)) <= {20, 21}
    assert not np.array_equal(shape[:37], shape[37:74])
    assert error(SIZE, size) < 0.02


def test_sizes_do_not_depend_on_whether_a_descriptor_is_matched():
    descriptor = np.linspace(1.0, 2.5, 50)
    with_law = draw_particles(50, SIZE, 100, np.random.default_rng(1), (descriptor, ASPECT_RATIO))
    without = draw_particles(50, SIZE, 100, np.random.default_rng(1))
    assert np.array_equal(with_law[1], without[1])
