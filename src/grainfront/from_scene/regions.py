"""From a scene with an arrangement to the laws of its regions and the particles of each law."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from grainfront.arrangement.regions import Arrangement as Regions
from grainfront.errors import InputError
from grainfront.laws import Law, Truncated
from grainfront.particles import Rectangle
from grainfront.particles import Region as Domain
from grainfront.scene import Scene

if TYPE_CHECKING:
    from grainfront.geometry.regions import RegionMap
    from grainfront.packing.size_keeper import SizeKeeper

# The parts of a size law that is parted between regions.
COARSER, FINER = 0, 1
# Points along the longer side of the domain, at which regions, areas and distances are taken.
AREA_POINTS = 500
# Points of the integral over the size law; the parting is that exact.
PARTING_POINTS = 1 << 14
# The law of points that are not in the domain.
OUTSIDE = -1
# ASSUME of the volume fraction, before there is a packing; only the first sizes depend on it.
VOLUME_FRACTION = 0.8


@dataclass(frozen=True)
class RegionLaws:
    """The laws of one stratum of a region, and the area in which they hold.

    `part` tells which part of the scene's size law it takes: FINER, COARSER, or None for all of it
    or a law of its own.
    """

    region: int
    size: Law
    matched: tuple[str, Law] | None
    orientation: Law
    part: int | None
    area: float


@dataclass(frozen=True)
class Plan:
    """What an arrangement asks of a packing: the map of its regions and the laws of each.

    Points in the middle of `rows` by `columns` cells over the domain stand for the area about them:
    `law` (rows, columns) is the law at each, OUTSIDE where it is not in the domain.
    `parting` is the probability at which the size law is parted; None where it is not, or where the
    scene gives the size itself.
    """

    regions: RegionMap
    laws: tuple[RegionLaws, ...]
    law: np.ndarray
    parting: float | None


def plan(scene: Scene) -> Plan:
    """The laws of all strata of all regions, and last of the rest of the domain.

    Raises InputError where a region's zone cannot be had or lies outside the domain, and where a
    part of the size law has no place in it.
    """
    assert scene.arrangement is not None, "there are no regions"
    regions = _region_map(scene, scene.arrangement)
    point = _laws_of_points(scene, regions)
    area = _area_of_laws(scene.domain, point, int(regions.first[-1]) + 1)
    laws = _laws(scene, scene.arrangement, area)
    if all(law.part is None for law in laws):
        return Plan(regions, laws, point, None)
    coarser, finer = (sum(law.area for law in laws if law.part == p) for p in (COARSER, FINER))
    for part, found in (("finer", finer), ("coarser", coarser)):
        if not found:
            raise InputError(
                f"{scene.name}: arrangement leaves no place in the domain for the {part} part of "
                "the sizes, but both parts must have one"
            )
    critical, parting = scene.arrangement.critical_size, None
    if critical is None:
        parting = _parting(scene.size, finer / (finer + coarser))
        critical = float(scene.size.quantile(parting))
    return Plan(regions, parted(scene, laws, critical), point, parting)


def parted(scene: Scene, laws: Sequence[RegionLaws], critical: float) -> tuple[RegionLaws, ...]:
    """The laws, those that take a part of the scene's size law with it parted at `critical`."""
    parts = Truncated(scene.size, minimum=critical), Truncated(scene.size, maximum=critical)
    return tuple(
        law if law.part is None else dataclasses.replace(law, size=parts[law.part]) for law in laws
    )


def keeper(
    scene: Scene, found: Plan, last: np.ndarray, size: np.ndarray, hull_area: float
) -> SizeKeeper | None:
    """What keeps the size law of the whole; None where it is not parted as areas ask.

    `size` (n,) are those of the particles, one law's after the other's, `last` (n_laws,) where each
    ends; `hull_area` is the mean of size 1.
    """
    from grainfront.packing.size_keeper import NO_PART, Columns, SizeKeeper

    if found.parting is None:
        return None
    parts = np.split(size, last[:-1])
    level = [law.size.cdf(one) for law, one in zip(found.laws, parts, strict=True)]
    part = np.array([NO_PART if law.part is None else law.part for law in found.laws])
    x, height, area = _area_below(scene.domain, found.law, part)
    solid = VOLUME_FRACTION * area[:, -1].sum()
    particles = solid / (hull_area * scene.size.moment(2))
    share = np.array([1.0 - found.parting, found.parting])
    return SizeKeeper(
        scene.size.quantile,
        part,
        np.concatenate(level),
        Columns(x, height, area),
        particles * share / area[:, -1].sum(axis=1),
    )


