"""One style for all pictures, and the one way in which they reach the disk."""

from __future__ import annotations

import functools
import os
from collections.abc import Callable
from typing import ParamSpec

import matplotlib.style
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from grainfront.files.atomic import replacing
from grainfront.particles import Rectangle

P = ParamSpec("P")

MM = 1 / 25.4  # inches
WIDTH = 180 * MM  # two columns of a journal page

INK = "#222222"
GRAIN = "#e6e2d8"
OUTSIDE = "#c8c8c8"  # what is no part of the domain
GRAIN_EDGE = "#a09a8a"
HULL = "#f6b8a0"  # seen between grains of any colour of the map of sizes, and on white
WINDOW = "#d00000"
# Okabe & Ito (2008): told apart by every kind of colour vision.
PLACED = "#56b4e9"
PRESCRIBED = "#d55e00"
ACCENT = "#009e73"
BRANCH = "#0072b2"
SIZE_MAP = "viridis"

STYLE = {
    "figure.dpi": 300,
    "figure.constrained_layout.use": True,
    "font.family": "DejaVu Sans",  # ships with matplotlib: the same letters everywhere
    "font.size": 7.5,
    "axes.titlesize": 8.5,
    "axes.titlelocation": "left",
    "axes.labelsize": 7.5,
    "axes.linewidth": 0.6,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "legend.frameon": False,
    "legend.fontsize": 7,
    "hatch.linewidth": 0.4,
    "grid.linewidth": 0.4,
    "grid.color": "#d0d0d0",
}


def styled(draw: Callable[P, Figure]) -> Callable[P, Figure]:
    """Draw in the package's style, whatever the user's matplotlib settings say."""

    @functools.wraps(draw)
    def drawn(*args: P.args, **kwargs: P.kwargs) -> Figure:
        with matplotlib.style.context(STYLE, after_reset=True):
            return draw(*args, **kwargs)

    return drawn


def save_png(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a PNG, whole or not at all; equal figures give equal bytes.

    Errors: InputError where the folder does not exist or cannot be written to.
    """
    with matplotlib.style.context(STYLE, after_reset=True), replacing(path) as temporary:
        figure.savefig(
            temporary, format="png", bbox_inches="tight", pad_inches=0.05,
            metadata={"Software": None},
        )  # fmt: skip


def panel_letter(axes: Axes, letter: str, title: str) -> None:
    """Title a panel: a bold letter and a few words."""
    axes.set_title(rf"$\bf{{{letter}}}$  {title}")


def map_axes(axes: Axes, window: Rectangle, length_unit: str) -> None:
    """Show a window at equal scales, in the scene's length unit, inside a full frame."""
    axes.set_aspect("equal", anchor="N")
    axes.set_xlim(window.x_min, window.x_max)
    axes.set_ylim(window.y_min, window.y_max)
    axes.spines[:].set_visible(True)
    axes.set_xlabel(f"x ({length_unit})")
    axes.set_ylabel(f"y ({length_unit})")
