"""What every law of probability offers, and the bins in which packings are compared with it."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import ArrayLike

from grainfront.errors import InputError

# The support of an unbounded law is its central 99.9 %: this share is left out at either end.
OUTSIDE_AT_EACH_END = 0.0005
# A single value meets the bin of a constant law up to rounding: a descriptor takes some hundreds
# of operations of relative error 2^-53 (1e-16), so 1e-9 is generous and still no real difference.
SAME_VALUE = 1e-9
# Midpoints of the integral over the quantiles in `moment`; the midpoint rule then errs by some
# 1e-5 for unbounded laws and far less for bounded ones.
MOMENT_POINTS = 1 << 14


class Law(ABC):
    """A law of probability, by number of particles."""

    @abstractmethod
    def quantile(self, u: ArrayLike) -> np.ndarray:
        """Values below which the shares `u` (in [0, 1]) of the particles lie; the shape of `u`."""

    @abstractmethod
    def cdf(self, x: ArrayLike) -> np.ndarray:
        """Shares of the particles at or below the values `x`; the shape of `x`."""

    @property
    def support(self) -> tuple[float, float]:
        """Finite range of the law: all of it, or the central 99.9 % where an end is unbounded."""
        lower, upper = self.quantile([0.0, 1.0])
        if not (np.isfinite(lower) and np.isfinite(upper)):
            lower, upper = self.quantile([OUTSIDE_AT_EACH_END, 1.0 - OUTSIDE_AT_EACH_END])
        return float(lower), float(upper)

    def bins(self, n: int = 24) -> tuple[np.ndarray, np.ndarray]:
        """Edges (n + 1,) of n equal bins of the support, and their probabilities (n,).

        They add up to 1, or to 0.999 where the support is the central 99.9 %: compare them with
        shares of all particles. A constant law has the single bin [value, value] of probability 1.
        """
        lower, upper = self.support
        if lower == upper:
            return np.array([lower, upper]), np.ones(1)
        edges = np.linspace(lower, upper, n + 1)
        return edges, np.diff(self.cdf(edges))

    def quantiles_within_support(self, n: int) -> np.ndarray:
        """Values, (n + 1,), below which equal shares of the particles within the support lie."""
        low, high = self.cdf(self.support)
        if self.support[0] == self.support[1]:
            low = high
        return np.clip(self.quantile(np.linspace(low, high, n + 1)), *self.support)

    def moment(self, order: float) -> float:
        """Mean of the values raised to `order`."""
        u = (np.arange(MOMENT_POINTS) + 0.5) / MOMENT_POINTS
        return float(np.mean(self.quantile(u) ** order))


def bin_of(edges: np.ndarray, values: ArrayLike) -> np.ndarray:
    """Index of the bin of each value, int64 of the shape of `values`; −1 below, n_bin above.

    `edges` (n_bin + 1,) as `Law.bins` gives them. Bins are closed below and open above, the last
    one closed on both sides; the bin of a constant law takes values that differ by rounding alone.
    """
    values = np.asarray(values, dtype=np.float64)
    edges = np.array(edges, dtype=np.float64)
    if edges[0] == edges[-1]:
        edges += np.array([-SAME_VALUE, SAME_VALUE]) * np.abs(edges)
    index = np.searchsorted(edges, values, side="right") - 1
    return np.where(values == edges[-1], edges.size - 2, index)


def require(condition: bool | np.bool_, message: str) -> None:
    """Raise InputError with `message` unless `condition` holds."""
    if not condition:
        raise InputError(message)


def require_finite(**parameters: float | None) -> None:
    """Raise InputError where a parameter of a law is NaN or infinite; None is passed over."""
    for name, value in parameters.items():
        require(value is None or np.isfinite(value), f"{name} is {value}, but must be finite")


def require_positive(**parameters: float) -> None:
    """Raise InputError where a parameter of a law is not a positive finite number."""
    require_finite(**parameters)
    for name, value in parameters.items():
        require(value > 0, f"{name} is {value:g}, but must be greater than 0")
