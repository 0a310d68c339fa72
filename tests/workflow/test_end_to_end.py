"""The workflow from end to end on the scene `tiny`: results, repetition, edits, faults."""

from __future__ import annotations

import re
import struct

import netCDF4
import numpy as np
import pytest
import xarray

RESULTS = {
    "shapes.nc", "statistics.nc", "statistics_nonconvex.nc",
    *(f"{seed}/{name}" for seed in (1, 2) for name in (
        "packing.nc", "packing.vtp", "nonconvex.nc", "nonconvex.vtp", "contacts.nc",
        "contacts_nonconvex.nc", "timing.json",
    )),
    *(f"figures/{name}.png" for name in ("packing", "laws", "contacts", "rose")),
}  # fmt: skip


def results(project):
    """Bytes of all results of `tiny`, by name."""
    folder = project.folder / "results/tiny"
    files = [path for path in folder.rglob("*") if path.is_file()]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def test_all_results_are_there_and_nothing_else(built):
    assert set(results(built)) == RESULTS
    assert built.planned() == {}


def test_two_cores_give_the_same_bytes(built, project):
    assert project.snakemake("--cores", "2").returncode == 0
    again, first = results(project), results(built)
    different = [name for name in first if again[name] != first[name]]
    assert [name for name in different if not name.endswith("timing.json")] == []


def test_statistics_have_a_row_for_each_seed_and_the_certificate(built):
    for name in ("statistics", "statistics_nonconvex"):
        with xarray.open_dataset(built.folder / f"results/tiny/{name}.nc") as found:
            assert found.seed.values.tolist() == [1, 2]
            assert found.overlaps.values.tolist() == [0, 0]
            assert found.across_wall.values.tolist() == [0, 0]
            assert (found.pairs_tested > found.particles).all()
            assert ((found.volume_fraction > 0.6) & (found.volume_fraction < 0.9)).all()
    with xarray.open_dataset(built.folder / "results/tiny/1/packing.nc") as packing:
        assert packing.sizes["particle"] > 100
        assert packing.attrs["seed"] == 1


def test_outlines_lie_within_their_hulls(built):
    folder = built.folder / "results/tiny/1"
    with (
        netCDF4.Dataset(folder / "packing.nc") as hulls,
        netCDF4.Dataset(folder / "nonconvex.nc") as outlines,
    ):
        for name in ("x", "y", "size", "orientation", "shape"):
            assert np.array_equal(hulls[name][...], outlines[name][...])
        ratio = outlines["area"][...] / hulls["area"][...]
        assert ratio.min() > 0.7 and ratio.max() <= 1.0


def test_pictures_are_pictures(built):
    for path in (built.folder / "results/tiny/figures").iterdir():
        data = path.read_bytes()
        width, height = struct.unpack(">II", data[16:24])
        assert data.startswith(b"\x89PNG\r\n\x1a\n")
        assert min(width, height) > 600
        assert len(data) > 20_000, "a blank sheet compresses to less"


@pytest.mark.parametrize(
    ("old", "new", "jobs"),
    [
        ("n_angle: 6 ", "n_angle: 5 ", {"packing": 2, "contacts": 4, "replacement": 2,
                                        "statistics": 2, "vtk": 4, "figures": 1}),
        ("seeds: [1, 2]", "seeds: [1, 2, 5]", {"packing": 1, "contacts": 2, "replacement": 1,
                                               "statistics": 2, "vtk": 2, "figures": 1}),
        ("d8: 0.03", "d8: 0.02", {"shapes": 1, "packing": 2, "contacts": 4, "replacement": 2,
                                  "statistics": 2, "vtk": 4, "figures": 1}),
        ("outputs: [vtk, figures]", "outputs: []", {}),
        ("# n", "# names, n", {}),
    ],
    ids=["effort", "seed", "shape", "outputs", "comment"],
)  # fmt: skip
def test_an_edit_reruns_only_what_depends_on_it(copy_of_built, old, new, jobs):
    path = copy_of_built.folder / "config/scenes/tiny.yaml"
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    assert copy_of_built.planned() == jobs


def test_an_output_added_later_is_all_that_is_made(copy_of_built):
    for path in copy_of_built.folder.glob("results/tiny/*/*.vtp"):
        path.unlink()
    assert copy_of_built.planned() == {"vtk": 4}


def test_the_report_is_one_file_that_loads_nothing(built, tmp_path):
    report = tmp_path / "report.html"
    run = built.snakemake("--report", str(report))
    assert run.returncode == 0, run.stderr
    text = report.read_text(encoding="utf-8")
    for loading in ('src="http', "src='http", 'rel="stylesheet" href="http', "@import url(http"):
        assert loading not in text
    for picture in ("packing.png", "laws.png", "contacts.png", "rose.png"):
        assert picture in text
    assert len(re.findall(r"data:image/png;[^,]*base64,", text)) == 4


@pytest.mark.parametrize(
    ("file", "old", "new", "told"),
    [
        ("config/config.yaml", "tiny", "huge", "config/scenes/huge.yaml: there is no such file."),
        ("config/config.yaml", "scenes", "scene", "scene is an unknown key"),
        ("config/scenes/tiny.yaml", "n_loc: 5", "n_lok: 5", "n_lok is an unknown key"),
        ("config/scenes/tiny.yaml", "median: 1.4", "median: -1.4", "size.lognormal"),
    ],
)
def test_a_fault_is_told_in_one_sentence(project, file, old, new, told):
    project.edit(file, old, new)
    run = project.snakemake()
    assert run.returncode != 0
    (sentence,) = [line for line in run.stderr.splitlines() if line.startswith("grainfront: ")]
    assert told in sentence
    assert "Traceback" not in run.stderr
    assert not (project.folder / "results").exists()


def test_a_fault_found_by_a_job_is_told_in_one_sentence(project):
    outlines = project.folder / "config/scenes/outlines.wkt"
    outlines.write_text("POLYGON ((0 0, 1 1, 0 0))\n")
    scene = project.folder / "config/scenes/tiny.yaml"
    text = scene.read_text(encoding="utf-8")
    family = text[text.index("  family:") : text.index("size:")]
    scene.write_text(text.replace(family, "  outlines_file: {path: outlines.wkt}\n\n"))
    run = project.snakemake("results/tiny/shapes.nc")
    assert run.returncode != 0
    (sentence,) = [line for line in run.stderr.splitlines() if line.startswith("grainfront: ")]
    assert "outlines.wkt" in sentence and "3 or more are needed" in sentence
    assert "Traceback" not in run.stderr
    assert not (project.folder / "results/tiny/shapes.nc").exists()
