"""Wall effect and kernel time against the number of particles."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainfront.figures.error_vs_time.marks import (
    TWO_PANELS,
    Quantities,
    marks,
    medians,
    powers_of_ten,
    say,
)
from grainfront.figures.style import BRANCH, PRESCRIBED, panel_letter

# Colour and place of the label of the effort that takes less from the walls, and of the other.
BELOW, ABOVE = (BRANCH, (-50, -12)), (PRESCRIBED, (6, 4))


def draw_domain(figure: Figure, found: Quantities) -> None:
    """Both efforts: what the walls take, and what the domain costs, with the fitted power."""
    figure.set_size_inches(*TWO_PANELS)
    left, right = figure.subplots(1, 2)
    panel_letter(left, "a", "wall effect")
    panel_letter(right, "b", "cost")
    efforts = list(zip(found["fit_n_angle"], found["fit_n_loc"], strict=True))
    for k, (effort, (colour, offset)) in enumerate(zip(efforts, (BELOW, ABOVE), strict=False)):
        of = (found["n_angle"] == effort[0]) & (found["n_loc"] == effort[1])
        name = f"n_angle / n_loc = {effort[0]} / {effort[1]}"
        number = found["particles"][of]
        marks(left, number, found["wall_effect"][of], colour, label=name)
        _guide(left, number, found["wall_effect"][of], colour, offset)
        marks(right, number, found["kernel_s"][of], colour, label=name)
        _fit(right, number, found["exponent"][k], found["coefficient"][k], colour)
    for axes in (left, right):
        powers_of_ten(axes)
        axes.set_xlabel("particles N")
        axes.legend(loc="upper right" if axes is left else "upper left")
    left.set_ylabel("fraction of the bulk less that of the whole")
    right.set_ylabel("kernel time (s)")


def _guide(
    axes: Axes,
    particles: np.ndarray,
    wall_effect: np.ndarray,
    colour: str,
    offset: tuple[int, int],
) -> None:
    """The share of the walls' neighbourhood in the domain, through the points' middle."""
    number, effect = medians(particles), medians(wall_effect)
    level = float(np.median(effect * np.sqrt(number)))
    axes.plot(number, level / np.sqrt(number), color=colour, linewidth=0.8, linestyle=(0, (4, 3)))
    if level > 0.0:
        text = f"{level:.2f} $N^{{-1/2}}$"
        middle = float(np.sqrt(number[0] * number[-1]))
        say(axes, middle, level / np.sqrt(middle), text, color=colour, offset=offset)


def _fit(
    axes: Axes, particles: np.ndarray, exponent: float, coefficient: float, colour: str
) -> None:
    number = medians(particles)
    axes.plot(number, coefficient * number**exponent, color=colour, linewidth=0.8)
    middle = float(np.sqrt(number[0] * number[-1]))
    text = f"$\\propto N^{{{exponent:.2f}}}$"
    say(axes, middle, coefficient * middle**exponent, text, color=colour, offset=(5, -8))
