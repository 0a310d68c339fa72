"""Contours of the signed distance to zones (Du et al. 2023, Fig. 12c)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import CenteredNorm, Normalize, TwoSlopeNorm
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from grainfront.figures.style import INK, MM, WIDTH, map_axes, panel_letter, styled
from grainfront.particles import Rectangle

# Blue inside, red outside, white on the boundary; told apart by every kind of colour vision.
DISTANCE_MAP = "RdBu_r"
CONTOURS = 12  # at most, either side
PANELS_ACROSS = 2
FULL_MAP_SHARE = 0.6  # of the width of the page, for one panel alone


@styled
def signed_distance(
    distances: Sequence[np.ndarray], titles: Sequence[str], domain: Rectangle, *, length_unit: str
) -> Figure:
    """One panel a zone: contours of the signed distance, negative inside, its zero line bold.

    Each of `distances` holds values over the domain, shape (rows, columns), the first row at the
    bottom, first and last values on the walls; infinite ones stay white. `titles` name the zones.
    """
    across = min(PANELS_ACROSS, len(distances))
    down = math.ceil(len(distances) / across)
    width = WIDTH if across > 1 else WIDTH * FULL_MAP_SHARE
    height = down * (width / across * domain.height / domain.width + 6 * MM)
    figure = Figure(figsize=(width, min(height, 1.4 * WIDTH)))
    panels = figure.subplots(down, across, squeeze=False).ravel()
    for axes, letter, distance, title in zip(
        panels, "abcdefghijklmnopqrstuvwxyz", distances, titles, strict=False
    ):
        filled = _contours(axes, distance, domain)
        map_axes(axes, domain, length_unit)
        panel_letter(axes, letter, title)
        if filled is not None:
            figure.colorbar(
                filled, ax=axes, label=f"signed distance ({length_unit})", shrink=0.8, aspect=30
            )
    for axes in panels[len(distances) :]:
        axes.set_axis_off()
    return figure


def _contours(axes: Axes, distance: np.ndarray, domain: Rectangle) -> ContourSet | None:
    rows, columns = distance.shape
    x = np.linspace(domain.x_min, domain.x_max, columns)
    y = np.linspace(domain.y_min, domain.y_max, rows)
    if not np.isfinite(distance).all():
        return None
    locator = MaxNLocator(2 * CONTOURS, steps=[1, 2, 5, 10])
    levels = np.asarray(locator.tick_values(float(distance.min()), float(distance.max())))
    filled = axes.contourf(x, y, distance, levels, cmap=DISTANCE_MAP, norm=_colours(levels))
    axes.contour(x, y, distance, levels, colors=INK, linewidths=0.25, linestyles="solid")
    axes.contour(x, y, distance, [0.0], colors=INK, linewidths=1.2)
    return filled


def _colours(levels: np.ndarray) -> Normalize:
    """White at the boundary, and the whole of both colours where there is an in- and an outside."""
    if levels[0] < 0.0 < levels[-1]:
        return TwoSlopeNorm(0.0, levels[0], levels[-1])
    return CenteredNorm(0.0)
