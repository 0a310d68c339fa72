"""The domain in a picture: walls and obstacles of any shape, or the border of a periodic cell."""

from __future__ import annotations

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.patches import PathPatch
from matplotlib.patches import Rectangle as RectanglePatch
from matplotlib.path import Path

from grainfront.figures.style import INK, OUTSIDE
from grainfront.particles import Cell, Packing, Rectangle, Region, tiled

# Share of the longer side that is shown beyond the bounding rectangle of a domain of any shape.
MARGIN = 0.01
LINE = 0.7


def window_of(packing: Packing) -> Rectangle:
    """What shows all of a packing: the domain, and what reaches over the border of a cell."""
    domain = packing.domain
    sides = np.array([domain.x_min, domain.y_min, domain.x_max, domain.y_max])
    if isinstance(domain, Region):
        margin = MARGIN * max(domain.width, domain.height)
        return Rectangle(*(sides + margin * np.array([-1, -1, 1, 1])).tolist())
    if isinstance(domain, Cell):
        nodes = packing.polygons.nodes
        low, high = (
            np.minimum(sides[:2], nodes.min(axis=0)),
            np.maximum(sides[2:], nodes.max(axis=0)),
        )
        return Rectangle(*low.tolist(), *high.tolist())
    return domain


def middle_of(domain: Rectangle) -> tuple[float, float]:
    """Where a closer look is of interest: the middle of a rectangle.

    Of a domain of any shape, it is the point farthest from its walls; of a cell that repeats
    itself, the corner or side where it meets itself.
    """
    if isinstance(domain, Region):
        circle = shapely.maximum_inscribed_circle(domain.to_shapely())
        x, y = shapely.get_coordinates(circle)[0].tolist()
        return x, y
    x, y = domain.x_min + domain.width / 2, domain.y_min + domain.height / 2
    if isinstance(domain, Cell):
        return domain.x_min, domain.y_min if domain.along_y else y
    return x, y


def with_images(packing: Packing) -> Packing:
    """The packing and, around a cell that repeats itself, the images of its particles."""
    return tiled(packing) if isinstance(packing.domain, Cell) else packing


def draw_walls(axes: Axes, domain: Rectangle, window: Rectangle) -> None:
    """Shade what is no part of a domain of any shape; outline it, or a cell that repeats itself."""
    if isinstance(domain, Cell):
        axes.add_patch(
            RectanglePatch(
                (domain.x_min, domain.y_min), domain.width, domain.height,
                fill=False, edgecolor=INK, linewidth=LINE, linestyle=(0, (4, 2)), zorder=3,
            )
        )  # fmt: skip
    if isinstance(domain, Region):
        rings = [domain.rings.polygon(i) for i in range(domain.rings.count)]
        # what runs the other way round is left out of what surrounds it
        outside = [_corners(window), *(ring[::-1] for ring in rings)]
        axes.add_patch(PathPatch(_closed(outside), facecolor=OUTSIDE, edgecolor="none", zorder=0.5))
        axes.add_patch(
            PathPatch(_closed(rings), fill=False, edgecolor=INK, linewidth=LINE, zorder=3)
        )


def _corners(window: Rectangle) -> np.ndarray:
    x0, y0, x1, y1 = window.x_min, window.y_min, window.x_max, window.y_max
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def _closed(rings: list[np.ndarray]) -> Path:
    return Path.make_compound_path(*(Path(np.vstack([r, r[:1]]), closed=True) for r in rings))
