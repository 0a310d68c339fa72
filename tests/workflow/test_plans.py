"""A scene pays only for what it names: the jobs planned for it, and what each stage imports."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from grainfront import stages

PHOTOGRAPH_ALL = {
    "kernels": 1, "shapes": 1, "packing": 1, "contacts": 2, "replacement": 1, "statistics": 2,
    "vtk": 2, "figures": 1, "photograph": 1,
}  # fmt: skip
RECTANGLES = {"kernels": 1, "shapes": 1, "packing": 1, "contacts": 1, "statistics": 1}


@pytest.mark.parametrize(
    ("scene", "jobs"),
    [
        ("river_gravel", PHOTOGRAPH_ALL),
        ("own_images", PHOTOGRAPH_ALL),
        ("afm_rectangles", RECTANGLES),
        ("oafm_rectangles", RECTANGLES),
    ],
)
def test_jobs_planned_for_the_shipped_scenes(project, scene, jobs):
    assert project.planned("--config", f"scenes=[{scene}]") == jobs


@pytest.mark.parametrize(
    ("edits", "without"),
    [
        ([("replacement: true", "replacement: false")], {"replacement"}),
        ([("outputs: [vtk, figures]", "outputs: [figures]")], {"vtk"}),
        ([("outputs: [vtk, figures]", "outputs: []")], {"vtk", "figures"}),
    ],
)
def test_no_job_for_what_is_not_named(project, edits, without):
    everything = set(project.planned())
    for old, new in edits:
        project.edit("config/scenes/tiny.yaml", old, new)
    assert set(project.planned()) == everything - without


STAGES = {
    "shapes": {"scene": "S", "database": "O/shapes.nc"},
    "packing": {"scene": "S", "database": "R/shapes.nc", "seed": 1, "packing": "O/packing.nc",
                "timing": "O/timing.json"},
    "packing_to_target": {"scene": "T", "database": "R/shapes.nc",
                          "seed": 1, "contour": None, "packing": "O/packing.nc",
                          "target": "O/target.nc", "timing": "O/timing.json"},
    "replacement": {"scene": "S", "database": "R/shapes.nc", "seed": 1,
                    "packing": "R/1/packing.nc", "nonconvex": "O/nonconvex.nc"},
    "contacts": {"scene": "S", "seed": 1, "packing": "R/1/packing.nc",
                 "contacts": "O/contacts.nc"},
    "statistics": {"scene": "S", "database": "R/shapes.nc", "seeds": [1],
                   "packings": ["R/1/packing.nc"], "statistics": "O/statistics.nc"},
    "vtk": {"packing": "R/1/packing.nc", "vtp": "O/packing.vtp"},
    "figures": {"length_unit": "mm", "hulls": "R/1/packing.nc", "outlines": None,
                "contacts": "R/1/contacts.nc", "statistics": "R/statistics.nc",
                "packing_picture": "O/packing.png", "laws_picture": "O/laws.png",
                "contacts_picture": "O/contacts.png", "rose_picture": "O/rose.png"},
}  # fmt: skip
# What each stage has a use for, of the libraries that take long to import.
HEAVY = {"skimage", "matplotlib", "pyvista", "vtkmodules", "xarray", "numba"}
USES = {
    "shapes": set(),
    "packing": {"numba"},
    "packing_to_target": {"numba"},
    "replacement": {"numba"},
    "contacts": {"numba"},
    "statistics": {"numba"},
    "vtk": {"pyvista", "vtkmodules", "matplotlib"},  # pyvista imports matplotlib
    "figures": {"matplotlib", "numba"},
}


@pytest.mark.parametrize("stage", STAGES)
def test_a_stage_imports_what_it_uses_and_its_digest_covers(stage, built, tmp_path):
    places = {"S": "config/scenes/tiny.yaml", "R": "results/tiny", "O": str(tmp_path)}
    places["T"] = str(tmp_path / "targeted.yaml")
    text = (built.folder / places["S"]).read_text(encoding="utf-8")
    Path(places["T"]).write_text(f"{text}target_volume_fraction: 0.725\ntarget_tolerance: 0.01\n")

    def placed(value):
        if isinstance(value, list):
            return [placed(one) for one in value]
        if isinstance(value, str) and value[0] in places and value[1:2] in ("", "/"):
            return places[value[0]] + value[1:]
        return value

    arguments = {key: placed(value) for key, value in STAGES[stage].items()}
    code = (
        "import json, sys\n"
        "from grainfront import stages\n"
        f"stages.{stage}(**json.loads(sys.argv[1]))\n"
        "print(json.dumps(sorted(sys.modules)))"
    )
    run = subprocess.run(
        [sys.executable, "-c", code, json.dumps(arguments)],
        cwd=built.folder, capture_output=True, text=True,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    modules = json.loads(run.stdout)
    assert {module.split(".")[0] for module in modules} & HEAVY <= USES[stage]
    assert uncovered(stage, modules) == []


def uncovered(stage, modules):
    """Modules of the package that a stage imported and its digest does not cover."""
    covered = stages.SOURCES[stage]
    ours = [m.removeprefix("grainfront.") for m in modules if m.startswith("grainfront.")]
    return [
        module
        for module in ours
        if not any(module == part or module.startswith(f"{part}.") for part in covered)
        and not any(part.startswith(f"{module}.") for part in covered)  # an empty __init__
    ]
