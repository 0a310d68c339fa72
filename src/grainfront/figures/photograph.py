"""The photograph with the outlines found in it."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle as RectanglePatch

from grainfront.figures.style import MM, PRESCRIBED, WIDTH, WINDOW, panel_letter, styled
from grainfront.polygons import Polygons

ZOOM = 3
"""The closer look shows this share, one in so many, of the width and of the height."""


@styled
def photograph(image: np.ndarray, outlines: Polygons, *, title: str) -> Figure:
    """The photograph with the outlines found in it, and a closer look at its middle.

    `image` has the shape (height, width) or (height, width, 3); the nodes of `outlines` are in
    pixels, (0, 0) being the centre of the first pixel, x along a row and y along a column.
    """
    height, width = image.shape[:2]
    figure = Figure(figsize=(WIDTH, WIDTH / 2 * height / width + 7 * MM))
    whole, zoom = figure.subplots(1, 2)
    _draw(whole, image, outlines, opacity=0.25, linewidth=0.5)
    panel_letter(whole, "a", f"{title}: {outlines.count:,} outlines found")
    _draw(zoom, image, outlines, opacity=0.0, linewidth=1.1)
    panel_letter(zoom, "b", "closer")

    corner = np.array([width, height]) * (1 - 1 / ZOOM) / 2 - 0.5
    edge = np.array([width, height]) / ZOOM
    whole.add_patch(
        RectanglePatch(tuple(corner), *edge, fill=False, edgecolor=WINDOW, linewidth=0.9)
    )
    zoom.set_xlim(corner[0], corner[0] + edge[0])
    zoom.set_ylim(corner[1] + edge[1], corner[1])
    zoom.spines[:].set_color(WINDOW)
    return figure


def _draw(
    axes: Axes, image: np.ndarray, outlines: Polygons, *, opacity: float, linewidth: float
) -> None:
    axes.imshow(image, cmap="gray", interpolation="antialiased")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.spines[:].set_visible(True)
    polygons = [outlines.polygon(i) for i in range(outlines.count)]
    axes.add_collection(
        PolyCollection(
            polygons, facecolors=to_rgba(PRESCRIBED, opacity), edgecolors=PRESCRIBED,
            linewidths=linewidth,
        ),
        autolim=False,
    )  # fmt: skip
