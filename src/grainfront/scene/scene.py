"""What a scene file describes, as frozen dataclasses."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from grainfront.laws import Law
from grainfront.particles import Rectangle
from grainfront.shapes.sources import ShapeSource

if TYPE_CHECKING:
    from grainfront.arrangement.regions import Arrangement


@dataclass(frozen=True)
class PackingEffort:
    """Trial orientations, half-size of the local front, orientation bins (paper, section 4.1)."""

    n_angle: int
    n_loc: int
    n_bin: int


@dataclass(frozen=True)
class Target:
    """A volume fraction to be reached, and how far from it a packing may end."""

    volume_fraction: float
    tolerance: float


@dataclass(frozen=True)
class Sweep:
    """Packings at all pairs of these efforts, each for this many seeds (paper, Figs. 16, 18)."""

    n_angle: tuple[int, ...]
    n_loc: tuple[int, ...]
    seeds: int


@dataclass(frozen=True)
class ErrorVsTime:
    """Axes along which errors are measured against run time, with seeds and repeats of each."""

    axes: tuple[str, ...]
    seeds: int
    repeats: int


@dataclass(frozen=True)
class Scene:
    """What one packing is made of.

    Lengths are in `length_unit`, orientations in degrees. `text` is the scene file as it was read,
    `name` its name without the suffix. One packing is made for each of `seeds`. `matched` is the
    descriptor (aspect_ratio, circularity or regularity) that the choice of the shapes follows, and
    its law. `outputs` are those beyond NetCDF: "vtk", "figures".
    `arrangement` tells where other laws hold. `domain_files` are those of the user's own that the
    domain comes from.
    """

    name: str
    text: str
    length_unit: str
    seeds: tuple[int, ...]
    domain: Rectangle
    shapes: ShapeSource
    size: Law
    matched: tuple[str, Law] | None
    orientation: Law
    packing: PackingEffort
    target: Target | None = None
    sweep: Sweep | None = None
    error_vs_time: ErrorVsTime | None = None
    replacement: bool = False
    outputs: tuple[str, ...] = ()
    arrangement: Arrangement | None = None
    domain_files: tuple[str, ...] = ()

    @property
    def zone_files(self) -> tuple[str, ...]:
        """The images and files of the user's own that domain and regions come from."""
        of_regions = self.arrangement.files if self.arrangement else set()
        return tuple(sorted(of_regions.union(self.domain_files)))
