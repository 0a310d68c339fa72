"""Prescribed laws of size, descriptors and orientation, and drawing from them with little noise."""

from grainfront.laws.families import Beta, Exponential, Gamma, Lognormal, Normal, Uniform, Weibull
from grainfront.laws.law import Law, bin_of
from grainfront.laws.limits import require_possible
from grainfront.laws.stratified import stratified
from grainfront.laws.tables import Constant, GradingCurve, Histogram
from grainfront.laws.truncated import Truncated

__all__ = [
    "Beta",
    "Constant",
    "Exponential",
    "Gamma",
    "GradingCurve",
    "Histogram",
    "Law",
    "Lognormal",
    "Normal",
    "Truncated",
    "Uniform",
    "Weibull",
    "bin_of",
    "require_possible",
    "stratified",
]
