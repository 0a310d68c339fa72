"""L2 errors of the laws against the way of drawing and the number of bins."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainfront.figures.error_vs_time.marks import (
    TWO_PANELS,
    Quantities,
    marks,
    medians,
    percent,
    plain_numbers,
    ring,
    say,
)
from grainfront.figures.style import ACCENT, BRANCH, INK, PRESCRIBED, panel_letter

LAWS = {"size": ("o", 0.94), "descriptor": ("s", 1.0), "orientation": ("^", 1.06)}
WITHOUT_BINS = {"independent": INK, "stratified": ACCENT}


def draw_drawing(figure: Figure, found: Quantities) -> None:
    """Values drawn alone in three ways; orientations as the packing places them."""
    figure.set_size_inches(*TWO_PANELS)
    left, right = figure.subplots(1, 2, sharey=True)
    panel_letter(left, "a", f"{int(medians(found['particles'])[0]):,} values drawn")
    panel_letter(right, "b", "orientations placed")
    _draw_alone(left, found)
    _draw_placed(right, found)
    for axes in (left, right):
        axes.set_yscale("log")
        percent(axes)
        bins = np.unique(found["n_bin"][found["n_bin"] > 0])
        plain_numbers(axes, bins)
        axes.set_xlim(0.65 * bins[0], 1.5 * bins[-1])
        axes.set_xlabel("bins whose deficits steer")
    left.set_ylabel("L2 error $E_2$ in 24 bins")


def _draw_alone(axes: Axes, found: Quantities) -> None:
    with_bins = found["method"] == "deficit-controlled"
    for law, (marker, shift) in LAWS.items():
        if np.isnan(found[f"{law}_l2_error"]).all():
            continue
        marks(axes, found["n_bin"][with_bins] * shift, found[f"{law}_l2_error"][with_bins], BRANCH,
              marker=marker, label=law)  # fmt: skip
    axes.legend(title="deficit-controlled, " + _milliseconds(found, with_bins), loc="lower left")
    for method, colour in WITHOUT_BINS.items():
        of = found["method"] == method
        errors = np.array([found[f"{law}_l2_error"][of] for law in LAWS])
        axes.axhspan(np.nanmin(errors), np.nanmax(errors), color=colour, alpha=0.2, linewidth=0)
        middle = float(np.nanmedian(errors))
        axes.axhline(middle, color=colour, linewidth=1)
        say(axes, 0.7, middle, f"{method}, {_milliseconds(found, of)}", color=colour)


def _milliseconds(found: Quantities, of: np.ndarray) -> str:
    return f"{1e3 * np.median(found['cpu_s'][of]):.2g} ms"


def _draw_placed(axes: Axes, found: Quantities) -> None:
    placed = found["method"] == "packing"
    colours = (ACCENT, PRESCRIBED)
    for n_angle, colour in zip(np.unique(found["n_angle"][placed]), colours, strict=False):
        of = placed & (found["n_angle"] == n_angle)
        n_bin, error = found["n_bin"][of], found["orientation_l2_error"][of]
        marks(axes, n_bin, error, colour, linestyle="-",
              label=f"n_angle = {n_angle}, {np.median(found['cpu_s'][of]):.2g} s")  # fmt: skip
    ring(axes, found["n_bin"][placed], found["orientation_l2_error"][placed],
         found["pareto"][placed])  # fmt: skip
    axes.legend(loc="lower left")
