"""Any law cut to a range: against the law itself and against the families' own truncation."""

import numpy as np
import pytest

from grainfront.errors import InputError
from grainfront.laws import Constant, GradingCurve, Lognormal, Normal, Truncated, Uniform

U = np.linspace(0.0, 1.0, 41)


def test_it_is_the_truncation_of_the_families():
    family = {"median": 2.0, "log_standard_deviation": 0.5}
    cut, own = Truncated(Lognormal(**family), 1.5, 3.0), Lognormal(**family, minimum=1.5, maximum=3)
    assert cut.quantile(U) == pytest.approx(own.quantile(U), rel=1e-12)
    x = np.linspace(1.0, 3.5, 50)
    assert cut.cdf(x) == pytest.approx(own.cdf(x), rel=1e-12)
    assert cut.support == pytest.approx((1.5, 3.0), rel=1e-12)


def test_a_range_wider_than_the_law_leaves_it():
    law = Uniform(1.0, 2.0)
    cut = Truncated(law, 0.5, 5.0)
    assert np.array_equal(cut.quantile(U), law.quantile(U)) and cut.support == law.support


@pytest.mark.parametrize("law", [Uniform(1.0, 2.0), GradingCurve((1, 1.4, 2), (0, 30, 100))])
def test_finer_and_coarser_part_make_the_whole(law):
    share = float(law.cdf(1.3))
    finer, coarser = Truncated(law, None, 1.3), Truncated(law, 1.3, None)
    x = np.linspace(0.9, 2.1, 60)
    assert share * finer.cdf(x) + (1 - share) * coarser.cdf(x) == pytest.approx(law.cdf(x))
    assert finer.quantile(1.0) == pytest.approx(1.3) and coarser.quantile(0.0) == pytest.approx(1.3)


def test_a_single_value_at_the_minimum_is_kept():
    assert Truncated(Constant(1.0), 1.0, 2.0).quantile(0.5) == 1.0


def test_an_empty_range_is_refused():
    with pytest.raises(InputError, match="from 3 to inf holds 0 of the law"):
        Truncated(Uniform(1.0, 2.0), 3.0)
    with pytest.raises(InputError, match="holds 0 of the law"):
        Truncated(Uniform(1.0, 2.0), 1.8, 1.2)


@pytest.mark.parametrize(
    "law",
    [
        Normal(mean=1.0, standard_deviation=0.5, minimum=0.2),
        Lognormal(median=1.0, log_standard_deviation=0.5, minimum=0.2),
        Truncated(Normal(mean=1.0, standard_deviation=0.5), minimum=0.2),
    ],
)
def test_shares_below_one_have_finite_values(law):
    assert np.isfinite(law.quantile(np.nextafter(1.0, 0.0)))
