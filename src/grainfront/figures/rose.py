"""The orientation rose."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator

from grainfront.figures.style import (
    ACCENT,
    INK,
    MM,
    PLACED,
    PRESCRIBED,
    WIDTH,
    panel_letter,
    styled,
)

if TYPE_CHECKING:
    from grainfront.statistics import OrientationRose


@styled
def rose(orientation: OrientationRose, contact_normals: OrientationRose | None) -> Figure:
    """Orientations placed, with those prescribed, and the directions of the contact normals.

    Directions have no sign, so each bin of [0, 180) degrees is drawn on both sides. The radius is
    the share of a bin over that of the uniform law: the circle of radius 1 is isotropic.
    """
    roses = [("orientation", orientation, PLACED)]
    if contact_normals is not None:
        roses.append(("contact normals", contact_normals, ACCENT))
    figure = Figure(figsize=(WIDTH * 0.5 * len(roses), 92 * MM))
    axes = figure.subplots(1, len(roses), subplot_kw={"projection": "polar"}, squeeze=False)[0]
    for polar, letter, (title, one, colour) in zip(axes, "ab", roses, strict=False):
        panel_letter(polar, letter, title)
        edges = np.radians(one.edges)
        _petals(polar, edges, _density(one.shares, edges), colour)
        if one.probabilities is not None:
            _steps(polar, edges, _density(one.probabilities, edges))
        _ring_of_uniform_law(polar)
        _dress(polar)
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    return figure


def _density(share: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Share per angle over that of the uniform law on [0, pi)."""
    return share / np.diff(edges) * np.pi


def _petals(axes: PolarAxes, edges: np.ndarray, radius: np.ndarray, colour: str) -> None:
    for turn, label in ((0.0, "placed"), (np.pi, None)):
        axes.bar(
            edges[:-1] + turn, radius, np.diff(edges), align="edge", color=colour,
            edgecolor="white", linewidth=0.2, label=label,
        )  # fmt: skip


def _steps(axes: PolarAxes, edges: np.ndarray, radius: np.ndarray) -> None:
    """The prescribed law as one closed stepped line, its arcs drawn in steps of a degree or so."""
    arcs = [np.linspace(a, b, 9) for a, b in pairwise(edges)]
    angle = np.concatenate([arc + turn for turn in (0.0, np.pi) for arc in arcs])
    height = np.tile(np.repeat(radius, 9), 2)
    axes.plot(
        np.append(angle, angle[0]), np.append(height, height[0]), color=PRESCRIBED, linewidth=1,
        label="prescribed",
    )  # fmt: skip


def _ring_of_uniform_law(axes: PolarAxes) -> None:
    """The circle of radius 1, on which every petal would end if all directions were alike."""
    angle = np.linspace(0, 2 * np.pi, 361)
    axes.plot(angle, np.ones_like(angle), color=INK, linewidth=0.7, linestyle=(0, (4, 3)),
              label="uniform law, radius 1")  # fmt: skip


def _dress(axes: PolarAxes) -> None:
    """Few rings, legible over the petals."""
    axes.spines["polar"].set_visible(False)
    axes.set_axisbelow("line")
    axes.set_thetagrids(range(0, 360, 30))
    axes.yaxis.set_major_locator(MaxNLocator(3, steps=[1, 5, 10], prune="lower"))
    axes.set_rlabel_position(15)
    for label in axes.get_yticklabels():
        label.set_path_effects([withStroke(linewidth=2, foreground="white")])
