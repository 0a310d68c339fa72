"""`grainfront effort`: what it prints, and what it says of bad input."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from grainfront.cli import FAULTY_INPUT, main

SCENE = """
seed: 3
domain: {width: 14, height: 14}
shapes: {family: {fourier_grain: {count: 30, d2: 0.15, d3: 0.1}}}
size: {uniform: {minimum: 1, maximum: 2}}
orientation: {uniform: {minimum: 0, maximum: 180}}
"""
FIELDS = [
    "target", "n_angle", "n_loc", "volume_fraction", "spread", "particles", "kernel_s", "pilots",
    "pilot_s", "compile_s",
]  # fmt: skip


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "s.yaml").write_text(SCENE)
    return tmp_path


def refused(capsys, *arguments: str) -> str:
    """The one sentence that is said of bad input."""
    assert main(["effort", *arguments]) == FAULTY_INPUT == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("grainfront: ") and said.err.endswith(".\n")
    assert said.err.count("\n") == 1
    return said.err


def test_one_json_object_tells_pair_and_expectation(capsys):
    assert main(["effort", "s.yaml", "--target", "0.75", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert list(found) == FIELDS
    assert found["target"] == 0.75
    assert found["volume_fraction"] == pytest.approx(0.75, abs=0.05)
    assert 30 < found["particles"] < 120
    assert found["pilots"] > 30 and found["pilot_s"] > found["kernel_s"] > 0.0


def test_that_regions_are_left_out_is_told(folder, capsys):
    circle = "{inside: {circle: {centre: [7, 7], radius: 4}}, size: {finer_than: auto}}"
    (folder / "s.yaml").write_text(f"{SCENE}arrangement: {{regions: [{circle}]}}\n")
    assert main(["effort", "s.yaml", "--target", "0.75"]) == 0
    told = capsys.readouterr().err
    assert "warning: s.yaml: the pilot packings leave its regions out" in told


def test_the_scene_may_have_the_target(folder, capsys):
    scene = "target_volume_fraction: 0.72\nreplacement: true\n" + SCENE
    (folder / "s.yaml").write_text(scene)
    assert main(["effort", "s.yaml"]) == 0
    said = capsys.readouterr().out
    assert said.startswith("n_angle ")
    assert "reach 0.72" in said and "of the outlines of 0.7" in said and "±" in said


def test_without_any_target_one_is_asked_for(capsys):
    said = refused(capsys, "s.yaml")
    assert "s.yaml" in said and "--target" in said and "target_volume_fraction" in said


def test_a_target_out_of_reach_is_told_with_the_range(capsys):
    said = refused(capsys, "s.yaml", "--target", "0.95")
    assert "0.95 is out of reach" in said and "n_angle 48, n_loc 40" in said


def test_a_scene_that_is_not_there_is_told(capsys):
    assert "no.yaml" in refused(capsys, "no.yaml", "--target", "0.8")


@pytest.mark.parametrize("target", ["0", "1", "-0.1", "nan", "dense"])
def test_targets_are_fractions(capsys, target):
    with pytest.raises(SystemExit) as stopped:
        main(["effort", "s.yaml", f"--target={target}"])
    assert stopped.value.code == 2
    assert f"is {target}, but must be a number between 0 and 1" in capsys.readouterr().err
