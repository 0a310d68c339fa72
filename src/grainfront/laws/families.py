"""The usual families of laws; each but the bounded ones may be truncated.

Distribution functions and their inverses are those of `scipy.special`, which costs a fifth of the
start of `scipy.stats`; it is imported when a law first needs it.
"""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from grainfront.laws.law import Law, require, require_finite, require_positive

# A truncated law keeps at least this share of the whole: its quantiles are found from
# probabilities rounded to 2^-53, so that a smaller share would leave fewer than 7 digits of them.
LEAST_SHARE_KEPT = 1e-9


def require_kept(below: float, up_to: float, minimum: float | None, maximum: float | None) -> None:
    """Raise InputError where a range keeps next to nothing of a law.

    `below` and `up_to` are the shares of the law below the range's minimum and up to its maximum.
    """
    lower = -np.inf if minimum is None else minimum
    upper = np.inf if maximum is None else maximum
    require(
        up_to - below >= LEAST_SHARE_KEPT,
        f"the range from {lower:g} to {upper:g} holds {max(up_to - below, 0.0):.1g} of the "
        f"law, but must hold at least {LEAST_SHARE_KEPT:g}",
    )


def share_of_whole(u: np.ndarray, below: float, up_to: float) -> np.ndarray:
    """The shares of the whole law that are the shares `u` of what a range keeps of it.

    Rounding must not make 1 of less than 1, where a law without a maximum has no finite value.
    """
    share = below + u * (up_to - below)
    return np.where(u < 1.0, np.minimum(share, np.nextafter(1.0, 0.0)), share)


@dataclass(frozen=True, kw_only=True)
class TruncatedLaw(Law):
    """A family truncated to [`minimum`, `maximum`]; an end that is None stays as the family has it.

    Truncation cuts and renormalises: it is the law of the whole on condition that the value lies
    within. Raises InputError where next to nothing of the family lies there.
    """

    minimum: float | None = None
    maximum: float | None = None

    @abstractmethod
    def _whole_cdf(self, x: np.ndarray) -> np.ndarray:
        """Distribution function of the family before truncation."""

    @abstractmethod
    def _whole_quantile(self, u: np.ndarray) -> np.ndarray:
        """Inverse distribution function of the family before truncation."""

    def _require_truncation(self) -> None:
        require_finite(minimum=self.minimum, maximum=self.maximum)
        if self.minimum is not None and self.maximum is not None:
            require(
                self.minimum < self.maximum,
                f"minimum is {self.minimum:g}, but must be less than maximum, {self.maximum:g}",
            )
        require_kept(*self._kept(), self.minimum, self.maximum)

    def _kept(self) -> tuple[float, float]:
        """Shares of the whole below the minimum and up to the maximum."""
        below = 0.0 if self.minimum is None else float(self._whole_cdf(np.asarray(self.minimum)))
        up_to = 1.0 if self.maximum is None else float(self._whole_cdf(np.asarray(self.maximum)))
        return below, up_to

    def quantile(self, u: ArrayLike) -> np.ndarray:
        u = np.asarray(u, dtype=np.float64)
        below, up_to = self._kept()
        values = self._whole_quantile(share_of_whole(u, below, up_to))
        # rounding must neither pass the ends nor miss them
        if self.minimum is not None:
            values = np.where(u <= 0.0, self.minimum, np.maximum(values, self.minimum))
        if self.maximum is not None:
            values = np.where(u >= 1.0, self.maximum, np.minimum(values, self.maximum))
        return values

    def cdf(self, x: ArrayLike) -> np.ndarray:
        below, up_to = self._kept()
        whole = self._whole_cdf(np.asarray(x, dtype=np.float64))
        return np.clip((whole - below) / (up_to - below), 0.0, 1.0)


@dataclass(frozen=True)
class Normal(TruncatedLaw):
    """Normal law of given `mean` and `standard_deviation` (both before truncation)."""

    mean: float
    standard_deviation: float

    def __post_init__(self) -> None:
        require_finite(mean=self.mean)
        require_positive(standard_deviation=self.standard_deviation)
        self._require_truncation()

    def _whole_cdf(self, x: np.ndarray) -> np.ndarray:
        from scipy.special import ndtr

        return ndtr((x - self.mean) / self.standard_deviation)

    def _whole_quantile(self, u: np.ndarray) -> np.ndarray:
        from scipy.special import ndtri

        return self.mean + self.standard_deviation * ndtri(u)


