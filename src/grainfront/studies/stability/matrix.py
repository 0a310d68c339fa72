"""All cases at all their efforts, beside the moderate case at the same effort."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from grainfront.studies.stability.case import MODERATE, OPTIMISED, PLAIN, Case, Effort
from grainfront.studies.stability.run import Found, run

# Volume fractions of n seeds scatter by this over the square root of the particles, or more: the
# moderate case's by 0.04 (optimised) to 0.18 (plain), with four seeds by chance by much less.
LEAST_SCATTER = 0.1
# Means that differ by more standard errors than this are different.
STANDARD_ERRORS = 5.0


@dataclass(frozen=True)
class Row:
    """A case at one effort, what was found, and what was found in the moderate case."""

    case: Case
    effort: Effort
    found: Found
    moderate: Found

    @property
    def name(self) -> str:
        """The case and its effort."""
        return f"{self.case.name} ({self.effort[0]}/{self.effort[1]})"

    @property
    def microseconds(self) -> float:
        """Kernel time a particle, of the quickest packing, in µs."""
        return 1e6 * _least_time(self.found)

    @property
    def growth(self) -> float:
        """Kernel time a particle over that of the moderate case."""
        return _least_time(self.found) / _least_time(self.moderate)

    @property
    def relative_fraction(self) -> float:
        """Mean volume fraction over that of the moderate case."""
        mean = np.mean(self.found.volume_fraction)
        return float(mean / np.mean(self.moderate.volume_fraction))

    @property
    def attempts(self) -> float:
        """Particles tried for each one placed."""
        placed = np.sum(self.found.particles)
        return float((placed + np.sum(self.found.failed)) / placed)

    @property
    def mirrored_difference(self) -> float:
        """Volume fraction of the mirror image less that of the case, means over the seeds."""
        found = self.found
        return float(np.mean(found.volume_fraction_mirrored) - np.mean(found.volume_fraction))

    @property
    def mirrored_noise(self) -> float:
        """The largest such difference that is noise."""
        found = self.found
        return noise(found, found.volume_fraction, found, found.volume_fraction_mirrored)


def noise(one: Found, fractions: np.ndarray, other: Found, others: np.ndarray) -> float:
    """The largest difference of two means of volume fractions over seeds that is noise."""
    squared = [
        max(np.var(values, ddof=1) if values.size > 1 else 0.0,
            LEAST_SCATTER**2 / np.mean(found.particles)) / values.size
        for found, values in ((one, fractions), (other, others))
    ]  # fmt: skip
    return STANDARD_ERRORS * float(np.sqrt(np.sum(squared)))


def measure(cases: Mapping[str, Case]) -> Iterator[Row]:
    """Run all cases at all their efforts; efforts but PLAIN are compared with OPTIMISED."""
    moderate: dict[Effort, Found] = {}
    for case in cases.values():
        for effort in case.efforts:
            beside = beside_effort(effort)
            if beside not in moderate:
                moderate[beside] = run(MODERATE, beside)
            found = moderate[beside] if case is MODERATE else run(case, effort)
            yield Row(case, effort, found, moderate[beside])


def beside_effort(effort: Effort) -> Effort:
    """The effort of the moderate case with which another is compared."""
    return PLAIN if effort == PLAIN else OPTIMISED


def exponents(rows: Iterable[Row]) -> dict[tuple[str, Effort], float]:
    """Powers with which kernel time a particle grows along each series of cases, at each effort.

    They are slopes of least squares of the logarithms.
    """
    points: dict[tuple[str, Effort], list[tuple[float, float]]] = {}
    for row in rows:
        if row.case.series:
            # along a series of efforts, those of its cases count as one
            key = row.case.series, beside_effort(row.effort)
            points.setdefault(key, []).append((row.case.at, row.microseconds))
    fits = {}
    for key, of_series in points.items():
        at, time = np.log(np.array(of_series)).T
        if np.unique(at).size > 1:
            fits[key] = float(np.polyfit(at, time, 1)[0])
    return fits


def _least_time(found: Found) -> float:
    return float(np.min(found.kernel_s / found.particles))
