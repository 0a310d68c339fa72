"""Whether large and small particles went to different places."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from grainfront.particles import Cell, Packing, Region


@dataclass(frozen=True)
class SizeCorrelation:
    """Pearson's r of the size S with the position of the centre.

    `x` and `y` are along the axes, `centre` is with the distance to the middle of the domain, of
    one of any shape to its centroid; along an axis that repeats itself, there is no middle and
    nothing to be correlated with: NaN.
    `noise_level` is the standard deviation 1/sqrt(N) of r where size and place are independent.
    They are 0 where the sizes do not vary.
    """

    x: float
    y: float
    centre: float
    noise_level: float


def size_correlation(packing: Packing) -> SizeCorrelation:
    """Correlate the sizes with the positions, a check against segregation.

    Large particles cannot have their centres near a wall, so that in small domains `centre` is a
    little negative without any segregation.
    """
    domain = packing.domain
    x, y = 0.5 * (domain.x_min + domain.x_max), 0.5 * (domain.y_min + domain.y_max)
    if isinstance(domain, Region):
        ((x, y),) = shapely.get_coordinates(shapely.centroid(domain.to_shapely())).tolist()
    to_centre = np.hypot(packing.x - x, packing.y - y)
    repeats = isinstance(domain, Cell)
    repeats_along_y = isinstance(domain, Cell) and domain.along_y
    return SizeCorrelation(
        x=np.nan if repeats else _pearson(packing.size, packing.x),
        y=np.nan if repeats_along_y else _pearson(packing.size, packing.y),
        centre=np.nan if repeats else _pearson(packing.size, to_centre),
        noise_level=float(1.0 / np.sqrt(packing.size.size)),
    )


def _pearson(a: np.ndarray, b: np.ndarray) -> float:
    if np.ptp(a) == 0.0 or np.ptp(b) == 0.0:
        return 0.0
    return float(np.corrcoef(a, b)[0, 1])
