"""Pictures of the stability matrix: everything is in them, and they repeat."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from grainfront import figures

sys.path.insert(0, str(Path(__file__).parent / "files"))
import synthetic_stability


@pytest.mark.parametrize("picture", ["stability", "clearance"])
def test_a_picture_is_no_blank_sheet_and_repeats(picture, tmp_path):
    for name in ("a.png", "b.png"):
        figure = getattr(figures, picture)(synthetic_stability.quantities())
        figures.save_png(figure, tmp_path / name)
    drawn = (tmp_path / "a.png").read_bytes()
    assert drawn == (tmp_path / "b.png").read_bytes()
    assert 15_000 < len(drawn) < 400_000


def test_every_case_has_its_line_and_the_refused_say_so():
    axes = figures.stability(synthetic_stability.quantities()).axes[0]
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert names == ["moderate", "2000 edges", "far away"]
    assert [text.get_text() for text in axes.texts] == ["refused"]


def test_the_rounding_is_drawn_in_lengths_below_its_clearance():
    found = synthetic_stability.quantities()
    found["rounding"] = np.full_like(found["clearance"], 2.0)
    axes = figures.clearance(found).axes[0]
    lines = [line for line in axes.lines if len(line.get_ydata())]
    clearance, rounding = lines[0].get_ydata(), lines[1].get_ydata()
    assert rounding == pytest.approx(clearance / 32.0)
