"""Kill `snakemake` at random moments, run it again, and compare with an undisturbed run.

    python tests/faults/kill_at_random.py --kills 50

SIGKILL at a random moment, to all processes or to `snakemake` alone, so that its jobs go on. What
looks finished then must be whole. After some kills of a project, `snakemake --unlock` and the same
command must end with the bytes of the undisturbed run.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import netCDF4

sys.path.insert(0, str(Path(__file__).parents[1] / "workflow"))
from conftest import Project

GOALS = {"tiny": (), "sweep": ("results/tiny/contour.nc", "results/tiny/figures/contour.png")}
SWEEP = {"n_angle": [1, 3, 9], "n_loc": [2, 9], "seeds": 2}
# Run times differ from run to run: these need only be whole.
TIMES = ("timing.json", "contour_timing.nc")
# Seconds that a job, whose `snakemake` was killed, may take to end.
ORPHANS_END = 120
KILLS_A_PROJECT = 4


def new_project(folder: Path, goal: str) -> Project:
    """A project, for a sweep with one that is cut into several jobs."""
    project = Project(folder)
    if goal != "sweep":
        return project
    scene = folder / "config/scenes/tiny.yaml"
    text = scene.read_text(encoding="utf-8")
    scene.write_text(f"{text}sweep: {json.dumps(SWEEP)}\n", encoding="utf-8")
    (folder / "config/config.yaml").write_text("scenes: [tiny]\nchunk_seconds: 0.01\n")
    return project


def results(project: Project) -> dict[str, bytes]:
    """Bytes of all files that look like results, by name."""
    folder = project.folder / "results"
    paths = [path for path in folder.rglob("*") if path.is_file() and path.name[0] != "."]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


def require_whole(found: dict[str, bytes], reference: dict[str, bytes]) -> None:
    """Every file that is there is as in the undisturbed run, or is a packing of a sweep."""
    for name, content in found.items():
        if name.endswith(".json"):
            json.loads(content)
        elif name.endswith(TIMES):
            netCDF4.Dataset(name, memory=content).close()
        elif "/sweep/" not in name:
            assert content == reference[name], f"{name} looks finished and is not"


def kill(project: Project, goal: tuple[str, ...], seconds: float, alone: bool) -> bool:
    """Start `snakemake`, kill it after so many seconds; whether it was still running."""
    command = [sys.executable, "-m", "snakemake", "--cores", "2", *goal]
    run = subprocess.Popen(
        command, cwd=project.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        start_new_session=True,
    )  # fmt: skip
    time.sleep(seconds)
    running = run.poll() is None
    if alone:
        run.kill()
    elif running:
        os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    return running


def finish(project: Project, goal: tuple[str, ...], reference: dict[str, bytes]) -> None:
    """Unlock the project and run it to its end: the bytes are those of the undisturbed run."""
    unlocked = project.snakemake("--unlock")
    assert unlocked.returncode == 0, unlocked.stderr
    run = project.snakemake("--cores", "2", *goal)
    assert run.returncode == 0, run.stderr
    found = results(project)
    require_whole(found, reference)
    missing = set(reference) - set(found)
    assert not missing, f"{missing} are not there"
    assert not any("/sweep/" in name for name in found), "packings of the sweep are left"


def orphans(project: Project) -> list[int]:
    """Processes that work in the project's folder."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if Path(os.readlink(process / "cwd")).is_relative_to(project.folder):
                found.append(int(process.name))
        except OSError:
            continue
    return found


def kills(base: Path, name: str, number: int, moments: random.Random) -> Counter[str]:
    """Kill the runs of a goal so many times, in as many projects as it takes."""
    goal = GOALS[name]
    undisturbed = new_project(base / f"{name}-undisturbed", name)
    for _ in range(2):  # the second time with compiled kernels
        shutil.rmtree(undisturbed.folder / "results", ignore_errors=True)
        start = time.monotonic()
        run = undisturbed.snakemake("--cores", "2", *goal)
        assert run.returncode == 0, run.stderr
    took, reference = time.monotonic() - start, results(undisturbed)
    counts: Counter[str] = Counter()
    while counts["killed"] < number:
        counts["projects"] += 1
        project = new_project(base / f"{name}-{counts['projects']}", name)
        running = True
        for _ in range(KILLS_A_PROJECT):
            if running:
                seconds, alone = moments.uniform(0.2, 0.6 * took), moments.random() < 0.5
                running = kill(project, goal, seconds, alone)
                took = took if running else min(took, seconds)
                counts["killed"] += running
                counts["of them snakemake alone"] += running and alone
                found = results(project)
                require_whole(found, reference)
                counts["results found whole at a kill"] += len(found)
                assert project.snakemake("--unlock").returncode == 0
        finish(project, goal, reference)
        give_up = time.monotonic() + ORPHANS_END
        while orphans(project) and time.monotonic() < give_up:
            time.sleep(0.2)
        require_whole(results(project), reference)
        shutil.rmtree(project.folder)
        print(f"{name}: {dict(counts)}", flush=True)
    return counts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--kills", type=int, default=50, help="kills of each goal")
    parser.add_argument("--goals", nargs="+", choices=GOALS, default=list(GOALS))
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    base = Path(tempfile.mkdtemp(prefix="kills-"))
    for name in options.goals:
        kills(base, name, options.kills, random.Random(options.seed))
    shutil.rmtree(base)


if __name__ == "__main__":
    main()
