"""Laws against scipy.stats, against exact integration, and the noise of the stratified draw."""

import numpy as np
import pytest
import scipy.stats
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront import laws
from grainfront.errors import InputError

FAMILIES = [
    (laws.Uniform(0.5, 2.0), scipy.stats.uniform(0.5, 1.5)),
    (laws.Normal(1.5, 0.3), scipy.stats.norm(1.5, 0.3)),
    (laws.Lognormal(1.3, 0.4), scipy.stats.lognorm(0.4, scale=1.3)),
    (laws.Weibull(1.7, 2.0, location=0.5), scipy.stats.weibull_min(1.7, 0.5, 2.0)),
    (laws.Exponential(2.0, location=1.0), scipy.stats.expon(1.0, 2.0)),
    (laws.Gamma(2.5, 0.4), scipy.stats.gamma(2.5, scale=0.4)),
    (laws.Beta(1.0, 3.0, 2.0, 5.0), scipy.stats.beta(2.0, 5.0, 1.0, 2.0)),
]
GRADING = laws.GradingCurve((0.5, 1.0, 2.0, 4.0), (0.0, 15.0, 60.0, 100.0))
EVERY_KIND = [law for law, _ in FAMILIES] + [
    laws.Normal(1.5, 0.3, minimum=1.0, maximum=2.0),
    laws.Lognormal(1.3, 0.4, minimum=0.7),
    laws.Weibull(0.8, 1.0, maximum=3.0),
    laws.Gamma(2.5, 0.4, minimum=0.2, maximum=2.0),
    laws.Histogram((0.0, 1.0, 2.0, 4.0, 5.0), (0, 3, 0, 1)),
    GRADING,
]


def error_and_noise(law, values, n_bin=24):
    """E2 and its value under independent sampling, by numpy.histogram."""
    edges, p = law.bins(n_bin)
    share = np.histogram(values, edges)[0]
    share = share / share.sum()
    return np.sqrt(np.sum((share - p) ** 2)), np.sqrt((1 - np.sum(p**2)) / len(values))


@pytest.mark.parametrize(("law", "reference"), FAMILIES, ids=lambda v: type(v).__name__)
def test_families_agree_with_scipy(law, reference):
    u = np.linspace(0.001, 0.999, 201)
    np.testing.assert_allclose(law.quantile(u), reference.ppf(u), rtol=1e-10)
    x = np.linspace(-1.0, 6.0, 301)
    np.testing.assert_allclose(law.cdf(x), reference.cdf(x), rtol=1e-10, atol=1e-14)
    assert law.moment(2) == pytest.approx(reference.moment(2), rel=2e-4)


@pytest.mark.parametrize("law", EVERY_KIND, ids=lambda v: type(v).__name__)
@settings(max_examples=40, deadline=None)
@given(u=st.floats(1e-6, 1 - 1e-6))
def test_cdf_inverts_quantile(law, u):
    assert float(law.cdf(law.quantile(u))) == pytest.approx(u, abs=1e-9)


@pytest.mark.parametrize("law", EVERY_KIND, ids=lambda v: type(v).__name__)
def test_bins_are_equal_and_their_probabilities_add_up_over_a_finite_support(law):
    lower, upper = law.support
    assert np.isfinite([lower, upper]).all() and lower < upper
    edges, p = law.bins(24)
    assert (edges[0], edges[-1]) == (lower, upper)
    np.testing.assert_allclose(np.diff(edges), (upper - lower) / 24, rtol=1e-9)
    bounded = np.isfinite(law.quantile([0.0, 1.0])).all()
    assert p.sum() == pytest.approx(1.0 if bounded else 0.999, abs=1e-9) and (p >= 0).all()
    np.testing.assert_allclose(p, np.diff(law.cdf(edges)), atol=1e-12)


@pytest.mark.parametrize("law", EVERY_KIND, ids=lambda v: type(v).__name__)
def test_quantiles_within_the_support_run_from_end_to_end(law):
    values = law.quantiles_within_support(100)
    assert values.shape == (101,) and (np.diff(values) >= 0).all()
    np.testing.assert_allclose([values[0], values[-1]], law.support, rtol=1e-6)
    shares = law.cdf(law.support)
    expected = np.linspace(*shares, 101)
    reached = law.cdf(values)
    assert np.abs(reached - expected).max() <= 1e-6 or type(law).__name__ == "Histogram"


