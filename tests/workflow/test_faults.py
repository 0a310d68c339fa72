"""Kills, full disks, read-only folders, two runs at once: one sentence, and whole files."""

from __future__ import annotations

import os
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "faults"))
import kill_at_random as kills

ROOT = Path(__file__).parents[2]
SHAPES, PACKING = "results/tiny/shapes.nc", "results/tiny/1/packing.nc"
# In a mount namespace of its own, as root of it: the rest of the machine sees none of these mounts.
NAMESPACE = ("unshare", "--mount", "--map-root-user", "sh", "-ec")
READ_ONLY = 'mount --bind "{0}" "{0}"; mount -o remount,bind,ro "{0}"; '


def mounted(project, mounts: str, *command: str, **variables: str) -> subprocess.CompletedProcess:
    """Run a command of Python after these mounts; skipped where mounting is not allowed."""
    trial = subprocess.run([*NAMESPACE, "mount -t tmpfs none /mnt"], capture_output=True)
    if trial.returncode:
        pytest.skip("this user may not mount anything, not even in a namespace")
    return subprocess.run(
        [*NAMESPACE, f'{mounts} exec "$@"', "sh", sys.executable, *command],
        cwd=project.folder, capture_output=True, text=True, env={**os.environ, **variables},
    )  # fmt: skip


def sentences(run: subprocess.CompletedProcess) -> list[str]:
    assert run.returncode != 0 and "Traceback" not in run.stderr, run.stderr
    return [line for line in run.stderr.splitlines() if line.startswith("grainfront: ")]


def test_killed_runs_end_with_the_bytes_of_an_undisturbed_one(project, built):
    goal = ("results/tiny/1/nonconvex.nc",)
    names = ("shapes.nc", "1/packing.nc", "1/timing.json", "1/nonconvex.nc")
    reference = {f"tiny/{n}": (built.folder / "results/tiny" / n).read_bytes() for n in names}
    moments = random.Random(1)
    for alone in (False, True, False):
        kills.kill(project, goal, moments.uniform(1.0, 4.0), alone)
        kills.require_whole(kills.results(project), reference)
        assert project.snakemake("--unlock").returncode == 0
    kills.finish(project, goal, reference)


def test_a_full_disk_is_told_in_one_sentence_and_leaves_whole_files(project, built):
    """The shapes take 350 kB, the packing 90."""
    (project.folder / "results").mkdir()
    code = (
        "import shutil, subprocess, sys\n"
        "run = subprocess.run([sys.executable, '-m', 'snakemake', '--cores', '1', sys.argv[1]])\n"
        "shutil.copytree('results', 'left')\n"
        "sys.exit(run.returncode)"
    )
    run = mounted(project, "mount -t tmpfs -o size=400k none results; ", "-c", code, PACKING)
    assert sentences(run) == [
        f"grainfront: {PACKING}: cannot be written (NetCDF: HDF error), perhaps for want of space."
    ]
    left = [path for path in (project.folder / "left").rglob("*") if path.is_file()]
    assert {path.name for path in left} == {".exhaustive.compiled", "shapes.nc"}
    shapes = (built.folder / SHAPES).read_bytes()
    assert (project.folder / "left/tiny/shapes.nc").read_bytes() == shapes


def test_an_earlier_result_stays_where_the_disk_is_full(project, built):
    (project.folder / "results").mkdir()
    code = (
        "import shutil, sys\n"
        "from grainfront import stages\n"
        "shutil.copy('earlier.vtp', 'results')\n"
        "try:\n"
        "    stages.vtk(packing=sys.argv[1], vtp='results/earlier.vtp')\n"
        "finally:\n"
        "    shutil.copytree('results', 'left')\n"
    )
    (project.folder / "earlier.vtp").write_text("earlier")
    packing = str(built.folder / PACKING)
    run = mounted(project, "mount -t tmpfs -o size=40k none results; ", "-c", code, packing)
    assert sentences(run) == [
        "grainfront: [Errno 28] No space left on device: 'results/earlier.vtp'."
    ]
    left = project.folder / "left"
    assert {path.name: path.read_text() for path in left.iterdir()} == {"earlier.vtp": "earlier"}


def test_a_read_only_results_folder_is_told_before_the_first_job(project):
    (project.folder / "results").mkdir()
    run = mounted(project, READ_ONLY.format("results"), "-m", "snakemake", "--cores", "1")
    assert sentences(run) == ["grainfront: results: the folder is not writable."]
    assert project.planned("--cores", "1", SHAPES) == {"shapes": 1}, "it is not locked"


def test_nothing_is_written_to_the_package_or_to_home(project):
    """A kernel is compiled and its cache kept where there is room: among temporary files."""
    for name in ("home", "temporary"):
        (project.folder / name).mkdir()
    code = (
        "import numpy as np\n"
        "from grainfront.geometry.rings import polygon_areas\n"
        "from grainfront.jit import cache_folder\n"
        "square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])\n"
        "assert polygon_areas(square, np.array([0, 4]))[0] == 1.0\n"
        "print(cache_folder())"
    )
    folder = project.folder
    mounts = READ_ONLY.format(ROOT / "src") + READ_ONLY.format("home")
    run = mounted(
        project, mounts, "-c", code,
        HOME=str(folder / "home"), TMPDIR=str(folder / "temporary"), GRAINFRONT_CACHE="",
        XDG_CACHE_HOME="",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    cache = Path(run.stdout.strip())
    assert cache.is_relative_to(folder / "temporary")


def test_a_second_run_in_the_same_folder_is_refused(project):
    lock = project.folder / ".snakemake/locks"
    first = subprocess.Popen(
        [sys.executable, "-m", "snakemake", "--cores", "1", SHAPES],
        cwd=project.folder, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    while first.poll() is None and not (lock.is_dir() and any(lock.iterdir())):
        time.sleep(0.01)
    second = project.snakemake("--cores", "1", SHAPES)
    assert second.returncode != 0 and "Directory cannot be locked" in second.stderr
    assert first.wait() == 0
    assert project.planned("--cores", "1", SHAPES) == {}


def test_two_writers_of_one_file_leave_it_whole(built, tmp_path):
    code = "import sys; from grainfront import stages; stages.vtk(packing=sys.argv[1], vtp='a.vtp')"
    writers = [
        subprocess.Popen([sys.executable, "-c", code, str(built.folder / PACKING)], cwd=tmp_path)
        for _ in range(2)
    ]
    assert [writer.wait() for writer in writers] == [0, 0]
    assert [path.name for path in tmp_path.iterdir()] == ["a.vtp"]
    whole = built.folder / "results/tiny/1/packing.vtp"
    assert (tmp_path / "a.vtp").read_bytes() == whole.read_bytes()
