"""The photograph with the outlines found in it."""

from __future__ import annotations

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from grainfront.figures.style import MM, PRESCRIBED, WIDTH, styled
from grainfront.polygons import Polygons


@styled
def photograph(image: np.ndarray, outlines: Polygons, *, title: str) -> Figure:
    """The photograph alone and with the outlines found in it, side by side.

    `image` has the shape (height, width) or (height, width, 3); the nodes of `outlines` are in
    pixels, (0, 0) being the centre of the first pixel, x along a row and y along a column.
    """
    height, width = image.shape[:2]
    figure = Figure(figsize=(WIDTH, WIDTH / 2 * height / width + 8 * MM))
    figure.suptitle(f"{title}: {outlines.count:,} outlines", x=0.01, ha="left", fontsize=8.5)
    plain, found = figure.subplots(1, 2)
    for axes in (plain, found):
        axes.imshow(image, cmap="gray", interpolation="antialiased")
        axes.set_axis_off()
    polygons = [outlines.polygon(i) for i in range(outlines.count)]
    found.add_collection(
        PolyCollection(
            polygons, facecolors=to_rgba(PRESCRIBED, 0.18), edgecolors=PRESCRIBED, linewidths=0.6
        ),
        autolim=False,
    )
    return figure
