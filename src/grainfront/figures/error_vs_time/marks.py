"""Medians with the spread of seeds and repeats, and what all work-precision diagrams share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FuncFormatter, LogFormatterMathtext

from grainfront.figures.style import INK, MM, WIDTH

Quantities = Mapping[str, np.ndarray]

TWO_PANELS = (WIDTH, 78 * MM)
HALO = [withStroke(linewidth=2, foreground="white")]
LABEL: dict[str, Any] = {"fontsize": 6.5, "color": INK, "path_effects": HALO}
MARK: dict[str, Any] = {"marker": "o", "linestyle": "none", "linewidth": 1.0}
BAR: dict[str, Any] = {"elinewidth": 0.5, "capsize": 0, "markersize": 3.5}


def medians(values: np.ndarray) -> np.ndarray:
    """Medians over seeds and repeats, shape (n_points,)."""
    return np.median(values.reshape(len(values), -1), axis=1)


def spread(values: np.ndarray) -> np.ndarray:
    """How far the least and the largest are from the median, shape (2, n_points)."""
    flat = values.reshape(len(values), -1)
    middle = medians(values)
    return np.array([middle - flat.min(axis=1), flat.max(axis=1) - middle])


def marks(axes: Axes, x: np.ndarray, y: np.ndarray, colour: str, **style: Any) -> None:
    """Marks at the medians of `x` and `y`, (n_points, ...), with bars from least to largest."""
    axes.errorbar(
        medians(x), medians(y), yerr=spread(y), xerr=spread(x), color=colour, **(MARK | BAR | style)
    )


def ring(axes: Axes, x: np.ndarray, y: np.ndarray, pareto: np.ndarray) -> None:
    """Rings round the points on the Pareto front."""
    front = pareto == 1
    axes.plot(
        medians(x)[front], medians(y)[front], "o", markersize=7, markerfacecolor="none",
        markeredgecolor=INK, markeredgewidth=0.7, label="on the Pareto front",
    )  # fmt: skip


def say(axes: Axes, x: float, y: float, text: str, **style: Any) -> None:
    """A label beside a point, legible over lines; offsets are in points of print."""
    offset = style.pop("offset", (4, 4))
    axes.annotate(
        text, (x, y), xytext=offset, textcoords="offset points",
        **(LABEL | style),
    )  # fmt: skip


def percent(axes: Axes) -> None:
    """Show the shares of the y axis in percent."""
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100 * value:g} %"))


def plain_numbers(axes: Axes, values: np.ndarray) -> None:
    """Ticks of a logarithmic x axis at these whole numbers, and nowhere else."""
    axes.set_xscale("log")
    axes.set_xticks(values, [f"{value:,}" for value in values])
    axes.set_xticks([], minor=True)


def powers_of_ten(axes: Axes) -> None:
    """Both axes logarithmic, their ticks at powers of ten."""
    axes.set_xscale("log")
    axes.set_yscale("log")
    for one in (axes.xaxis, axes.yaxis):
        one.set_major_formatter(LogFormatterMathtext())
