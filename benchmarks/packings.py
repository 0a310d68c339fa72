"""The packings of the project's scenes: speed, density, and how well the laws are kept."""

from __future__ import annotations

from typing import NamedTuple

from scenes import SMALL, scene_and_shapes
from table import Spread, Table

from grainfront import api
from grainfront.certificate import Certificate
from grainfront.packing.pack import RunTime
from grainfront.statistics import PackingStatistics

SCENES = ("afm_rectangles", "oafm_rectangles", "river_gravel")
SEEDS = 5


class Run(NamedTuple):
    """One packing of a scene."""

    time: RunTime
    statistics: PackingStatistics
    certificate: Certificate


def tables(quick: bool) -> list[Table]:
    """Speed and density; prescribed against placed."""
    runs = {name: _runs(name, quick) for name in SCENES}
    return [
        Table(
            "Packings",
            "Hulls of each scene, one packing for each of several seeds: median (least–largest). "
            "Time is that of the kernel. Overlaps and crossings by the exact certificate, all "
            "seeds together.",
            ("scene", "grains", "seconds", "grains/s", "φ", "φ bulk", "Z", "left over",
             "overlaps", "across a wall"),
            [_density(name, runs[name]) for name in SCENES],
        ),
        Table(
            "Laws kept",
            "L2 distribution error E2 (24 bins) in percent, and beside it the level of independent "
            "sampling. One packing for each of several seeds: median (least–largest).",
            ("scene", "law", "E2 (%)", "noise level (%)"),
            [row for name in SCENES for row in _laws(name, runs[name])],
        ),
    ]  # fmt: skip


def _runs(name: str, quick: bool) -> list[Run]:
    api.pack(*scene_and_shapes(name, SMALL), seed=0)  # compiles
    scene, database = scene_and_shapes(name, SMALL if quick else None)
    runs = []
    for seed in range(1, 2 if quick else 1 + SEEDS):
        packing, time = api.pack(scene, database, seed)
        runs.append(Run(time, api.measure(scene, database, packing), api.certify(packing)))
    return runs


def _density(name: str, runs: list[Run]) -> tuple[str, ...]:
    measured = [run.statistics for run in runs]
    return (
        name,
        Spread.of(s.particles for s in measured).text(",.0f"),
        Spread.of(run.time.kernel_s for run in runs).text(".3g"),
        Spread.of(run.statistics.particles / run.time.kernel_s for run in runs).text(",.0f"),
        Spread.of(s.volume_fraction for s in measured).text(".4f"),
        Spread.of(s.volume_fraction_bulk for s in measured).text(".4f"),
        Spread.of(s.coordination_number for s in measured).text(".3f"),
        Spread.of(s.left_over for s in measured).text(".0f"),
        str(sum(run.certificate.overlaps for run in runs)),
        str(sum(run.certificate.across_wall for run in runs)),
    )


def _laws(name: str, runs: list[Run]) -> list[tuple[str, ...]]:
    rows = []
    for law in runs[0].statistics.distributions:
        compared = [run.statistics.distributions[law] for run in runs]
        error = Spread.of(100 * d.l2_error for d in compared)
        noise = Spread.of(100 * d.noise_level for d in compared)
        rows.append((name, law, error.text(".3f"), f"{noise.median:.2f}"))
    return rows
