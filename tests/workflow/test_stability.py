"""`snakemake stability`: what it plans, what its stages write, and that failing cases are named."""

from __future__ import annotations

import dataclasses
import json
import subprocess
import sys

import numpy as np
import pytest

import grainfront.studies.stability as study
from grainfront import stages
from grainfront.files.stability import read_stability
from grainfront.studies.stability.case import MODERATE, PLAIN, square

SMALL = dataclasses.replace(MODERATE, domain=square(8.0), efforts=(PLAIN,), seeds=2)


def measure(cases):
    """The study, of a few cases and a few offsets."""
    whole = study.measure_stability
    return lambda: whole(cases, ratios=(1.0,), offsets=(0.0, 1e3), edges=(4,))


def test_the_target_plans_a_record_and_a_report_whatever_the_scenes(project):
    assert project.planned("--", "stability") == {
        "stability": 1, "stability_record": 1, "stability_report": 1
    }  # fmt: skip
    assert not {"stability_record", "stability_report"} & set(project.planned())


SMALL_STUDY = """
import dataclasses, json, sys
import grainfront.files.stability
from grainfront import stages
from grainfront.studies.stability import measure_stability
from grainfront.studies.stability.case import MODERATE, PLAIN, square
small = dataclasses.replace(MODERATE, domain=square(8.0), efforts=(PLAIN,), seeds=1)
measure_stability({"small": small}, ratios=(10.0,), offsets=(0.0,), edges=(4,))
print(json.dumps(sorted(sys.modules)))
"""


def test_the_digest_covers_what_the_study_imports():
    command = [sys.executable, "-c", SMALL_STUDY]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    modules = json.loads(run.stdout)
    covered = stages.SOURCES["stability"]
    ours = [name.removeprefix("grainfront.") for name in modules if name.startswith("grainfront.")]
    uncovered = [
        name
        for name in ours
        if not any(f"{name}.".startswith(f"{part}.") for part in covered)
        and not any(part.startswith(f"{name}.") for part in covered)  # an __init__ above
    ]
    assert uncovered == []
    assert not {"matplotlib", "pyvista", "skimage"} & {name.split(".")[0] for name in modules}


def test_record_table_and_pictures_are_written(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "measure_stability", measure({"moderate": SMALL}))
    record = str(tmp_path / "stability.nc")
    stages.stability(record=record)
    pictures = [str(tmp_path / name) for name in ("stability.png", "clearance.png")]
    stages.stability_report(
        record=record, table=str(tmp_path / "stability.md"),
        matrix_picture=pictures[0], clearance_picture=pictures[1],
    )  # fmt: skip
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"stability.nc", "stability.md", "stability.png", "clearance.png"}
    found = read_stability(record)
    assert found["case"].tolist() == ["moderate"]
    assert np.all(found["drawn"] == found["particles"] + found["left_over"])
    assert "| moderate | 1 / 1 |" in (tmp_path / "stability.md").read_text(encoding="utf-8")


def test_a_failing_case_is_named_in_one_sentence_and_nothing_is_written(tmp_path, monkeypatch):
    wrong = dataclasses.replace(SMALL, name="too dense", volume_fraction=0.99)
    monkeypatch.setattr(study, "measure_stability", measure({"too dense": wrong}))
    with pytest.raises(SystemExit) as end:
        stages.stability(record=str(tmp_path / "stability.nc"))
    assert str(end.value).startswith("grainfront: stability: 1 expectations are not met: too dense")
    assert list(tmp_path.iterdir()) == []
