"""Laws given by numbers: a single value, a histogram, a grading curve from sieves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from grainfront.laws.law import Law, require, require_finite


@dataclass(frozen=True)
class Constant(Law):
    """Every particle has the same `value`."""

    value: float

    def __post_init__(self) -> None:
        require_finite(value=self.value)

    def quantile(self, u: ArrayLike) -> np.ndarray:
        return np.full(np.shape(u), float(self.value))

    def cdf(self, x: ArrayLike) -> np.ndarray:
        return np.where(np.asarray(x) >= self.value, 1.0, 0.0)


@dataclass(frozen=True)
class Histogram(Law):
    """Numbers of particles in adjoining bins; within a bin every value is equally likely.

    `edges` (n + 1) increase, `counts` (n) are not negative (they need not add up to 1). Empty bins
    at either end lie outside the support.
    """

    edges: tuple[float, ...]
    counts: tuple[float, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "edges", tuple(map(float, self.edges)))
        object.__setattr__(self, "counts", tuple(map(float, self.counts)))
        require(
            len(self.edges) == len(self.counts) + 1 and len(self.counts) > 0,
            f"there are {len(self.edges)} edges and {len(self.counts)} counts, but there must be "
            "one edge more than counts, and one count at least",
        )
        _require_increasing("edges", self.edges)
        require(
            np.isfinite(self.counts).all() and min(self.counts) >= 0 and max(self.counts) > 0,
            "counts must be finite, none negative, and one at least positive, but are "
            f"{_listed(self.counts)}",
        )

    def _table(self) -> tuple[np.ndarray, np.ndarray]:
        """Edges from the first filled bin to the last, and the shares of the particles below."""
        return _cumulative(np.array(self.edges), np.array(self.counts))

    def quantile(self, u: ArrayLike) -> np.ndarray:
        edges, below = self._table()
        return np.interp(np.asarray(u), below, edges)

    def cdf(self, x: ArrayLike) -> np.ndarray:
        edges, below = self._table()
        return np.interp(np.asarray(x), edges, below)


@dataclass(frozen=True)
class GradingCurve(Law):
    """Sizes by mass as sieves give them, turned into a law by number.

    `sieve_sizes` increase (a grain passes a sieve as wide as its size S); `percent_passing`, of
    the mass, rises from 0 at the first sieve to 100 at the last. Between two sieves the curve is
    a straight line over the logarithm of the size, as grading curves are drawn: the mass per size
    is m(S) = c / S. In two dimensions the mass of a grain is its area, and as the shape is drawn
    independently of the size, its mean is proportional to S². Hence the number per size is
    n(S) = m(S) / S² = c / S³, and the number between the sieves a < b that hold the mass M is
    proportional to M · (a⁻² − b⁻²) / (2 ln(b / a)). Laws in two dimensions therefore hold more
    large grains than the grading of a sample in three would (mass ∝ S³) for the same curve.
    """

    sieve_sizes: tuple[float, ...]
    percent_passing: tuple[float, ...]

    def __post_init__(self) -> None:
        sizes = tuple(map(float, self.sieve_sizes))
        passing = tuple(map(float, self.percent_passing))
        object.__setattr__(self, "sieve_sizes", sizes)
        object.__setattr__(self, "percent_passing", passing)
        require(
            len(sizes) == len(passing) >= 2,
            f"there are {len(sizes)} sieve_sizes and {len(passing)} percent_passing, but there "
            "must be as many of both, and two at least",
        )
        _require_increasing("sieve_sizes", sizes)
        require(sizes[0] > 0, f"sieve_sizes start at {sizes[0]:g}, but must be greater than 0")
        require(
            np.isfinite(passing).all() and bool(np.all(np.diff(passing) >= 0)),
            f"percent_passing must never fall with the sieve size, but is {_listed(passing)}",
        )
        require(
            passing[0] == 0 and passing[-1] == 100,
            f"percent_passing must go from 0 at the first sieve to 100 at the last, but goes from "
            f"{passing[0]:g} to {passing[-1]:g}",
        )

    def _table(self) -> tuple[np.ndarray, np.ndarray]:
        """Sizes from the first filled interval to the last, and the number shares below them."""
        sizes = np.array(self.sieve_sizes)
        number = (
            np.diff(self.percent_passing) * -np.diff(sizes**-2.0) / (2 * np.diff(np.log(sizes)))
        )
        return _cumulative(sizes, number)

    def quantile(self, u: ArrayLike) -> np.ndarray:
        sizes, below = self._table()
        # within an interval the number is linear in S⁻², see above
        return np.clip(np.interp(np.asarray(u), below, sizes**-2.0) ** -0.5, sizes[0], sizes[-1])

    def cdf(self, x: ArrayLike) -> np.ndarray:
        sizes, below = self._table()
        inside = np.clip(np.asarray(x, dtype=np.float64), sizes[0], sizes[-1])
        return np.interp(-(inside**-2.0), -(sizes**-2.0), below)


def _cumulative(edges: np.ndarray, counts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges (n + 1,) without empty bins at the ends, and the shares below them."""
    filled = np.flatnonzero(counts)
    first, last = filled[0], filled[-1] + 1
    below = np.concatenate([[0.0], np.cumsum(counts[first:last])])
    return edges[first : last + 1], below / below[-1]


def _require_increasing(name: str, values: tuple[float, ...]) -> None:
    require(
        np.isfinite(values).all() and bool(np.all(np.diff(values) > 0)),
        f"{name} must be finite and increase from each to the next, but are {_listed(values)}",
    )


def _listed(values: tuple[float, ...]) -> str:
    return "[" + ", ".join(f"{v:g}" for v in values) + "]"