@settings(max_examples=30, deadline=None)
@given(
    mean=st.floats(-3, 3),
    sd=st.floats(0.1, 3),
    low=st.floats(-4, 3),
    width=st.floats(0.01, 5),
    x=st.floats(0, 1),
)
def test_truncation_is_the_law_on_condition_of_its_range(mean, sd, low, width, x):
    low = mean + low * sd
    law = laws.Normal(mean, sd, minimum=low, maximum=low + width)
    whole = scipy.stats.norm(mean, sd)
    x = low + x * width
    expected = (whole.cdf(x) - whole.cdf(low)) / (whole.cdf(low + width) - whole.cdf(low))
    assert float(law.cdf(x)) == pytest.approx(expected, abs=1e-6)
    assert law.support == (low, low + width)
    drawn = laws.stratified(law, 200, np.random.default_rng(0))
    assert drawn.min() >= low and drawn.max() <= low + width


def test_a_constant_has_one_bin_that_holds_what_rounding_makes_of_it():
    law = laws.Constant(1.5)
    edges, p = law.bins()
    assert edges.tolist() == [1.5, 1.5] and p.tolist() == [1.0] and law.support == (1.5, 1.5)
    values = [1.5 - 1e-15, 1.5, 1.5 + 1e-12, 1.4999, 1.5001]
    assert laws.bin_of(edges, values).tolist() == [0, 0, 0, -1, 1]
    assert (laws.stratified(law, 5, np.random.default_rng(0)) == 1.5).all()


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(-0.5, 3.0), min_size=1, max_size=50))
def test_bin_of_agrees_with_numpy_histogram(values):
    edges = np.linspace(0.0, 2.0, 9)
    values = np.concatenate([values, edges])
    index = laws.bin_of(edges, values)
    inside = (index >= 0) & (index < 8)
    assert np.array_equal(np.bincount(index[inside], minlength=8), np.histogram(values, edges)[0])
    assert (values[index < 0] < 0).all() and (values[index >= 8] > 2).all()


def test_grading_curve_gives_back_its_mass():
    """The mass (S²) of the grains drawn by number passes the sieves as the curve says."""
    drawn = laws.stratified(GRADING, 200_000, np.random.default_rng(3))
    mass = drawn**2
    for size, percent in zip(GRADING.sieve_sizes, GRADING.percent_passing, strict=True):
        passing = 100 * mass[drawn <= size].sum() / mass.sum()
        assert passing == pytest.approx(percent, abs=0.01)
    # straight over the logarithm between sieves: half the interval's mass at the geometric mean
    assert 100 * mass[drawn <= np.sqrt(2)].sum() / mass.sum() == pytest.approx(37.5, abs=0.01)


def test_grading_curve_by_number_is_the_integral_of_mass_over_area():
    sizes, percent = np.array(GRADING.sieve_sizes), np.array(GRADING.percent_passing)
    s = np.linspace(0.5, 4.0, 700_001)
    middle = (s[1:] + s[:-1]) / 2
    passing = np.interp(np.log(s), np.log(sizes), percent)
    number = np.concatenate([[0.0], np.cumsum(np.diff(passing) / middle**2)])
    np.testing.assert_allclose(GRADING.cdf(s), number / number[-1], atol=1e-8)


@pytest.mark.parametrize("law", EVERY_KIND, ids=lambda v: type(v).__name__)
def test_every_prefix_of_a_stratified_draw_is_close_to_the_law(law):
    errors = []
    for seed in range(5):
        values = laws.stratified(law, 15_000, np.random.default_rng(seed))
        for n, share_of_noise in ((100, 0.6), (1000, 0.25), (10_000, 0.1)):
            error, noise = error_and_noise(law, values[:n])
            assert error < share_of_noise * noise
        errors.append(error_and_noise(law, values)[0])
    # 0.05 %, and what the 0.1 % outside an unbounded law's support may add
    assert np.median(errors) < 5e-4
    assert np.max(errors) < 7e-4


@pytest.mark.parametrize("law", [laws.Uniform(0.5, 2.0), laws.Lognormal(1.3, 0.4)])
def test_a_stratified_draw_has_no_serial_correlation_to_speak_of(law):
    values = laws.stratified(law, 20_000, np.random.default_rng(5))
    centred = (values - values.mean()) / values.std()
    for lag in (1, 2, 3, 5, 10, 31, 32, 33, 64):
        # −1/(STRATA − 1) = −0.032 within a block, and four standard errors of 1/sqrt(n)
        assert abs(np.mean(centred[lag:] * centred[:-lag])) < 0.032 + 4 / np.sqrt(20_000)
    rises = np.mean(np.diff(values) > 0)
    assert rises == pytest.approx(0.5, abs=0.02)


def test_two_stratified_draws_of_one_generator_are_uncorrelated():
    correlations = []
    for seed in range(20):
        rng = np.random.default_rng(seed)
        size = laws.stratified(laws.Lognormal(1.3, 0.4), 4000, rng)
        aspect_ratio = laws.stratified(laws.Uniform(1.0, 2.0), 4000, rng)
        correlations.append(np.corrcoef(size, aspect_ratio)[0, 1])
    correlations = np.array(correlations)
    assert np.abs(correlations).max() < 4 / np.sqrt(4000)
    assert abs(correlations.mean()) < 4 / np.sqrt(4000 * 20)


