"""Deficit of the volume fraction against kernel time, over n_angle and n_loc."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainfront.figures.error_vs_time.marks import Quantities, marks, medians, say
from grainfront.figures.style import ACCENT, BRANCH, INK, MM, PLACED, PRESCRIBED

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
    axes.set_xlabel("kernel time (s)")
    axes.set_ylabel("deficit of the volume fraction to the best")
    axes.set_title(f"{int(medians(found['particles']).max()):,} grains; best fraction {best:.3f}")
    on_the_right = axes.secondary_yaxis(
        "right", functions=(lambda deficit: best - deficit, lambda fraction: best - fraction)
    )
    on_the_right.set_ylabel("volume fraction")
    axes.legend(loc="upper right")


def _draw_front(axes: Axes, found: Quantities) -> None:
    front = np.flatnonzero(found["pareto"])
    time, deficit = medians(found["kernel_s"])[front], medians(found["deficit"])[front]
    order = np.argsort(time)
    axes.step(
        time[order], deficit[order], where="post", color=PRESCRIBED, linewidth=1, zorder=1,
        label="Pareto front, n_angle / n_loc",
    )  # fmt: skip
    for x, y, i in zip(time, deficit, front, strict=True):
        text = f"{found['n_angle'][i]} / {found['n_loc'][i]}"
        say(axes, x, y, text, offset=(-3, -3), ha="right", va="top", color=PRESCRIBED)
