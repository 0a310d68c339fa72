"""The packing, coloured by size, with a closer look at its middle."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle as RectanglePatch

from grainfront.figures.style import (
    HULL,
    INK,
    MM,
    SIZE_MAP,
    WIDTH,
    WINDOW,
    map_axes,
    panel_letter,
    styled,
)
from grainfront.figures.walls import draw_walls, middle_of, window_of, with_images
from grainfront.particles import Cell, Packing, Rectangle

GRAINS_ACROSS_ZOOM = 8
"""Edge of the zoom in mean circumscribed diameters: few enough to see every outline."""

PALE = 0.45
"""Opacity of the images of particles."""


@styled
def packing(
    hulls: Packing, outlines: Packing | None, *, length_unit: str, volume_fractions: Sequence[float]
) -> Figure:
    """The whole packing and a zoom of its middle, particles coloured by size.

    Where `outlines` replaced the hulls they are what is coloured, and the zoom shows the hulls
    round them. `volume_fractions` are those of the hulls and, where there are any, the outlines.
    """
    shown = outlines or hulls
    everything = window_of(shown)
    figure = Figure(figsize=(WIDTH, _height(everything)))
    whole, zoom = figure.subplots(1, 2, width_ratios=(1, 1))
    colours = Normalize(*_colour_limits(shown.size))
    window = zoom_window(shown)

    artist = _draw(whole, shown, colours, edge=0.0)
    draw_walls(whole, shown.domain, everything)
    map_axes(whole, everything, length_unit)
    whole.add_patch(_outline_of(window, linewidth=0.9))
    panel_letter(whole, "a", f"{shown.x.size:,} particles, $\\phi$ = {volume_fractions[-1]:.4f}")

    _draw_images(zoom, shown, colours, window)
    inside = inside_window(shown, window)
    if outlines is not None:
        _draw_hulls(zoom, hulls, inside)
    _draw(zoom, shown, colours, edge=0.3, chosen=inside)
    draw_walls(zoom, shown.domain, everything)
    map_axes(zoom, window, length_unit)
    zoom.spines[:].set_color(WINDOW)
    hulls_behind = f"outlines in their hulls (hulls: $\\phi$ = {volume_fractions[0]:.4f})"
    closer = "closer, images paler" if isinstance(shown.domain, Cell) else "closer"
    panel_letter(zoom, "b", closer if outlines is None else hulls_behind)

    bar = figure.colorbar(artist, ax=[whole, zoom], location="bottom", aspect=60, shrink=0.6,
                          pad=0.02, extend="both" if np.ptp(shown.size) else "neither")  # fmt: skip
    bar.set_label(f"size, the minimum Feret diameter ({length_unit})")
    bar.outline.set_linewidth(0.4)
    return figure


def zoom_window(packing: Packing) -> Rectangle:
    """A square about the middle of the domain, a few grains across, no larger than the domain."""
    domain = packing.domain
    edge = min(
        GRAINS_ACROSS_ZOOM * 2 * float(np.mean(packing.circumradius)) if packing.x.size else np.inf,
        domain.width,
        domain.height,
    )
    x, y = (middle - edge / 2 for middle in middle_of(domain))
    return Rectangle(x, y, x + edge, y + edge)


def inside_window(packing: Packing, window: Rectangle) -> np.ndarray:
    """Indices of the particles whose circumscribed circle reaches into the window."""
    r = packing.circumradius
    return np.flatnonzero(
        (packing.x + r > window.x_min)
        & (packing.x - r < window.x_max)
        & (packing.y + r > window.y_min)
        & (packing.y - r < window.y_max)
    )


def _height(domain: Rectangle) -> float:
    """Height of the figure: half the width at the domain's proportions, and the colour bar."""
    proportion = min(max(domain.height / domain.width, 1.0), 2.0)
    return 0.5 * WIDTH * proportion + 14 * MM


def _colour_limits(size: np.ndarray) -> tuple[float, float]:
    """The central 98 % of the sizes, so that one giant does not turn all others into one colour."""
    low, high = np.quantile(size, [0.01, 0.99]) if size.size else (0.0, 1.0)
    return (float(low), float(high)) if high > low else (0.9 * float(low), 1.1 * float(low))


def _draw(
    axes: Axes,
    packing: Packing,
    colours: Normalize,
    *,
    edge: float,
    chosen: np.ndarray | None = None,
) -> PolyCollection:
    chosen = np.arange(packing.x.size) if chosen is None else chosen
    artist = PolyCollection(
        [packing.polygons.polygon(i) for i in chosen.tolist()],
        array=packing.size[chosen],
        norm=colours,
        cmap=SIZE_MAP,
        edgecolors=INK if edge else "none",
        linewidths=edge,
    )
    axes.add_collection(artist, autolim=False)
    return artist


def _draw_images(axes: Axes, packing: Packing, colours: Normalize, window: Rectangle) -> None:
    """Draw, paler, the images of the particles of a cell that repeats itself."""
    if isinstance(packing.domain, Cell):
        whole = with_images(packing)
        seen = inside_window(whole, window)
        images = _draw(axes, whole, colours, edge=0.3, chosen=seen[seen >= packing.x.size])
        images.set_alpha(PALE)


def _draw_hulls(axes: Axes, hulls: Packing, chosen: np.ndarray) -> None:
    polygons = [hulls.polygons.polygon(i) for i in chosen.tolist()]
    axes.add_collection(
        PolyCollection(polygons, facecolors=HULL, edgecolors=INK, linewidths=0.3),
        autolim=False,
    )


def _outline_of(window: Rectangle, linewidth: float) -> RectanglePatch:
    corner = (window.x_min, window.y_min)
    return RectanglePatch(
        corner, window.width, window.height, fill=False, edgecolor=WINDOW, linewidth=linewidth
    )
