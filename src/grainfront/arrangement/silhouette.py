"""The figure in an image to polygons."""

from __future__ import annotations

import numpy as np
import shapely
from scipy import ndimage
from skimage import measure

from grainfront.arrangement.zones import Silhouette
from grainfront.errors import InputError
from grainfront.image_files import grey_values, read_image

# Standard deviation, in pixels, of the Gaussian that turns the staircase of black and white pixels
# into slopes, on which the contour at half grey runs straight.
SMOOTHING = 1.0
# Nodes that stray less than this from the line without them, in pixels, are needless: half of what
# a black and white image leaves open.
NEEDLESS = 0.25


def silhouette(zone: Silhouette) -> shapely.Geometry:
    """The polygons of a figure, with holes, scaled and in their place.

    Raises InputError, naming the file, where it is no image or shows no figure.
    """
    figure = _figure_of(zone.path, zone.dark)
    x_min, y_min, x_max, y_max = figure.bounds
    if zone.width is not None:
        scale = zone.width / (x_max - x_min)
    else:
        assert zone.height is not None, "a silhouette has a width or a height"
        scale = zone.height / (y_max - y_min)
    middle = np.array([x_min + x_max, y_min + y_max]) / 2.0
    return shapely.transform(figure, lambda nodes: (nodes - middle) * scale + zone.centre)


def _figure_of(path: str, dark: bool) -> shapely.Geometry:
    """The figure in pixels, x to the right and y up."""
    grey = grey_values(path, read_image(path))
    figure = 1.0 - grey if dark else grey
    # a frame of ground closes the contours of figures that touch the image's border
    padding = int(np.ceil(4 * SMOOTHING))
    smooth = ndimage.gaussian_filter(np.pad(figure, padding), SMOOTHING, mode="constant")
    rings = [ring[:, ::-1] * (1.0, -1.0) for ring in measure.find_contours(smooth, 0.5)]
    lines = shapely.multilinestrings([shapely.linestrings(ring) for ring in rings])
    simple = shapely.simplify(shapely.build_area(lines), NEEDLESS)
    if simple.is_empty or simple.area == 0.0:
        raise InputError(f"{path}: no figure is {'darker' if dark else 'brighter'} than half grey")
    return simple
