"""Image files, and the images inside scikit-image, to pixels and grey values."""

from __future__ import annotations

import logging
import warnings
from pathlib import Path

import numpy as np

from grainfront.errors import InputError

# Images inside scikit-image's own package, which need no download, are named with this prefix.
SHIPPED = "skimage:"
SHIPPED_IMAGES = ("gravel", "coins", "horse")


def read_image(path: str) -> np.ndarray:
    """Read an image file, or one inside scikit-image ("skimage:gravel"), as it is.

    Raises InputError, naming the file, where it cannot be read.
    """
    import skimage.data
    import skimage.io

    if path.startswith(SHIPPED):
        name = path.removeprefix(SHIPPED)
        if name not in SHIPPED_IMAGES:
            allowed = ", ".join(SHIPPED + known for known in SHIPPED_IMAGES)
            raise InputError(f"{path}: no such image inside scikit-image; allowed are {allowed}.")
        return getattr(skimage.data, name)()
    if not Path(path).is_file():
        raise InputError(f"{path}: there is no such image file.")
    # what tifffile logs of a damaged file is told by the error that follows
    logging.getLogger("tifffile").addHandler(logging.NullHandler())
    try:
        # what the readers warn of, such as a large image, either ends in an error or is none
        with warnings.catch_warnings(action="ignore"):
            pixels = np.asarray(skimage.io.imread(path))
    except Exception as reason:  # each of the image readers raises errors of its own
        raise InputError(f"{path}: not a readable image ({_first_line(reason)}).") from reason
    if pixels.ndim not in (2, 3) or pixels.size == 0:
        raise InputError(f"{path}: an image has rows and columns, this has shape {pixels.shape}.")
    return pixels


def grey_values(path: str, pixels: np.ndarray) -> np.ndarray:
    """Grey values from 0 to 1 of a grey or RGB image, seen against white where it lets light pass.

    Raises InputError, naming the file, where it is of another kind or of a single grey value.
    """
    from skimage import color, util

    if pixels.ndim == 3 and pixels.shape[2] == 2:  # grey and opacity
        pixels = np.dstack([pixels[..., :1]] * 3 + [pixels[..., 1:]])
    if pixels.ndim == 3 and pixels.shape[2] == 4:
        pixels = color.rgba2rgb(pixels)
    if pixels.ndim == 3 and pixels.shape[2] == 3:
        pixels = color.rgb2gray(pixels)
    if pixels.ndim != 2:
        raise InputError(f"{path}: neither grey nor RGB, its shape is {pixels.shape}.")
    if pixels.dtype.kind not in "buif" or not np.isfinite(pixels).all():
        raise InputError(f"{path}: some grey values are not finite real numbers.")
    grey = util.img_as_float64(pixels) if pixels.dtype.kind in "bui" else pixels.astype(np.float64)
    low, high = float(grey.min()), float(grey.max())
    if not np.isfinite(high - low):
        raise InputError(f"{path}: grey values from {low:g} to {high:g} are too far apart.")
    if low == high:
        raise InputError(f"{path}: an image of a single grey value shows nothing.")
    return (grey - low) / (high - low)


def _first_line(reason: Exception) -> str:
    return str(reason).strip().split("\n")[0][:200] or type(reason).__name__
