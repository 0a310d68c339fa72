"""Replacement, certificate and statistics of a packing of gravel."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

from scenes import SMALL, scene_and_shapes
from table import Spread, Table

from grainfront import api

SCENE = "river_gravel"
REPEATS = 5
T = TypeVar("T")


def tables(quick: bool) -> list[Table]:
    """One table: a row a step."""
    scene, database = scene_and_shapes(SCENE, SMALL if quick else None)
    packing, _ = api.pack(scene, database, seed=1)
    repeats = 1 if quick else REPEATS
    outlines, replacing = _timed(lambda: api.replace(packing, database), repeats)
    hulls_certified, hulls_time = _timed(lambda: api.certify(packing), repeats)
    certified, outlines_time = _timed(lambda: api.certify(outlines), repeats)
    _, measuring = _timed(lambda: api.measure(scene, database, packing), repeats)
    _, measuring_outlines = _timed(lambda: api.measure(scene, database, outlines), repeats)
    note = (
        f"{packing.x.size:,} grains of the scene {SCENE}; seconds, median (least–largest). "
        "Undecided pairs are those that floating point left to exact arithmetic."
    )
    rows = [
        ("replacement", replacing.text(), "", ""),
        ("certificate, hulls", hulls_time.text(), f"{hulls_certified.pairs_tested:,}",
         f"{hulls_certified.pairs_exact:,}"),
        ("certificate, outlines", outlines_time.text(), f"{certified.pairs_tested:,}",
         f"{certified.pairs_exact:,}"),
        ("statistics, hulls", measuring.text(), "", ""),
        ("statistics, outlines", measuring_outlines.text(), "", ""),
    ]  # fmt: skip
    return [Table("Checks", note, ("step", "seconds", "pairs tested", "undecided"), rows)]


def _timed(run: Callable[[], T], repeats: int) -> tuple[T, Spread]:
    result = run()  # compiles
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = run()
        times.append(time.perf_counter() - start)
    return result, Spread.of(times)
