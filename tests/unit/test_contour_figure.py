"""The contour map: extremes and target where the numbers have them, equal bytes, any shape."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.contour import ContourSet

from grainfront import figures

N_ANGLE, N_LOC = np.array([1, 6, 24]), np.array([1, 5, 20, 40])
FRACTION = 0.69 + 0.02 * np.log2(N_ANGLE)[:, None] + 0.01 * np.log2(N_LOC)
LOWER, UPPER = FRACTION[0, 0], FRACTION[-1, -1]


def figure(angles=3, locs=4, target=None, seeds=3):
    return figures.contour(
        N_ANGLE[:angles], N_LOC[:locs], FRACTION[:angles, :locs], seeds=seeds, target=target
    )


def legend(drawn) -> list[str]:
    return [text.get_text() for text in drawn.legends[0].get_texts()]


def hatched_regions(drawn) -> list[ContourSet]:
    found = drawn.axes[0].collections
    return [c for c in found if isinstance(c, ContourSet) and "///" in c.hatches]


@pytest.mark.parametrize(("angles", "locs"), [(3, 4), (1, 4), (3, 1), (1, 1)])
@pytest.mark.parametrize("target", [None, 0.7])
def test_any_sweep_is_drawn_with_equal_bytes(tmp_path, angles, locs, target):
    for name in ("a.png", "b.png"):
        figures.save_png(figure(angles, locs, target), tmp_path / name)
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert (tmp_path / "a.png").stat().st_size > 10_000


def test_a_flat_map_is_drawn(tmp_path):
    flat = figures.contour(N_ANGLE, N_LOC, np.full((3, 4), 0.7), seeds=1, target=0.7)
    figures.save_png(flat, tmp_path / "flat.png")


def test_the_extremes_are_named_with_their_places():
    lower, upper = legend(figure())
    assert f"{LOWER:.4f}" in lower and "= 1," in lower and lower.endswith("= 1")
    assert f"{UPPER:.4f}" in upper and "= 24," in upper and upper.endswith("= 40")


def test_effort_is_on_logarithmic_axes():
    axes = figure().axes[0]
    marks = {tuple(map(float, line.get_xydata()[0])) for line in axes.lines[-2:]}
    assert marks == {(0.0, 0.0), (np.log2(24), np.log2(40))}
    assert [t.get_text() for t in axes.get_xticklabels()] == ["1", "6", "24"]
    assert [t.get_text() for t in axes.get_yticklabels()] == ["1", "5", "20", "40"]


def test_the_region_that_reaches_the_target_is_hatched():
    drawn = figure(target=0.75)
    hatched = hatched_regions(drawn)
    assert [c.levels.tolist() for c in hatched] == [[0.75, np.inf]]
    (path,) = hatched[0].get_paths()
    within = path.contains_points([(np.log2(24), np.log2(40) - 0.01), (0.1, 0.1)])
    assert within.tolist() == [True, False]
    assert legend(drawn)[-1] == "target = 0.75"


def test_a_target_out_of_reach_is_said_to_be():
    drawn = figure(target=0.95)
    assert hatched_regions(drawn) == []
    assert legend(drawn)[-1] == "target = 0.95 (not reached)"


@pytest.mark.parametrize(
    ("seeds", "title"), [(1, "one packing each"), (3, "mean of 3 packings each")]
)
def test_the_title_counts_the_seeds(seeds, title):
    assert title in figure(seeds=seeds).axes[0].get_title(loc="left")
