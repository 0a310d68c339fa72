"""Sweeps by the workflow: equal bytes however they are cut, and resumption after a kill."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray

from grainfront import stages

MAP, PICTURE = "results/tiny/contour.nc", "results/tiny/figures/contour.png"
QUICK = {"n_angle": [1, 3], "n_loc": [2, 9], "seeds": 2}
# Half a second or more each, so that there is time to kill the sweep between two of them.
SLOW = {"n_angle": [3000, 4000], "n_loc": [9, 10], "seeds": 1}
SECONDS_TO_WAIT = 120
MARK = 12345.0


def with_sweep(project, sweep):
    """The project, its scene `tiny` with a sweep."""
    scene = project.folder / "config/scenes/tiny.yaml"
    text = scene.read_text(encoding="utf-8")
    scene.write_text(text + f"sweep: {json.dumps(sweep)}\n", encoding="utf-8")
    return project


def set_chunks(project, seconds):
    (project.folder / "config/config.yaml").write_text(f"scenes: [tiny]\nchunk_seconds: {seconds}")


def finished(project):
    """The files of finished packings."""
    return list(project.folder.glob("results/tiny/sweep/*/[0-9]*.json"))


@pytest.fixture(scope="module")
def swept(tmp_path_factory, new_project):
    """A project with the map and its picture, made in one job on one core."""
    project = with_sweep(new_project(tmp_path_factory.mktemp("swept") / "project"), QUICK)
    run = project.snakemake("--cores", "1", MAP, PICTURE)
    assert run.returncode == 0, run.stderr
    assert "chunk" not in run.stderr
    return project


def test_the_map_has_all_efforts_and_seeds(swept):
    with xarray.open_dataset(swept.folder / MAP) as found:
        assert found.n_angle.values.tolist() == [1, 3]
        assert found.n_loc.values.tolist() == [2, 9]
        assert found.seed.values.tolist() == [1, 2]
        fraction = found.volume_fraction.mean("seed").values
    assert (fraction > 0.5).all() and (np.diff(fraction.ravel()[[0, 3]]) > 0.02).all()
    with xarray.open_dataset(swept.folder / "results/tiny/contour_timing.nc") as found:
        assert (found.kernel_s > 0).all()
    assert (swept.folder / PICTURE).stat().st_size > 20_000


def test_nothing_else_is_left(swept):
    left = {path.name for path in (swept.folder / "results/tiny").iterdir()}
    assert left == {"shapes.nc", "contour.nc", "contour_timing.nc", "figures"}


def test_many_chunks_on_two_cores_give_the_same_bytes(swept, project):
    set_chunks(with_sweep(project, QUICK), 0.005)
    run = project.snakemake("--cores", "2", MAP)
    assert run.returncode == 0, run.stderr
    assert "chunk 3 of" in run.stderr
    assert (project.folder / MAP).read_bytes() == (swept.folder / MAP).read_bytes()
    assert not (project.folder / "results/tiny/sweep").exists()
    assert not {"contour", "sweep"} & set(project.planned())


def test_a_killed_sweep_resumes_after_the_packings_that_are_finished(project):
    with_sweep(project, SLOW)
    command = [sys.executable, "-m", "snakemake", "--cores", "1", MAP]
    run = subprocess.Popen(
        command, cwd=project.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        start_new_session=True,
    )  # fmt: skip
    give_up = time.monotonic() + SECONDS_TO_WAIT
    while run.poll() is None and not finished(project) and time.monotonic() < give_up:
        time.sleep(0.01)
    os.killpg(run.pid, signal.SIGKILL)
    run.wait()
    kept = finished(project)
    assert 1 <= len(kept) < 4, "killed in the middle"
    assert not (project.folder / MAP).exists()
    for path in kept:  # a time that no packing takes tells later which of them were taken up
        path.write_text(json.dumps(json.loads(path.read_text()) | {"kernel_s": MARK}))
    marked = sorted(tuple(map(int, path.stem.split("_"))) for path in kept)

    set_chunks(project, 0.5)  # resumed in other chunks than those of the killed run
    assert project.snakemake("--unlock").returncode == 0
    resumed = project.snakemake("--cores", "2", MAP)
    assert resumed.returncode == 0, resumed.stderr
    with xarray.open_dataset(project.folder / "results/tiny/contour_timing.nc") as found:
        seconds = found.kernel_s.to_series()
    repeated = seconds.reorder_levels(["n_angle", "n_loc", "seed"])
    assert sorted(repeated.index[repeated == MARK]) == marked
    assert not finished(project)


def test_a_damaged_packing_is_told_with_what_to_do(project, monkeypatch):
    with_sweep(project, {"n_angle": [1], "n_loc": [1], "seeds": 1})
    monkeypatch.chdir(project.folder)
    scene, database = "config/scenes/tiny.yaml", "shapes.nc"
    stages.shapes(scene=scene, database=database)
    chunk = dict(scene=scene, database=database, chunk=1, chunks=1, folder="kept", threads=1)
    stages.sweep(**chunk)
    (file,) = project.folder.glob("kept/*/1_1_1.json")
    whole = file.read_text()
    file.write_text(whole[:30])
    with pytest.raises(SystemExit, match=f"{file.name}: is cut off or damaged, .* removed"):
        stages.sweep(**chunk)
    file.unlink()
    stages.sweep(**chunk)
    again, before = json.loads(file.read_text()), json.loads(whole)
    assert again | {"kernel_s": 0} == before | {"kernel_s": 0}


def test_the_scene_that_shows_it_is_swept_in_one_job(project):
    jobs = project.planned("--config", "scenes=[contour_rectangles]")
    assert jobs["contour"] == jobs["contour_picture"] == 1
    assert "sweep" not in jobs


@pytest.mark.parametrize(
    ("stage", "heavy", "arguments"),
    [
        ("sweep", {"numba"}, {
            "scene": "config/scenes/tiny.yaml", "database": "results/tiny/shapes.nc",
            "chunk": 1, "chunks": 2, "folder": "O/sweep", "threads": 1,
        }),
        ("contour_picture", {"matplotlib"}, {
            "scene": "config/scenes/tiny.yaml", "contour": MAP, "picture": "O/contour.png",
        }),
    ],
)  # fmt: skip
def test_a_stage_imports_what_it_uses_and_its_digest_covers(
    stage, heavy, arguments, swept, tmp_path
):
    arguments = {
        key: value.replace("O/", f"{tmp_path}/") if isinstance(value, str) else value
        for key, value in arguments.items()
    }
    code = (
        "import json, sys\n"
        "from grainfront import stages\n"
        f"stages.{stage}(**json.loads(sys.argv[1]))\n"
        "print(json.dumps(sorted(sys.modules)))"
    )
    run = subprocess.run(
        [sys.executable, "-c", code, json.dumps(arguments)],
        cwd=swept.folder, capture_output=True, text=True,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    modules = json.loads(run.stdout)
    libraries = {"skimage", "matplotlib", "pyvista", "xarray", "numba"}
    assert {module.split(".")[0] for module in modules} & libraries <= heavy
    covered = stages.SOURCES[stage]
    ours = [m.removeprefix("grainfront.") for m in modules if m.startswith("grainfront.")]
    assert [
        module
        for module in ours
        if not any(f"{module}.".startswith(f"{part}.") for part in covered)
        and not any(part.startswith(f"{module}.") for part in covered)  # an empty __init__
    ] == []
