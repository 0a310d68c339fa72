"""Regions: where which laws hold, as data."""

from __future__ import annotations

from dataclasses import dataclass

from grainfront.arrangement.zones import Point, Zone, files_of
from grainfront.laws import Law


@dataclass(frozen=True)
class LocalLaws:
    """Laws that take the place of the scene's; None leaves the scene's."""

    size: Law | None = None
    matched: tuple[str, Law] | None = None
    orientation: Law | None = None


@dataclass(frozen=True)
class GradedAlong:
    """Strata at right angles to the way from the point `start` to the point `end`."""

    start: Point
    end: Point


@dataclass(frozen=True)
class GradedByDistance:
    """Strata between two signed distances to the region's boundary, from `start` to `end`."""

    start: float
    end: float


Grade = GradedAlong | GradedByDistance


@dataclass(frozen=True)
class Region:
    """A zone and the laws that hold in it.

    `inside` is None for all of the plane. `strata` holds the laws of equal steps of the grade, from
    its start to its end and constant beyond, or those of the whole region alone. `finer` tells that
    the region takes the finer (True) or the coarser (False) part of the scene's size law, and what
    lies in no such region the other part (paper, section 4.2).
    """

    inside: Zone | None
    strata: tuple[LocalLaws, ...]
    grade: Grade | None = None
    finer: bool | None = None


@dataclass(frozen=True)
class Arrangement:
    """Regions, of which the first that holds a particle's centre decides its laws.

    `critical_size` parts the scene's size law where a region takes a part of it; None where it is
    to follow from the areas of the regions.
    """

    regions: tuple[Region, ...]
    critical_size: float | None = None

    @property
    def files(self) -> set[str]:
        """The images and files of the user's own that zones come from."""
        zones = (region.inside for region in self.regions if region.inside is not None)
        return set().union(*map(files_of, zones))
