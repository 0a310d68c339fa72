"""What was placed in each region of an arrangement, against the laws that hold there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from grainfront.errors import InputError
from grainfront.particles import Packing
from grainfront.statistics.distributions import Distribution, compare_with_law

Bins = tuple[np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class RegionStatistics:
    """What `measure_regions` finds, arrays of shape (n_regions + 1,), the rest of the domain last.

    A particle belongs to the region that holds its centre, with all of its area. `misplaced` is the
    share of the particles that were drawn for another region. `distributions` compare the particles
    of each region with its laws. `forced` is the L2 distribution error of the whole against the
    scene's laws that there would be if each region followed its laws exactly.
    """

    area: np.ndarray
    particles: np.ndarray
    volume_fraction: np.ndarray
    mean_size: np.ndarray
    misplaced: float
    distributions: tuple[dict[str, Distribution], ...]
    forced: dict[str, float]


def measure_regions(
    packing: Packing,
    region: np.ndarray,
    area: np.ndarray,
    laws: Sequence[Mapping[str, Bins]],
    forced: Mapping[str, float],
) -> RegionStatistics:
    """Measure the particles of each region.

    `region` (n_particles,) is where the centres lie, −1 in the rest of the domain; `area`
    (n_regions + 1,) is that of the regions, 0 where nothing is left for one. `laws` map, for each
    of them, a name to (values, edges, probabilities) of its particles. Where a region has none, its
    mean size is NaN and nothing is compared. Raises InputError where the packing was made without
    regions.
    """
    if packing.region is None:
        raise InputError("The packing was made without regions, but the scene has an arrangement.")
    # −1, the rest of the domain, comes last
    index = np.where(region < 0, area.size - 1, region)
    particles = np.bincount(index, minlength=area.size)
    solid, size = (np.bincount(index, of, area.size) for of in (packing.area, packing.size))
    return RegionStatistics(
        area=area,
        particles=particles,
        volume_fraction=np.where(area > 0.0, solid / np.where(area > 0.0, area, 1.0), np.nan),
        mean_size=np.where(particles > 0, size / np.maximum(particles, 1), np.nan),
        misplaced=float(np.mean(region != packing.region)),
        distributions=tuple(
            {name: compare_with_law(*bins) for name, bins in of_region.items()} if count else {}
            for count, of_region in zip(particles, laws, strict=True)
        ),
        forced=dict(forced),
    )
