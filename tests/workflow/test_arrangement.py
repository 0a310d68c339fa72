"""A scene with an arrangement, from its file to its pictures."""

from __future__ import annotations

import numpy as np
import pytest

from grainfront.files.netcdf import read_packing
from grainfront.files.statistics import read_statistics

SCENE = "config/scenes/tiny.yaml"
ARRANGEMENT = """arrangement:
  regions:
    - inside: {polygon: {nodes: [[4, 4], [16, 4], [10, 16]]}}
      size: {finer_than: auto}

packing:
"""


@pytest.fixture(scope="module")
def arranged(new_project, tmp_path_factory):
    """The scene `tiny` with a triangle of finer grains, built."""
    project = new_project(tmp_path_factory.mktemp("arranged") / "project")
    project.edit(SCENE, "packing:\n", ARRANGEMENT)
    run = project.snakemake("--cores", "1")
    assert run.returncode == 0, run.stderr
    return project


def test_everything_is_there(arranged):
    folder = arranged.folder / "results/tiny"
    assert (folder / "figures/arrangement.png").stat().st_size > 10_000
    for name in ("packing", "nonconvex"):
        packing = read_packing(folder / f"1/{name}.nc")
        assert set(np.unique(packing.region)) == {-1, 0}
        inside = packing.region == 0
        assert packing.size[inside].max() < packing.size[~inside].mean()
    for ending in ("", "_nonconvex"):
        regions = read_statistics(folder / f"statistics{ending}.nc").regions
        assert np.all(regions["misplaced_share"] == 0.0)
        assert regions["region_particles"].shape == (2, 2)
        assert regions["region_area"].sum() == pytest.approx(400.0)
        assert np.isfinite(regions["region_aspect_ratio_l2_error"]).all()
    assert arranged.planned() == {}


def test_an_edit_of_the_arrangement_makes_packings_again(arranged):
    arranged.edit(SCENE, "[10, 16]", "[10, 15]")
    planned = arranged.planned()
    arranged.edit(SCENE, "[10, 15]", "[10, 16]")
    assert planned["packing"] == 2 and planned["arrangement_picture"] == 1
    assert "shapes" not in planned and "kernels" not in planned
