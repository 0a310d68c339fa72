"""Compiling the kernels: the first time, and from the cache.

Each is measured in a process of its own: `python compilation.py` prints the seconds as JSON.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable

from table import Spread, Table

REPEATS = 3


def tables(quick: bool) -> list[Table]:
    """One table: a row a stage. A quick run uses the cache that there is."""
    columns = {"from the cache": _measurements(None, 1)} if quick else _cold_and_cached()
    first = next(iter(columns.values()))
    rows = [
        (stage, *(Spread.of(run[stage] for run in runs).text(".2f") for runs in columns.values()))
        for stage in first[0]
    ]
    note = (
        "Seconds that the first call of each stage takes beyond the second, in a new process: "
        "median (least–largest) where repeated. All kernels: what the scene river_gravel needs; "
        "the plain advancing front has a kernel of its own."
    )
    return [Table("Compilation", note, ("stage", *columns), rows)]


def _cold_and_cached() -> dict[str, list[dict[str, float]]]:
    with tempfile.TemporaryDirectory() as folder:
        return {
            "first time": _measurements(folder, 1),
            "from the cache": _measurements(folder, REPEATS),
        }


def _measurements(cache: str | None, repeats: int) -> list[dict[str, float]]:
    environment = os.environ if cache is None else os.environ | {"GRAINFRONT_CACHE": cache}
    return [
        json.loads(
            subprocess.run(
                [sys.executable, __file__], env=environment, check=True, stdout=subprocess.PIPE
            ).stdout
        )
        for _ in range(repeats)
    ]


def _measure() -> dict[str, float]:
    start = time.perf_counter()
    from scenes import SMALL, scene_and_shapes

    from grainfront import api

    gravel = scene, database = scene_and_shapes("river_gravel", SMALL)
    rectangles = scene_and_shapes("afm_rectangles", SMALL)
    seconds = {"imports and shapes": time.perf_counter() - start}
    seconds["packing"] = _first_call(lambda: api.pack(*gravel, seed=1))
    packing, _ = api.pack(*gravel, seed=1)
    seconds["replacement"] = _first_call(lambda: api.replace(packing, database))
    outlines = api.replace(packing, database)
    seconds["certificate"] = _first_call(
        lambda: api.certify(packing), lambda: api.certify(outlines)
    )
    seconds["statistics"] = _first_call(lambda: api.measure(scene, database, packing))
    seconds["all kernels"] = sum(seconds.values()) - seconds["imports and shapes"]
    seconds["packing, plain advancing front"] = _first_call(lambda: api.pack(*rectangles, seed=1))
    return seconds


def _first_call(*calls: Callable[[], object]) -> float:
    """Seconds that the calls take the first time beyond the second."""
    times = []
    for _ in range(2):
        start = time.perf_counter()
        for call in calls:
            call()
        times.append(time.perf_counter() - start)
    return times[0] - times[1]


if __name__ == "__main__":
    print(json.dumps(_measure()))
