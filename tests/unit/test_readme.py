"""What the README says is so: dependencies, the scene, the outputs and the code."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

import grainfront

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    """Fenced blocks of one language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", README, flags=re.MULTILINE | re.DOTALL)


def test_each_dependency_has_its_reason():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = project["dependencies"] + project["optional-dependencies"]["slurm"]
    required = [re.match(r"[\w-]+", line)[0] for line in lines]
    table = re.search(r"\| dependency \| .*?\n\|[-|]+\n((?:\|.*\n)+)", README)
    assert table is not None
    assert re.findall(r"^\| ([\w-]+) \|", table[1], flags=re.MULTILINE) == required


def test_the_scene_is_the_real_one():
    (quoted,) = blocks("yaml")
    assert quoted in (ROOT / "config" / "scenes" / "river_gravel.yaml").read_text(encoding="utf-8")


def test_links_lead_to_files():
    links = [link for link in re.findall(r"\]\(([^)]+)\)", README) if "://" not in link]
    assert "LICENSE" in links
    assert [link for link in links if not (ROOT / link).exists()] == []


def test_pictures_are_small():
    pictures = list((ROOT / "docs" / "images").iterdir())
    assert pictures
    assert all(picture.stat().st_size < 400_000 for picture in pictures)


def test_the_code_runs(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "config").symlink_to(ROOT / "config")
    folder = tmp_path / "results" / "river_gravel" / "1"
    folder.mkdir(parents=True)
    notebook, with_xarray = blocks("python")

    found: dict[str, object] = {}
    exec(notebook.replace("river_gravel", "tiny"), found)
    packing = found["packing"]
    grainfront.write_packing(folder / "packing.nc", packing, found["scene"], seed=1)
    exec(with_xarray, found)
    assert len(found["grains"]) == len(found["polygons"]) == packing.x.size
    area = sum(grain.area for grain in found["grains"])
    assert area == pytest.approx(packing.area.sum(), rel=1e-12)
