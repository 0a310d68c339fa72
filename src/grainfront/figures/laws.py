"""The prescribed laws against what was placed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from grainfront.figures.style import INK, MM, PLACED, PRESCRIBED, WIDTH, panel_letter, styled

if TYPE_CHECKING:
    from grainfront.statistics import Distribution


@styled
def laws(distributions: Mapping[str, Distribution], *, length_unit: str) -> Figure:
    """A column a law: shares prescribed and placed, below them their difference.

    `distributions` maps the name of each prescribed law to its comparison with what was placed.
    """
    units = {"size": length_unit, "orientation": "degree"}
    figure = Figure(figsize=(WIDTH, 74 * MM))
    grid = figure.subplots(
        2, len(distributions), sharex="col", height_ratios=(2.6, 1), squeeze=False
    )
    for (top, bottom), letter, (law, placed) in zip(
        grid.T, "abcdefgh", distributions.items(), strict=False
    ):
        name = law.replace("_", " ")
        panel_letter(top, letter, name)
        constant = placed.edges[0] == placed.edges[-1]
        (_draw_constant if constant else _draw_bins)(top, bottom, placed)
        if law == "orientation" and not constant:
            bottom.xaxis.set_major_locator(MultipleLocator(45))
        bottom.set_xlabel(
            f"{name}{f' ({units[law]})' if law in units else ''}\n"
            f"$E_2$ = {_percent(placed.l2_error)}, noise level {_percent(placed.noise_level)}",
            linespacing=1.7,
        )
    grid[0, 0].set_ylabel("share of particles (%)")
    grid[1, 0].set_ylabel("difference\n(% points)")
    figure.align_ylabels(grid[:, 0])
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=2)
    return figure


def _draw_bins(top: Axes, bottom: Axes, law: Distribution) -> None:
    width = np.diff(law.edges)
    style: dict[str, Any] = {
        "color": PLACED,
        "align": "edge",
        "linewidth": 0.3,
        "edgecolor": "white",
    }
    top.bar(law.edges[:-1], 100 * law.shares, width, label="placed", **style)
    top.stairs(
        100 * law.probabilities, law.edges, color=PRESCRIBED, linewidth=1, label="prescribed"
    )
    top.set_xlim(law.edges[0], law.edges[-1])
    top.set_ylim(bottom=0)
    difference = 100 * (law.shares - law.probabilities)
    bottom.bar(law.edges[:-1], difference, width, **style)
    bottom.axhline(0, color=INK, linewidth=0.5)
    reach = 1.15 * float(np.abs(difference).max()) or 1.0
    bottom.set_ylim(-reach, reach)


def _draw_constant(top: Axes, bottom: Axes, law: Distribution) -> None:
    """A single value has no bins: one bar of the whole, a tenth of the value wide."""
    value = float(law.edges[0])
    width = 0.1 * abs(value) or 1.0
    top.bar(value, 100 * law.shares.sum(), width, color=PLACED, label="placed")
    top.plot(
        [value, value], [0, 100 * law.probabilities.sum()], color=PRESCRIBED, label="prescribed"
    )
    top.set_xlim(value - 5 * width, value + 5 * width)
    top.set_ylim(0, 105)
    top.annotate(f"constant: {value:g}", (value + 0.8 * width, 96), va="top")
    bottom.axhline(0, color=INK, linewidth=0.5)
    bottom.bar(value, 100 * (law.shares.sum() - law.probabilities.sum()), width, color=PLACED)
    bottom.set_ylim(-1, 1)


def _percent(share: float) -> str:
    return f"{100 * share:#.3g} %"
