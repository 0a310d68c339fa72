"""Errors of area, perimeter, descriptors and volume fraction against the outlines' vertices."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainfront.figures.error_vs_time.marks import (
    HALO,
    TWO_PANELS,
    Quantities,
    marks,
    medians,
    powers_of_ten,
    ring,
    say,
)
from grainfront.figures.style import ACCENT, BRANCH, PLACED, PRESCRIBED, panel_letter

COLOURS = {
    "area": PLACED,
    "perimeter": BRANCH,
    "aspect_ratio": ACCENT,
    "circularity": "#cc79a7",  # Okabe & Ito (2008), as those of `style`
    "convexity": "#e69f00",
}


def draw_outlines(figure: Figure, found: Quantities) -> None:
    """Errors over the vertices; the errors that decide over the kernel time."""
    figure.set_size_inches(*TWO_PANELS)
    left, right = figure.subplots(1, 2, sharey=True)
    coarser = found["tolerance"] > 0.0
    panel_letter(left, "a", f"against outlines of {found['vertices'][0]:.0f} vertices")
    panel_letter(right, "b", "what they cost")
    for axes in (left, right):
        powers_of_ten(axes)
    left.set_xlabel("vertices of an outline, on average")
    right.set_xlabel("kernel time (s)")
    left.set_ylabel("relative error; absolute error of the fraction")
    if not coarser.any():
        left.text(0.5, 0.5, "nothing to simplify:\nthese outlines have no more\nvertices than "
                  "they need", transform=left.transAxes, ha="center")  # fmt: skip
        return
    kept = {name: value[coarser] for name, value in found.items()}
    for name, colour in COLOURS.items():
        _curve(left, kept["vertices"], kept[f"{name}_error"], colour, name.replace("_", " "))
    _draw_fraction(left, kept["vertices"], kept)
    _draw_floor(left, found)
    _draw_costs(right, kept)


def _curve(axes: Axes, x: np.ndarray, y: np.ndarray, colour: str, name: str) -> None:
    axes.plot(x, y, "o-", color=colour, markersize=3, linewidth=1, label=name)


def _draw_fraction(axes: Axes, x: np.ndarray, found: Quantities) -> None:
    marks(axes, x, found["volume_fraction_error"], PRESCRIBED, marker="D", label="volume fraction")


def _draw_floor(axes: Axes, found: Quantities) -> None:
    """How far fractions of equal outlines differ from seed to seed."""
    of_reference = found["volume_fraction"][found["tolerance"] == 0.0]
    scatter = float(np.ptp(of_reference))
    if scatter > 0.0:
        axes.axhline(scatter, color=PRESCRIBED, linewidth=0.8, linestyle=(0, (4, 3)))
        axes.text(
            0.98, 1.1 * scatter, "range of the fraction over seeds", ha="right", fontsize=6.5,
            color=PRESCRIBED, transform=axes.get_yaxis_transform(), path_effects=HALO,
        )  # fmt: skip
    axes.legend(loc="lower left")


def _draw_costs(axes: Axes, found: Quantities) -> None:
    marks(axes, found["kernel_s"], found["perimeter_error"], COLOURS["perimeter"], linestyle="-",
          label="perimeter; vertices beside it")  # fmt: skip
    _draw_fraction(axes, found["kernel_s"], found)
    time = medians(found["kernel_s"])
    for x, y, vertices in zip(time, found["perimeter_error"], found["vertices"], strict=True):
        say(axes, x, y, f"{vertices:.0f}", color=COLOURS["perimeter"])
    ring(axes, found["kernel_s"], found["perimeter_error"], found["pareto"])
    axes.legend(loc="lower left")
