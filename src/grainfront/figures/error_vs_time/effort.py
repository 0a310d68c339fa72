"""Deficit of the volume fraction against kernel time, over n_angle and n_loc."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainfront.figures.error_vs_time.marks import Quantities, marks, medians, say
from grainfront.figures.style import ACCENT, BRANCH, INK, MM, PLACED, PRESCRIBED

# Labels this share of the picture apart do not touch.
APART = (0.09, 0.045)
# Families after Du et al. (2023), Fig. 15.
FAMILIES = (
    ("plain advancing front", INK, "s"),
    ("boundary only", ACCENT, "^"),
    ("orientation only", BRANCH, "v"),
    ("both", PLACED, "o"),
)


def draw_effort(figure: Figure, found: Quantities) -> None:
    """All pairs by family, and the Pareto front with its pairs by name."""
    figure.set_size_inches(150 * MM, 96 * MM)
    axes = figure.subplots()
    many_angles, many_places = found["n_angle"] > 1, found["n_loc"] > 1
    family = many_places + 2 * many_angles
    for number, (name, colour, marker) in enumerate(FAMILIES):
        of = family == number
        if of.any():
            marks(
                axes, found["kernel_s"][of], found["deficit"][of], colour, marker=marker, label=name
            )
    _draw_front(axes, found)
    best = medians(found["volume_fraction"]).max()
    axes.set_xscale("log")
    axes.set_xlabel(f"kernel time (s) of {int(medians(found['particles']).max()):,} grains")
    axes.set_ylabel(f"deficit of the volume fraction to the best, {best:.3f}")
    on_the_right = axes.secondary_yaxis(
        "right", functions=(lambda deficit: np.subtract(best, deficit),) * 2
    )
    on_the_right.set_ylabel("volume fraction")
    a_grain = 1e6 / float(np.median(found["particles"]))
    on_top = axes.secondary_xaxis(
        "top",
        functions=(lambda s: np.multiply(s, a_grain), lambda micro: np.divide(micro, a_grain)),
    )
    on_top.set_xlabel("µs a grain, about")
    _ring_own(axes, found)
    axes.legend(loc="upper right")


def _draw_front(axes: Axes, found: Quantities) -> None:
    front = np.flatnonzero(found["pareto"])
    time, deficit = medians(found["kernel_s"])[front], medians(found["deficit"])[front]
    order = np.argsort(time)
    axes.step(
        time[order], deficit[order], where="post", color=PRESCRIBED, linewidth=1, zorder=1,
        label="Pareto front, n_angle / n_loc",
    )  # fmt: skip
    for k in _apart(np.log(time), deficit):
        x, y, i = time[k], deficit[k], front[k]
        text = f"{found['n_angle'][i]} / {found['n_loc'][i]}"
        say(axes, x, y, text, offset=(-3, -3), ha="right", va="top", color=PRESCRIBED)


def _ring_own(axes: Axes, found: Quantities) -> None:
    """Ring the scene's own effort: half the largest of the axis."""
    own = (2 * found["n_angle"] == found["n_angle"].max()) & (
        2 * found["n_loc"] == found["n_loc"].max()
    )
    for i in np.flatnonzero(own):
        x, y = medians(found["kernel_s"])[i], medians(found["deficit"])[i]
        axes.plot(x, y, "o", markersize=11, fillstyle="none", color=INK)
        text = f"{found['n_angle'][i]} / {found['n_loc'][i]}, the scene's"
        say(axes, x, y, text, offset=(4, 8), ha="left", va="bottom", color=INK)


def _apart(x: np.ndarray, y: np.ndarray) -> list[int]:
    """Points of a curve, from its end on, that are so far from each other that labels fit."""
    width, height = max(float(np.ptp(x)), 1e-9), max(float(np.ptp(y)), 1e-9)
    kept: list[int] = []
    for i in np.argsort(x)[::-1]:
        across = np.abs(x[kept] - x[i]) / width
        along = np.abs(y[kept] - y[i]) / height
        if ((across > APART[0]) | (along > APART[1])).all():
            kept.append(int(i))
    return kept[::-1]