def test_each_place_of_a_stratified_draw_follows_the_law_over_many_draws():
    law = laws.Uniform(0.0, 1.0)
    rng = np.random.default_rng(8)
    draws = np.array([laws.stratified(law, 70, rng) for _ in range(2000)])
    for place in (0, 1, 31, 32, 69):
        assert scipy.stats.kstest(draws[:, place], "uniform").pvalue > 1e-4


def test_a_stratified_draw_scales_with_its_law_and_repeats_with_its_seed():
    one = laws.stratified(laws.Uniform(0.5, 2.0), 100, np.random.default_rng(1))
    eight = laws.stratified(laws.Uniform(4.0, 16.0), 100, np.random.default_rng(1))
    assert np.array_equal(one * 8, eight)
    assert laws.stratified(laws.Uniform(0.5, 2.0), 0, np.random.default_rng(1)).shape == (0,)


IMPOSSIBLE = [
    (lambda: laws.Uniform(2.0, 1.0), "less than maximum"),
    (lambda: laws.Uniform(float("nan"), 1.0), "finite"),
    (lambda: laws.Normal(1.0, 0.0), "standard_deviation is 0"),
    (lambda: laws.Normal(1.0, float("inf")), "finite"),
    (lambda: laws.Normal(1.0, 0.1, minimum=2.0, maximum=2.0), "less than maximum"),
    (lambda: laws.Normal(0.0, 1.0, minimum=9.0), "of the law, but must hold at least"),
    (lambda: laws.Lognormal(-1.0, 0.3), "median"),
    (lambda: laws.Lognormal(1.0, 0.3, maximum=-1.0), "of the law, but must hold at least"),
    (lambda: laws.Weibull(0.0, 1.0), "shape"),
    (lambda: laws.Gamma(1.0, -1.0), "scale"),
    (lambda: laws.Beta(0.0, 1.0, 0.0, 1.0), "alpha"),
    (lambda: laws.Constant(float("nan")), "finite"),
    (lambda: laws.Histogram((0, 1, 1), (1, 1)), "increase"),
    (lambda: laws.Histogram((0, 1, 2), (1, -1)), "negative"),
    (lambda: laws.Histogram((0, 1, 2), (0, 0)), "positive"),
    (lambda: laws.Histogram((0, 1, 2), (1,)), "one edge more"),
    (lambda: laws.Histogram((0, float("nan"), 2), (1, 1)), "finite"),
    (lambda: laws.GradingCurve((1, 2, 3), (0, 60, 50)), "never fall"),
    (lambda: laws.GradingCurve((1, 2, 3), (5, 60, 100)), "from 0"),
    (lambda: laws.GradingCurve((1, 2, 3), (0, 60, 90)), "to 100"),
    (lambda: laws.GradingCurve((0, 2, 3), (0, 60, 100)), "greater than 0"),
    (lambda: laws.GradingCurve((2, 1, 3), (0, 60, 100)), "increase"),
    (lambda: laws.GradingCurve((1, 2), (0, 60, 100)), "as many"),
]


@pytest.mark.parametrize(("make", "told"), IMPOSSIBLE)
def test_impossible_laws_are_refused(make, told):
    with pytest.raises(InputError, match=told):
        make()


@pytest.mark.parametrize(
    ("law", "quantity", "told"),
    [
        (laws.Constant(0.0), "size", "greater than 0"),
        (laws.Uniform(0.0, 1.0), "size", "greater than 0"),
        (laws.Normal(5.0, 1.0), "size", "greater than 0"),
        (laws.Uniform(0.9, 2.0), "aspect_ratio", "at least 1"),
        (laws.Normal(1.5, 0.1), "aspect_ratio", "at least 1"),
        (laws.Uniform(0.5, 1.1), "circularity", "at most 1"),
        (laws.Uniform(-0.5, 1.0), "regularity", "at least 0"),
        (laws.Uniform(0.0, 181.0), "orientation", "spans 181"),
        (laws.Normal(90.0, 60.0), "orientation", "at most"),
    ],
)
def test_laws_that_a_quantity_cannot_follow_are_refused(law, quantity, told):
    with pytest.raises(InputError, match=told):
        laws.require_possible(law, quantity)


def test_laws_that_a_quantity_can_follow_pass():
    laws.require_possible(laws.Lognormal(1.0, 0.3), "size")
    laws.require_possible(laws.Normal(1.5, 0.3, minimum=1.0), "aspect_ratio")
    laws.require_possible(laws.Uniform(-90.0, 90.0), "orientation")
    laws.require_possible(laws.Normal(90.0, 20.0), "orientation")
