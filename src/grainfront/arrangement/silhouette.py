"""The figure in an image to polygons."""

from __future__ import annotations

import numpy as np
import shapely
from scipy import ndimage
from skimage import color, measure, util

from grainfront.arrangement.zones import Silhouette
from grainfront.errors import InputError
from grainfront.pixels import read_pixels

# The images inside scikit-image's own package with a figure to be told from its ground.
SHIPPED_IMAGES = ("horse",)
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
    grey = _grey(path)
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


def _grey(path: str) -> np.ndarray:
    """Grey values from 0 to 1, float64 of shape (rows, columns), seen against white."""
    pixels = read_pixels(path, SHIPPED_IMAGES)
    if pixels.ndim == 3 and pixels.shape[2] == 2:  # grey and opacity
        pixels = np.dstack([pixels[..., :1]] * 3 + [pixels[..., 1:]])
    if pixels.ndim == 3 and pixels.shape[2] == 4:
        pixels = color.rgba2rgb(pixels)
    if pixels.ndim == 3 and pixels.shape[2] == 3:
        pixels = color.rgb2gray(pixels)
    if pixels.ndim != 2 or pixels.dtype.kind not in "buif" or not np.isfinite(pixels).all():
        raise InputError(f"{path}: neither a grey nor an RGB image, its shape is {pixels.shape}")
    grey = util.img_as_float64(pixels) if pixels.dtype.kind in "bui" else pixels.astype(np.float64)
    low, high = float(grey.min()), float(grey.max())
    if not 0.0 < high - low < np.inf:
        raise InputError(f"{path}: an image of a single grey value shows no figure")
    return (grey - low) / (high - low)