@dataclass(frozen=True)
class Lognormal(TruncatedLaw):
    """Lognormal law of given `median`; `log_standard_deviation` is that of the natural log."""

    median: float
    log_standard_deviation: float

    def __post_init__(self) -> None:
        require_positive(median=self.median, log_standard_deviation=self.log_standard_deviation)
        self._require_truncation()

    def _whole_cdf(self, x: np.ndarray) -> np.ndarray:
        from scipy.special import ndtr

        with np.errstate(divide="ignore"):
            logarithm = np.log(np.maximum(x, 0.0) / self.median)
        return ndtr(logarithm / self.log_standard_deviation)

    def _whole_quantile(self, u: np.ndarray) -> np.ndarray:
        from scipy.special import ndtri

        return self.median * np.exp(self.log_standard_deviation * ndtri(u))


@dataclass(frozen=True)
class Weibull(TruncatedLaw):
    """Weibull law of given `shape` and `scale`, starting at `location`."""

    shape: float
    scale: float
    location: float = 0.0

    def __post_init__(self) -> None:
        require_positive(shape=self.shape, scale=self.scale)
        require_finite(location=self.location)
        self._require_truncation()

    def _whole_cdf(self, x: np.ndarray) -> np.ndarray:
        reduced = np.maximum(x - self.location, 0.0) / self.scale
        return -np.expm1(-(reduced**self.shape))

    def _whole_quantile(self, u: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore"):
            return self.location + self.scale * (-np.log1p(-u)) ** (1.0 / self.shape)


@dataclass(frozen=True)
class Exponential(TruncatedLaw):
    """Exponential law of given `scale` (its mean above `location`), starting at `location`."""

    scale: float
    location: float = 0.0

    def __post_init__(self) -> None:
        require_positive(scale=self.scale)
        require_finite(location=self.location)
        self._require_truncation()

    def _whole_cdf(self, x: np.ndarray) -> np.ndarray:
        return -np.expm1(-np.maximum(x - self.location, 0.0) / self.scale)

    def _whole_quantile(self, u: np.ndarray) -> np.ndarray:
        with np.errstate(divide="ignore"):
            return self.location - self.scale * np.log1p(-u)


@dataclass(frozen=True)
class Gamma(TruncatedLaw):
    """Gamma law of given `shape` and `scale`, starting at `location`."""

    shape: float
    scale: float
    location: float = 0.0

    def __post_init__(self) -> None:
        require_positive(shape=self.shape, scale=self.scale)
        require_finite(location=self.location)
        self._require_truncation()

    def _whole_cdf(self, x: np.ndarray) -> np.ndarray:
        from scipy.special import gammainc

        return gammainc(self.shape, np.maximum(x - self.location, 0.0) / self.scale)

    def _whole_quantile(self, u: np.ndarray) -> np.ndarray:
        from scipy.special import gammaincinv

        return self.location + self.scale * gammaincinv(self.shape, u)


@dataclass(frozen=True)
class BoundedLaw(Law):
    """A law that lives on [`minimum`, `maximum`] by its definition."""

    minimum: float
    maximum: float

    def __post_init__(self) -> None:
        require_finite(minimum=self.minimum, maximum=self.maximum)
        require(
            self.minimum < self.maximum,
            f"minimum is {self.minimum:g}, but must be less than maximum, {self.maximum:g}",
        )

    def _from_unit(self, t: np.ndarray) -> np.ndarray:
        return np.minimum(self.minimum + (self.maximum - self.minimum) * t, self.maximum)

    def _to_unit(self, x: ArrayLike) -> np.ndarray:
        t = (np.asarray(x, dtype=np.float64) - self.minimum) / (self.maximum - self.minimum)
        return np.clip(t, 0.0, 1.0)


@dataclass(frozen=True)
class Uniform(BoundedLaw):
    """Uniform law on [`minimum`, `maximum`]."""

    def quantile(self, u: ArrayLike) -> np.ndarray:
        return self._from_unit(np.asarray(u, dtype=np.float64))

    def cdf(self, x: ArrayLike) -> np.ndarray:
        return self._to_unit(x)


@dataclass(frozen=True)
class Beta(BoundedLaw):
    """Beta law of given `alpha` and `beta`, stretched over [`minimum`, `maximum`]."""

    alpha: float
    beta: float

    def __post_init__(self) -> None:
        super().__post_init__()
        require_positive(alpha=self.alpha, beta=self.beta)

    def quantile(self, u: ArrayLike) -> np.ndarray:
        from scipy.special import betaincinv

        return self._from_unit(betaincinv(self.alpha, self.beta, np.asarray(u, dtype=np.float64)))

    def cdf(self, x: ArrayLike) -> np.ndarray:
        from scipy.special import betainc

        return betainc(self.alpha, self.beta, self._to_unit(x))
