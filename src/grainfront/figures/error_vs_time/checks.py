"""Shares of the steps of a scene in its CPU time."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from grainfront.figures.error_vs_time.marks import BAR, Quantities, medians, spread
from grainfront.figures.style import INK, MM, PLACED


def draw_checks(figure: Figure, found: Quantities) -> None:
    """A bar a step, with its seconds."""
    figure.set_size_inches(120 * MM, 60 * MM)
    axes = figure.subplots()
    place = np.arange(found["step"].size)[::-1]
    share, seconds = medians(found["share"]), medians(found["cpu_s"])
    axes.barh(place, share, color=PLACED, height=0.7)
    axes.errorbar(share, place, xerr=spread(found["share"]), color=INK, linestyle="none", **BAR)
    right = (share + spread(found["share"])[1]).max()
    for y, one in zip(place, seconds, strict=True):
        axes.text(right * 1.04, y, f"{one:.2g} s", va="center")
    axes.set_title(
        f"CPU time of a packing with its proof, statistics and files: {seconds.sum():.2g} s"
    )
    axes.set_yticks(place, list(found["step"]))
    axes.set_xlim(0.0, right * 1.15)
    axes.set_xlabel("share of the CPU time")
    axes.xaxis.set_major_formatter(lambda value, _: f"{100 * value:.0f} %")
    axes.tick_params(left=False)
