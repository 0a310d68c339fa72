"""The stability matrix at a glance, and the clearance beside the rounding it must stay above."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogFormatterMathtext

from grainfront.figures.style import (
    ACCENT,
    BRANCH,
    INK,
    MM,
    PLACED,
    PRESCRIBED,
    WIDTH,
    panel_letter,
    styled,
)  # fmt: skip

Quantities = Mapping[str, np.ndarray]

PLAIN_COLOUR, OPTIMISED_COLOUR = PLACED, PRESCRIBED
LINE = 2.9 * MM  # of the list of cases
RATIO_COLOURS = (INK, BRANCH, ACCENT, PRESCRIBED)


@styled
def stability(found: Quantities) -> Figure:
    """Volume fraction, time and E2 of every case beside those of the moderate one."""
    cases = list(dict.fromkeys(found["case"]))
    figure = Figure(figsize=(WIDTH, LINE * len(cases) + 28 * MM))
    panels = figure.subplots(1, 3, sharey=True)
    place = -np.array([cases.index(name) for name in found["case"]], dtype=float)
    plain = (found["n_angle"] == 1) & (found["n_loc"] == 1)
    with np.errstate(invalid="ignore", divide="ignore"):
        errors = [found[f"{law}_l2_error"] / found[f"{law}_noise_level"]
                  for law in ("size", "orientation")]  # fmt: skip
    worst = np.fmax(*errors)
    shown = (found["relative_fraction"], found["growth"], worst)
    titles = ("volume fraction", "kernel time a particle", "E2")
    labels = ("over the moderate case's", "over the moderate case's",
              "the larger of S and α,\nover its noise level")  # fmt: skip
    for axes, values, letter, title, label in zip(
        panels, shown, "abc", titles, labels, strict=True
    ):
        axes.set_xlabel(label)
        panel_letter(axes, letter, title)
        _grid(axes, len(cases))
        for which, colour, effort in (
            (plain, PLAIN_COLOUR, "n_angle = n_loc = 1"),
            (~plain, OPTIMISED_COLOUR, "24 / 20, or as named"),
        ):
            axes.plot(values[which], place[which], "o", color=colour, markersize=3, label=effort)
        axes.set_xscale("log")
        axes.axvline(1.0, color=INK, linewidth=0.6)
    refused = np.unique(place[found["refusal"] != ""])
    for y in refused:
        panels[0].text(1.1, y, "refused", va="center", fontsize=6)
    panels[1].plot(found["most_growth"], place, "|", color=INK, markersize=5, label="most allowed")
    figure.legend(*panels[1].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    panels[0].set_yticks(-np.arange(len(cases), dtype=float), cases, fontsize=6)
    panels[0].set_ylim(0.7 - len(cases), 0.7)
    return figure


def _grid(axes: Axes, lines: int) -> None:
    axes.hlines(-np.arange(0, lines, 2, dtype=float), 0, 1, transform=axes.get_yaxis_transform(),
                color="#e8e8e8", linewidth=0.5, zorder=0)  # fmt: skip
    axes.tick_params(left=False)


@styled
def clearance(found: Quantities) -> Figure:
    """Clearance above rounding, over offset, size ratio and edges; and the gaps of contacts."""
    figure = Figure(figsize=(WIDTH, 80 * MM))
    left, middle, right = figure.subplots(1, 3, width_ratios=(1.4, 0.8, 1.1))
    panel_letter(left, "a", "clearance, and where overlaps begin")
    panel_letter(middle, "b", "the same over edges")
    panel_letter(right, "c", "gaps of the contacts")
    _draw_clearance(left, found)
    _draw_edges(middle, found)
    _draw_gaps(right, found)
    return figure


def _draw_clearance(axes: Axes, found: Quantities) -> None:
    """A line of clearance for each size ratio, and one of the rounding below it."""
    ulp = found["clearance"] / found["clearance_ulps"]
    mean = found["offset"][1:]
    for i, ratio in enumerate(found["size_ratio"]):
        colour = RATIO_COLOURS[i % len(RATIO_COLOURS)]
        axes.plot(mean, found["clearance"][i, 1:], "-", color=colour, linewidth=1.0,
                  label=f"sizes 1:{ratio:g}")  # fmt: skip
        axes.plot(mean, (found["rounding"] * ulp)[i, 1:], "x--", color=colour, linewidth=0.7,
                  markersize=3)  # fmt: skip
    axes.plot([], [], "-", color=INK, label="clearance")
    axes.plot([], [], "x--", color=INK, linewidth=0.7, markersize=3,
              label="with so little, overlaps")  # fmt: skip
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(LogFormatterMathtext())
    axes.set_ylim(top=300.0 * float(found["clearance"].max()))  # room for the legend
    axes.set_xlabel("offset of the domain from the origin (mean sizes)")
    axes.set_ylabel("length (smallest sizes)")
    axes.legend(loc="upper left")


def _draw_edges(axes: Axes, found: Quantities) -> None:
    """Clearance and rounding, in ulps, over the number of edges."""
    axes.axhline(float(found["clearance_ulps"]), color=INK, linewidth=1.0)
    axes.plot(found["edges"], found["edges_rounding"], "x--", color=INK, linewidth=0.7,
              markersize=3)  # fmt: skip
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("edges of each particle")
    axes.set_ylabel("units in the last place")


def _draw_gaps(axes: Axes, found: Quantities) -> None:
    """Runs in the order of their median gap: 5 to 95 %, and the median."""
    known = found["gaps"][np.isfinite(found["gaps"]).all(axis=1)]
    at = [int(np.argmin(np.abs(found["gap_quantile"] - q))) for q in (0.0, 0.05, 0.5, 0.95)]
    least, low, median, high = known[np.argsort(known[:, at[2]], kind="stable")][:, at].T
    run = np.arange(median.size)
    axes.vlines(run, low, high, color=PLACED, linewidth=1.2, label="5 to 95 % of the contacts")
    axes.plot(run, median, ".", color=BRANCH, markersize=3, label="median")
    axes.plot(run, least, ".", color=PRESCRIBED, markersize=3, label="least")
    axes.axhline(0.75, color=INK, linewidth=0.6, linestyle="--", label="clearance less tolerance")
    axes.set_yscale("log")
    axes.set_xlabel("run, in the order of the median")
    axes.set_ylabel("gap (clearances)")
    axes.legend(loc="upper left")
