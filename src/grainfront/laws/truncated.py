"""Any law, cut to a range and renormalised."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from grainfront.laws.families import require_kept, share_of_whole
from grainfront.laws.law import Law, require_finite


@dataclass(frozen=True)
class Truncated(Law):
    """The `law` on condition that values lie within [`minimum`, `maximum`]; None leaves an end.

    Raises InputError where next to nothing of the law lies there.
    """

    law: Law
    minimum: float | None = None
    maximum: float | None = None

    def __post_init__(self) -> None:
        require_finite(minimum=self.minimum, maximum=self.maximum)
        require_kept(*self._kept(), self.minimum, self.maximum)

    def _kept(self) -> tuple[float, float]:
        """Shares of the law below the minimum and up to the maximum."""
        below = 0.0
        if self.minimum is not None:
            below = float(self.law.cdf(np.nextafter(self.minimum, -np.inf)))
        return below, 1.0 if self.maximum is None else float(self.law.cdf(self.maximum))

    def quantile(self, u: ArrayLike) -> np.ndarray:
        below, up_to = self._kept()
        values = self.law.quantile(share_of_whole(np.asarray(u, dtype=np.float64), below, up_to))
        # rounding must not pass the ends
        return np.clip(values, self.minimum, self.maximum)

    def cdf(self, x: ArrayLike) -> np.ndarray:
        below, up_to = self._kept()
        return np.clip((self.law.cdf(x) - below) / (up_to - below), 0.0, 1.0)
