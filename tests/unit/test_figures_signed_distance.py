"""The contours of signed distances: what is drawn where."""

import numpy as np
import pytest
from matplotlib.contour import ContourSet

from grainfront.figures.signed_distance import signed_distance
from grainfront.particles import Rectangle

DOMAIN = Rectangle(0.0, 0.0, 20.0, 10.0)
X, Y = np.meshgrid(np.linspace(0, 20, 81), np.linspace(0, 10, 41))
DISC = np.hypot(X - 12.0, Y - 4.0) - 3.0


def test_the_zero_line_is_the_boundary():
    figure = signed_distance([DISC], ["disc"], DOMAIN, length_unit="mm")
    axes = figure.axes[0]
    assert axes.get_xlim() == (0, 20) and axes.get_ylim() == (0, 10)
    zero = next(
        c for c in axes.collections if isinstance(c, ContourSet) and list(c.levels) == [0.0]
    )
    nodes = np.concatenate([path.vertices for path in zero.get_paths()])
    assert np.hypot(nodes[:, 0] - 12.0, nodes[:, 1] - 4.0) == pytest.approx(3.0, abs=0.01)


def test_one_panel_a_zone_and_none_for_what_is_not_there():
    nothing = np.full(DISC.shape, np.inf)
    figure = signed_distance([DISC, nothing, -DISC], list("abc"), DOMAIN, length_unit="m")
    titled = [axes for axes in figure.axes if axes.get_title("left")]
    assert len(titled) == 3
    assert len(titled[1].collections) == 0 and len(titled[2].collections) > 0
    assert "(m)" in titled[0].get_xlabel()
