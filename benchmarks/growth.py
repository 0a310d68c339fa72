"""Time and memory against the number of particles: the plain advancing front, rectangles.

Each number is measured in a process of its own: `python growth.py EDGE` prints it as JSON.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
from pathlib import Path

from scenes import SMALL, scene_and_shapes
from table import Spread, Table

from grainfront import api

SCENE = "afm_rectangles"
FRACTION = 0.70  # volume fraction, to choose domains for round numbers of particles
PARTICLES = (10_000, 100_000, 1_000_000)
REPEATS = 3
STATUS = Path("/proc/self/status")


def tables(quick: bool) -> list[Table]:
    """One table: a row a number of particles."""
    numbers = (1_000,) if quick else PARTICLES
    note = (
        "Rectangles of the scene afm_rectangles in square domains, each packing in a process of "
        "its own: median (least–largest). Memory is the rise of the peak resident set, drawing the "
        "particles and the finished packing included."
    )
    header = ("particles", "seconds", "ns a particle", "bytes a particle")
    return [Table("Growth", note, header, [_row(n, 1 if quick else REPEATS) for n in numbers])]


def _row(n: int, repeats: int) -> tuple[str, ...]:
    scene, database = scene_and_shapes(SCENE)
    mean_area = scene.size.moment(2) * float(database.descriptors["hull_area"].mean())
    edge = (n * mean_area / FRACTION) ** 0.5
    runs = [_in_own_process(edge) for _ in range(repeats)]
    return (
        f"{runs[0]['particles']:,}",
        Spread.of(run["kernel_s"] for run in runs).text(".3g"),
        Spread.of(run["kernel_s"] / run["particles"] * 1e9 for run in runs).text(".0f"),
        Spread.of(run["bytes"] / run["particles"] for run in runs).text(".0f"),
    )


def _in_own_process(edge: float) -> dict[str, float]:
    command = [sys.executable, __file__, repr(edge)]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)


def _peak() -> int:
    """Bytes of the peak resident set of this process."""
    if STATUS.exists():
        # On Linux a new process starts with getrusage's peak of its parent, which hides its own.
        (line,) = (line for line in STATUS.read_text().splitlines() if line.startswith("VmHWM"))
        return int(line.split()[1]) * 1024
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def _measure(edge: float) -> dict[str, float]:
    api.pack(*scene_and_shapes(SCENE, SMALL), seed=0)  # compiles
    before = _peak()
    packing, run_time = api.pack(*scene_and_shapes(SCENE, edge), seed=1)
    rise = _peak() - before
    return {"particles": packing.x.size, "kernel_s": run_time.kernel_s, "bytes": rise}


if __name__ == "__main__":
    print(json.dumps(_measure(float(sys.argv[1]))))
