"""From a scene and its packing to what was placed, compared with what was prescribed."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from grainfront.laws import Law
from grainfront.scene import Scene

if TYPE_CHECKING:
    from grainfront.from_scene.regions import RegionLaws
    from grainfront.particles import Packing
    from grainfront.shapes.database import ShapeDatabase
    from grainfront.statistics import PackingStatistics
    from grainfront.statistics.regions import Bins, RegionStatistics


def measure(scene: Scene, database: ShapeDatabase, packing: Packing) -> PackingStatistics:
    """Measure fractions, contacts and segregation, and compare what was placed with the laws.

    With an arrangement, the particles of each region are compared with its own laws too. Raises
    InputError for a packing without particles.
    """
    from grainfront import statistics

    laws = {
        name: (_values(name, database, packing), *law.bins(statistics.N_BIN))
        for name, law in _laws_of(scene).items()
    }
    measured = statistics.measure(packing, laws)
    if scene.arrangement is None:
        return measured
    return dataclasses.replace(measured, regions=_measure_regions(scene, database, packing))


def _laws_of(laws: Scene | RegionLaws) -> dict[str, Law]:
    """The laws by the names of what they are prescribed for."""
    matched = {} if laws.matched is None else {laws.matched[0]: laws.matched[1]}
    return {"size": laws.size, **matched, "orientation": laws.orientation}


def _values(name: str, database: ShapeDatabase, packing: Packing) -> np.ndarray:
    if name in ("size", "orientation"):
        return getattr(packing, name)
    return database.descriptors[name][packing.shape]


def _measure_regions(scene: Scene, database: ShapeDatabase, packing: Packing) -> RegionStatistics:
    """Where the centres lie, and the laws that hold there.

    The law of a graded region is that of its strata, each as often as it has particles.
    """
    from grainfront.arrangement.build import assign
    from grainfront.from_scene import regions
    from grainfront.statistics.regions import measure_regions

    plan = regions.plan(scene)
    found = assign(plan.regions, packing.x, packing.y)
    rest = len(plan.laws) - 1
    stratum = np.where(found.stratum < 0, rest, found.stratum)
    count = np.bincount(stratum, minlength=len(plan.laws))
    laws = plan.laws if plan.parting is None else _parted_as_placed(scene, plan.laws, count)
    region = np.array([law.region for law in laws])
    area = np.bincount(region, [law.area for law in laws])
    bins = []
    for number in range(area.size):
        here = np.flatnonzero(region == number).tolist()
        inside = region[stratum] == number
        bins.append(_bins_of([laws[i] for i in here], count[here], inside, database, packing))
    return measure_regions(packing, found.region, area, bins, _forced(scene, laws, count))


def _parted_as_placed(
    scene: Scene, laws: Sequence[RegionLaws], count: np.ndarray
) -> Sequence[RegionLaws]:
    """The laws, that of the sizes parted where the finer particles placed leave off."""
    from grainfront.from_scene import regions

    part = [law.part for law in laws]
    coarser, finer = (
        sum(n for n, p in zip(count.tolist(), part, strict=True) if p == which)
        for which in (regions.COARSER, regions.FINER)
    )
    if not (coarser and finer):
        return laws
    critical = float(scene.size.quantile(finer / (finer + coarser)))
    return regions.parted(scene, laws, critical)


def _bins_of(
    laws: Sequence[RegionLaws],
    count: np.ndarray,
    inside: np.ndarray,
    database: ShapeDatabase,
    packing: Packing,
) -> dict[str, Bins]:
    """What was placed in a region and the bins of its laws, those of the strata taken together."""
    from grainfront.statistics import N_BIN

    bins = {}
    for name in _laws_of(laws[0]):
        each = [_laws_of(law)[name] for law in laws]
        values = _values(name, database, packing)[inside]
        if name == "orientation":
            values, edges = np.mod(values, 180.0), np.linspace(0.0, 180.0, N_BIN + 1)
        else:
            supports = np.array([law.support for law in each])
            edges = np.linspace(supports[:, 0].min(), supports[:, 1].max(), N_BIN + 1)
        if count.any():
            bins[name] = (values, edges, _mixed(name, each, count / count.sum(), edges))
    return bins


def _mixed(name: str, laws: Sequence[Law], weights: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Probabilities of the bins of a mixture of laws; orientations count modulo 180°."""
    probabilities = np.zeros(edges.size - 1)
    for law, weight in zip(laws, weights, strict=True):
        turns = [0.0]
        if name == "orientation":
            low, high = np.floor(np.array(law.support) / 180.0)
            turns = (180.0 * np.arange(low - 1.0, high + 2.0)).tolist()
        for turn in turns:
            # bins hold their lower edge and not their upper one, but for the last
            below = law.cdf(np.nextafter(edges + turn, -np.inf))
            if name != "orientation":
                below[-1] = law.cdf(edges[-1])
            probabilities += weight * np.diff(below)
    return probabilities


def _forced(scene: Scene, laws: Sequence[RegionLaws], count: np.ndarray) -> dict[str, float]:
    """The L2 distribution error that the shares placed of each law leave, if each is followed."""
    from grainfront.statistics import N_BIN

    forced = {}
    for name, law in _laws_of(scene).items():
        edges, _ = law.bins(N_BIN)
        if name == "orientation":
            edges = np.linspace(0.0, 180.0, N_BIN + 1)
        each = [_laws_of(one)[name] for one in laws]
        mixed = _mixed(name, each, count / count.sum(), edges)
        forced[name] = float(np.linalg.norm(mixed - _mixed(name, [law], np.ones(1), edges)))
    return forced
