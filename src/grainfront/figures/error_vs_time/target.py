"""Packings and time needed to reach a prescribed volume fraction within a tolerance."""

from __future__ import annotations

from matplotlib.figure import Figure

from grainfront.figures.error_vs_time.marks import (
    TWO_PANELS,
    Quantities,
    marks,
    medians,
    powers_of_ten,
    ring,
    say,
)
from grainfront.figures.style import BRANCH, INK, PRESCRIBED, panel_letter


def draw_target(figure: Figure, found: Quantities) -> None:
    """Packings over the tolerance; the deviation that is left over the time that it takes."""
    figure.set_size_inches(*TWO_PANELS)
    left, right = figure.subplots(1, 2)
    prescribed = float(found["prescribed"][0])
    panel_letter(left, "a", f"packings to reach the fraction {prescribed:.4g}")
    panel_letter(right, "b", "what a tolerance costs")
    tolerance, deviation, kernel_s = found["tolerance"], found["deviation"], found["kernel_s"]
    marks(left, tolerance, found["packings"], BRANCH)
    left.set_xscale("log")
    left.set_ylim(0.0, float(found["packings"].max()) + 1.0)
    left.set_xlabel("tolerance of the volume fraction")
    left.set_ylabel("packings needed, in whole packings")
    powers_of_ten(right)
    marks(right, kernel_s, deviation, PRESCRIBED, label="left to the target")
    right.plot(medians(kernel_s), tolerance, "_", color=INK, markersize=9, label="tolerance")
    ring(right, kernel_s, deviation, found["pareto"])
    for x, y in zip(medians(kernel_s), tolerance, strict=True):
        say(right, x, y, f"{y:g}")
    right.set_xlabel("kernel time of all packings (s)")
    right.set_ylabel("|volume fraction − prescribed|")
    right.legend(loc="lower left")
