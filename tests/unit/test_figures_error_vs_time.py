"""Work-precision diagrams: every axis is drawn, from what the record holds, and readably."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from grainfront import figures
from grainfront.figures.error_vs_time import AXES as DRAWN
from grainfront.figures.error_vs_time.marks import medians, spread
from grainfront.files.error_vs_time import AXES

sys.path.insert(0, str(Path(__file__).parent / "files"))
import synthetic_errors


def record(axis):
    """Quantities of one axis, such as a study could find."""
    found = synthetic_errors.records(np.random.default_rng(1), n_seeds=3, n_repeats=2)[axis]
    if axis == "effort":
        found |= {"n_angle": np.array([1, 1, 24, 24]), "n_loc": np.array([1, 20, 1, 20])}
        found["pareto"] = np.array([1, 0, 1, 1])
    if axis == "outlines":
        found |= {"tolerance": np.array([0.0, 0.064, 0.016, 0.004])}
        found |= {"vertices": np.array([500.0, 9.0, 20.0, 42.0])}
    if axis == "drawing":
        found |= {"n_bin": np.array([0, 0, 24, 24]), "n_angle": np.array([0, 0, 0, 24])}
    if axis == "domain":
        found |= {"n_angle": np.array([1, 1, 24, 24]), "n_loc": np.array([1, 1, 20, 20])}
        found |= {"fit_n_angle": np.array([1, 24]), "fit_n_loc": np.array([1, 20])}
        found["particles"] = np.array([[100] * 3, [1000] * 3, [110] * 3, [1200] * 3])
    return found


def labels(figure):
    return [text.get_text() for axes in figure.axes for text in axes.texts]


def test_every_axis_of_the_file_is_drawn():
    assert set(DRAWN) == set(AXES)


@pytest.mark.parametrize("axis", AXES)
def test_a_picture_is_no_blank_sheet_and_repeats(axis, tmp_path):
    for name in ("a.png", "b.png"):
        figures.save_png(figures.error_vs_time(axis, record(axis)), tmp_path / name)
    picture = (tmp_path / "a.png").read_bytes()
    assert picture == (tmp_path / "b.png").read_bytes()
    assert 15_000 < len(picture) < 400_000


def test_marks_are_medians_and_bars_reach_the_least_and_the_largest():
    values = np.array([[[1.0, 5.0], [2.0, 9.0]], [[3.0, 3.0], [3.0, 4.0]]])
    assert medians(values).tolist() == [3.5, 3.0]
    assert spread(values).tolist() == [[2.5, 0.0], [5.5, 1.0]]


def test_the_front_is_named_by_its_efforts():
    assert labels(figures.error_vs_time("effort", record("effort"))) == [
        "1 / 1",
        "24 / 1",
        "24 / 20",
    ]


def test_the_exponents_are_shown():
    found = record("domain") | {"exponent": np.array([1.04, 0.87])}
    shown = " ".join(labels(figures.error_vs_time("domain", found)))
    assert "1.04" in shown and "0.87" in shown


def test_outlines_that_cannot_be_simplified_say_so():
    found = {name: array[:1] for name, array in record("outlines").items()}
    assert "nothing to simplify" in labels(figures.error_vs_time("outlines", found))[0]


def test_drawing_without_a_law_of_a_descriptor_is_drawn(tmp_path):
    found = record("drawing") | {"descriptor_l2_error": np.full((4, 3), np.nan)}
    figure = figures.error_vs_time("drawing", found)
    assert "descriptor" not in [t.get_text() for t in figure.axes[0].get_legend().get_texts()]
    figures.save_png(figure, tmp_path / "drawing.png")
