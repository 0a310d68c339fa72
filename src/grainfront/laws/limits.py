"""What the values of a law may be, by the quantity that it prescribes."""

from __future__ import annotations

import numpy as np

from grainfront.laws.law import Law, require

LIMITS: dict[str, tuple[float, float]] = {
    "size": (0.0, np.inf),
    "aspect_ratio": (1.0, np.inf),
    "circularity": (0.0, 1.0),
    "regularity": (0.0, np.inf),
    "orientation": (-360.0, 360.0),
}
# An orientation names a line, so a range wider than this would name some lines twice.
WIDEST_ORIENTATION_RANGE = 180.0


def require_possible(law: Law, quantity: str) -> None:
    """Raise InputError where `law` yields values that `quantity` (a key of LIMITS) cannot have.

    Sizes are greater than 0, aspect ratios at least 1, circularities within [0, 1], regularities
    at least 0 (Mollon & Zhao 2012); orientations, in degrees, span 180 at most.
    """
    lowest, highest = LIMITS[quantity]
    lower, upper = law.quantile([0.0, 1.0])
    if quantity == "orientation":  # its tails wrap round, so the central 99.9 % decides
        lower, upper = law.support
        require(
            upper - lower <= WIDEST_ORIENTATION_RANGE,
            f"the orientation law spans {upper - lower:g} degrees, from {lower:g} to {upper:g}, "
            f"but may span {WIDEST_ORIENTATION_RANGE:g} at most",
        )
    if quantity == "size":
        require(
            lower >= 0 and law.support[0] > 0,
            f"the size law reaches down to {lower:g}, but sizes must be greater than 0",
        )
    require(
        lower >= lowest,
        f"the {quantity} law reaches down to {lower:g}, but {quantity} is at least {lowest:g}",
    )
    require(
        upper <= highest,
        f"the {quantity} law reaches up to {upper:g}, but {quantity} is at most {highest:g}",
    )
