"""Cases of size: wide and narrow laws.

A grading curve of two sieves is the Pareto law of exponent 2, truncated: the number of grains
larger than S falls as S⁻².
"""

from __future__ import annotations

from math import log, sqrt

from grainfront.laws import Constant, GradingCurve, Law, Lognormal, Normal, Uniform
from grainfront.studies.stability.case import SEEDS, Case, square


def lognormal(ratio: float) -> Law:
    """A lognormal law whose range of ±2 standard deviations is 1 to `ratio`, truncated to it."""
    return Lognormal(
        median=sqrt(ratio), log_standard_deviation=log(ratio) / 4.0, minimum=1.0, maximum=ratio
    )


def _domain(ratio: float, mean_square: float) -> float:
    """Side of a domain for about 1,000 particles, or of two of the largest if they are not many."""
    return max(40.0 * mean_square**0.5, min(2.0 * ratio, 150.0 * mean_square**0.5))


RATIOS = [
    Case(
        name=f"sizes 1:{ratio}, {name}",
        size=law,
        domain=square(_domain(ratio, law.moment(2))),
        seeds=2 if (name, ratio) == ("Pareto", 1000) else SEEDS,
    )
    for ratio in (10, 100, 1000)
    for name, law in (
        ("uniform", Uniform(1.0, float(ratio))),
        ("lognormal", lognormal(float(ratio))),
        ("Pareto", GradingCurve((1.0, float(ratio)), (0.0, 100.0))),
    )
]
NARROW = [
    Case(name="identical sizes", size=Constant(1.0)),
    Case(
        name="sizes within 1e-9",
        size=Normal(mean=1.0, standard_deviation=0.1, minimum=1.0, maximum=1.0 + 1e-9),
        like="identical sizes",
    ),
]
CASES = [*RATIOS, *NARROW]
