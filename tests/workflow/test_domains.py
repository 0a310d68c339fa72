"""Scenes with domains of any shape, from their files to their pictures."""

from __future__ import annotations

import numpy as np
import pytest

from grainfront.certificate import certify
from grainfront.files.netcdf import read_contacts, read_packing
from grainfront.files.statistics import read_statistics
from grainfront.particles import Cell, Region, tiled

DOMAIN = """domain:
  width: 20                   # about 14 grains across: small, with an inside
  height: 20                  # beyond two grains from each wall
"""
SCENES = {
    "hopper": """domain:
  inside: {polygon: {nodes: [[8, 0], [14, 0], [22, 10], [22, 22], [0, 22], [0, 10]],
                     holes: [[[9, 12], [13, 12], [11, 15]]]}}
obstacles: {path: stones.wkt}
""",
    "cell": "domain: {width: 20, height: 20, periodic: [x, y]}\n",
}
STONES = "POLYGON ((3 16, 6 16, 6 19, 3 19, 3 16))\nPOLYGON ((17 16, 19 16, 18 19, 17 16))\n"


@pytest.fixture(scope="module")
def shaped(new_project, tmp_path_factory):
    """The scene `tiny` in a hopper with two stones, and as a periodic cell, built."""
    project = new_project(tmp_path_factory.mktemp("shaped") / "project")
    folder = project.folder / "config"
    text = (folder / "scenes/tiny.yaml").read_text(encoding="utf-8")
    assert text.count(DOMAIN) == 1
    for name, domain in SCENES.items():
        path = folder / f"scenes/{name}.yaml"
        path.write_text(text.replace(DOMAIN, domain).replace("[1, 2]", "[1]"), encoding="utf-8")
    (folder / "scenes/stones.wkt").write_text(STONES)
    (folder / "config.yaml").write_text(f"scenes: [{', '.join(SCENES)}]\n")
    run = project.snakemake("--cores", "1")
    assert run.returncode == 0, run.stderr
    return project


@pytest.mark.parametrize("name", SCENES)
def test_everything_is_there(shaped, name):
    folder = shaped.folder / "results" / name
    for picture in ("packing", "laws", "contacts", "rose"):
        assert (folder / f"figures/{picture}.png").stat().st_size > 10_000
    for kind in ("packing", "nonconvex"):
        assert (folder / f"1/{kind}.vtp").stat().st_size > 10_000
        packing = read_packing(folder / f"1/{kind}.nc")
        assert certify(packing).holds
        assert packing.x.size > 100
    assert shaped.planned() == {}


def test_the_hopper_is_filled_around_its_stones(shaped):
    folder = shaped.folder / "results/hopper"
    packing = read_packing(folder / "1/packing.nc")
    assert isinstance(packing.domain, Region) and packing.domain.rings.count == 4
    assert packing.domain.area == pytest.approx(22 * 22 - 8 * 10 / 2 * 2 - 6 - 9 - 3)
    values = read_statistics(folder / "statistics.nc").values
    assert values["volume_fraction"][0] == pytest.approx(packing.area.sum() / packing.domain.area)
    assert values["volume_fraction"][0] > 0.7
    assert values["empty_area"][0] == 0.0
    assert set(read_contacts(folder / "1/contacts.nc").wall.tolist()) == {0, 1, 2, 3}


def test_nine_copies_of_the_cell_pass_the_certificate(shaped):
    folder = shaped.folder / "results/cell"
    packing = read_packing(folder / "1/packing.nc")
    assert isinstance(packing.domain, Cell) and packing.domain.along_y
    whole = tiled(packing)
    assert whole.x.size == 9 * packing.x.size
    assert certify(whole).holds
    contacts = read_contacts(folder / "1/contacts.nc")
    assert contacts.wall.size == 0
    assert len(np.unique(contacts.pairs, axis=0)) == len(contacts.pairs)
    values = read_statistics(folder / "statistics.nc").values
    assert values["volume_fraction_bulk"][0] == values["volume_fraction"][0] > 0.7
    assert np.isnan(values["size_correlation_x"][0])


def test_an_edit_of_the_stones_makes_their_packing_again(shaped):
    stones = shaped.folder / "config/scenes/stones.wkt"
    stones.write_text(STONES.replace("6 19, 3 19", "6 18, 3 18"))
    planned = shaped.planned()
    stones.write_text(STONES)
    assert planned["packing"] == 1 and planned["statistics"] == 2
    assert "shapes" not in planned and "kernels" not in planned


@pytest.mark.parametrize("name", SCENES)
def test_stages_import_what_their_digest_covers(shaped, name, tmp_path):
    folder = f"results/{name}"
    arguments = {
        "packing": {
            "scene": f"config/scenes/{name}.yaml", "database": f"{folder}/shapes.nc", "seed": 1,
            "packing": str(tmp_path / "packing.nc"), "timing": str(tmp_path / "timing.json"),
        },
        "statistics": {
            "scene": f"config/scenes/{name}.yaml", "database": f"{folder}/shapes.nc",
            "seeds": [1], "packings": [f"{folder}/1/packing.nc"],
            "statistics": str(tmp_path / "statistics.nc"),
        },
    }  # fmt: skip
    for stage, of_stage in arguments.items():
        assert shaped.uncovered(stage, shaped.modules_of(stage, of_stage)) == []