def distances(scene: Scene) -> dict[int, np.ndarray]:
    """Signed distances over the domain to the zone of each region that has one, by its number.

    Their shape is (rows, columns), the first row at the bottom, first and last values on the walls.
    """
    from grainfront.arrangement.build import resolve_regions
    from grainfront.arrangement.fields import distance_at, signed_distances

    assert scene.arrangement is not None, "there are no regions"
    resolved, domain = resolve_regions(scene.arrangement, scene.domain), scene.domain
    step = max(domain.width, domain.height) / AREA_POINTS
    columns, rows = (max(round(side / step), 1) for side in (domain.width, domain.height))
    x, y = np.meshgrid(
        np.linspace(domain.x_min, domain.x_max, columns + 1),
        np.linspace(domain.y_min, domain.y_max, rows + 1),
    )
    zones = [n for n, region in enumerate(scene.arrangement.regions) if region.inside is not None]
    # zone by zone, as the grid of many needs much memory
    return {n: distance_at(signed_distances([resolved[n]], domain), 0, x, y) for n in zones}


def _laws(scene: Scene, arrangement: Regions, area: np.ndarray) -> tuple[RegionLaws, ...]:
    """The laws of all strata and of the rest, the size law not parted yet."""
    asked = [region.finer for region in arrangement.regions if region.finer is not None]
    part_of_rest = (FINER, COARSER)[asked[0]] if asked else None
    found: list[RegionLaws] = []
    for number, region in enumerate(arrangement.regions):
        part = part_of_rest if region.finer is None else (COARSER, FINER)[region.finer]
        for local in region.strata:
            found.append(
                RegionLaws(
                    number,
                    local.size or scene.size,
                    local.matched or scene.matched,
                    local.orientation or scene.orientation,
                    part if local.size is None else None,
                    float(area[len(found)]),
                )
            )
    rest = RegionLaws(
        len(arrangement.regions),
        scene.size,
        scene.matched,
        scene.orientation,
        part_of_rest,
        float(area[-1]),
    )
    return (*found, rest)


def _region_map(scene: Scene, arrangement: Regions) -> RegionMap:
    """The map of the regions; InputError that names the scene where there cannot be one."""
    from grainfront.arrangement.build import region_map

    try:
        return region_map(arrangement, scene.domain)
    except InputError as error:
        raise InputError(f"{scene.name}: {error}") from None


def _laws_of_points(scene: Scene, regions: RegionMap) -> np.ndarray:
    """The law at points over the domain, shape (rows, columns), the first row at the bottom."""
    from grainfront.arrangement.build import assign

    domain = scene.domain
    step = max(domain.width, domain.height) / AREA_POINTS
    columns, rows = (max(round(side / step), 1) for side in (domain.width, domain.height))
    x = domain.x_min + domain.width * (np.arange(columns) + 0.5) / columns
    y = domain.y_min + domain.height * (np.arange(rows) + 0.5) / rows
    stratum = assign(regions, x[None, :], y[:, None]).stratum
    law = np.where(stratum < 0, int(regions.first[-1]), stratum)
    if isinstance(domain, Domain):
        law[~domain.holds(*np.meshgrid(x, y))] = OUTSIDE
    return law


def _area_of_laws(domain: Rectangle, law: np.ndarray, n_laws: int) -> np.ndarray:
    """The area of each law, counted in points column by column."""
    column = np.broadcast_to(np.arange(law.shape[1]), law.shape)
    held = law != OUTSIDE
    index = law[held] * law.shape[1] + column[held]
    count = np.bincount(index, minlength=n_laws * law.shape[1]).reshape(n_laws, -1)
    return (count * (domain.width * domain.height) / law.size).sum(axis=1)


def _area_below(
    domain: Rectangle, law: np.ndarray, part: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Middles of columns, heights, and the area of both parts below them, (2, rows + 1, columns).

    `part` (n_laws,) is that of each law.
    """
    rows, columns = law.shape
    x = domain.x_min + domain.width * (np.arange(columns) + 0.5) / columns
    height = domain.y_min + domain.height * np.arange(rows + 1) / rows
    here = np.where(law == OUTSIDE, OUTSIDE, part[law])
    count = np.array([np.cumsum(here == p, axis=0) for p in (COARSER, FINER)])
    below = np.concatenate([np.zeros((2, 1, columns)), count], axis=1)
    return x, height, below * (domain.width * domain.height) / (rows * columns)


def _parting(size: Law, finer_share: float) -> float:
    """The probability at which a size law is parted between finer and coarser regions.

    Finer particles take up as large a share of the solid as their regions of the area, if both are
    filled alike.
    """
    u = (np.arange(PARTING_POINTS) + 0.5) / PARTING_POINTS
    solid = np.concatenate([[0.0], np.cumsum(size.quantile(u) ** 2)])
    return float(np.interp(finer_share * solid[-1], solid, np.linspace(0.0, 1.0, solid.size)))
