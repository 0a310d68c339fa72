"""`snakemake error_vs_time`: what it builds, what it asks for, what it leaves alone."""

from __future__ import annotations

import json
import re
import subprocess
import sys

import pytest
import xarray

from grainfront import stages

AXES = ("effort", "outlines", "drawing", "checks")
PART = f"""
error_vs_time:
  axes: [{", ".join(AXES)}]
  seeds: 2
  repeats: 1
"""
SMALLER = (
    ("width: 20 ", "width: 14 "),
    ("n_angle: 6 ", "n_angle: 2 "),
    ("n_loc: 5 ", "n_loc: 2 "),
    ("count: 250 ", "count: 80 "),
)


def ask(project):
    """Let `tiny`, smaller and of less effort, list axes."""
    for old, new in SMALLER:
        project.edit("config/scenes/tiny.yaml", old, new)
    scene = project.folder / "config/scenes/tiny.yaml"
    scene.write_text(scene.read_text(encoding="utf-8") + PART, encoding="utf-8")


def test_the_target_builds_record_and_pictures_and_nothing_else(project):
    ask(project)
    run = project.snakemake("error_vs_time", "--cores", "2")
    assert run.returncode == 0, run.stderr
    folder = project.folder / "results/tiny"
    found = {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}
    pictures = {f"figures/error_vs_time_{axis}.png" for axis in AXES}
    assert found == {"shapes.nc", "error_vs_time.nc", *pictures}
    with xarray.open_dataset(folder / "error_vs_time.nc") as record:
        assert record.seed.values.tolist() == [1, 2]
        assert {name.partition("_")[0] for name in record.data_vars} == set(AXES)
        assert (record.effort_kernel_s > 0).all()
        front = record.effort_volume_fraction.median("seed")[record.effort_pareto == 1]
        assert front.max() == record.effort_volume_fraction.median("seed").max()
    modules = imported_by_the_study(project)
    assert uncovered(modules, stages.SOURCES["error_vs_time"]) == []
    assert not {"matplotlib", "pyvista", "skimage"} & {name.split(".")[0] for name in modules}

    project.edit("config/scenes/tiny.yaml", "  repeats: 1", "  repeats: 2")
    dry = project.snakemake("--dry-run", "--quiet", "rules", "--cores", "1", "error_vs_time")
    planned = re.findall(r"^(error_vs_time\w+) +(\d+)$", dry.stdout + dry.stderr, re.MULTILINE)
    jobs = {"error_vs_time_record": "1", "error_vs_time_picture": str(len(AXES))}
    assert dict(planned) == jobs, "other repeats are another record, of the same shapes"


def imported_by_the_study(project):
    """Modules that the stage has imported when its study begins."""
    code = (
        "import json, sys\n"
        "from grainfront import stages\n"
        "import grainfront.studies.error_vs_time as study\n"
        "study.measure_axes = lambda scene, database: ([1], {})\n"
        "stages.error_vs_time(scene='config/scenes/tiny.yaml', "
        "database='results/tiny/shapes.nc', record=sys.argv[1])\n"
        "print(json.dumps(sorted(sys.modules)))"
    )
    command = [sys.executable, "-c", code, "imports.nc"]
    run = subprocess.run(command, cwd=project.folder, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


def uncovered(modules, covered):
    """Modules of the package that its digest of sources does not cover."""
    ours = [name.removeprefix("grainfront.") for name in modules if name.startswith("grainfront.")]
    return [
        name
        for name in ours
        if not any(name == part or name.startswith(f"{part}.") for part in covered)
        and not any(part.startswith(f"{name}.") for part in covered)
    ]


def test_all_does_not_build_it(project):
    before = project.planned()
    scene = project.folder / "config/scenes/tiny.yaml"
    scene.write_text(scene.read_text(encoding="utf-8") + PART, encoding="utf-8")
    assert project.planned() == before


def test_without_axes_the_target_says_so_in_one_sentence(project):
    run = project.snakemake("error_vs_time")
    assert run.returncode != 0
    (sentence,) = [line for line in run.stderr.splitlines() if line.startswith("grainfront: ")]
    assert "none of the scenes tiny says error_vs_time" in sentence
    assert "Traceback" not in run.stderr
    assert not (project.folder / "results").exists()


@pytest.mark.parametrize(
    ("part", "told"),
    [
        ("error_vs_time: {axes: []}", "error_vs_time.axes"),
        ("error_vs_time: {axes: [speed]}", "error_vs_time.axes[0]"),
        ("error_vs_time: {axes: [effort], repeats: 0}", "error_vs_time.repeats"),
    ],
)
def test_a_fault_is_told_in_one_sentence(project, part, told):
    scene = project.folder / "config/scenes/tiny.yaml"
    scene.write_text(scene.read_text(encoding="utf-8") + part + "\n", encoding="utf-8")
    run = project.snakemake("error_vs_time")
    assert run.returncode != 0
    (sentence,) = [line for line in run.stderr.splitlines() if line.startswith("grainfront: ")]
    assert told in sentence
