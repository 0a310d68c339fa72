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
# Images of more pixels are refused: finding grains takes some 85 bytes a pixel, 8.5 GB for these.
MOST_PIXELS = 10**8
# Files of other endings are read by Pillow.
TIFF = (".tif", ".tiff")


def read_image(path: str) -> np.ndarray:
    """Read an image file, or one inside scikit-image ("skimage:gravel"), as it is.

    Raises InputError, naming the file, where it cannot be read, and before it is decoded where it
    has more than MOST_PIXELS.
    """
    import skimage.data

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
            count = _count(path)
            pixels = _decoded(path) if count <= MOST_PIXELS else np.empty(0)
    except Exception as reason:  # each of the image readers raises errors of its own
        raise InputError(f"{path}: not a readable image ({_first_line(reason)}).") from reason
    if count > MOST_PIXELS:
        raise InputError(
            f"{path}: has more than {MOST_PIXELS:,} pixels, but at most that many are allowed."
        )
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


def _count(path: str) -> int:
    """Pixels of all pictures in a file, by its header; MOST_PIXELS + 1 where Pillow refuses it."""
    import tifffile
    from PIL import Image

    if path.lower().endswith(TIFF):
        with tifffile.TiffFile(path) as file:
            return file.series[0].size // max(file.series[0].keyframe.samplesperpixel, 1)
    try:
        with Image.open(path) as image:
            return image.width * image.height * getattr(image, "n_frames", 1)
    except Image.DecompressionBombError:
        return MOST_PIXELS + 1


def _decoded(path: str) -> np.ndarray:
    import imageio.v3
    import skimage.io

    if path.lower().endswith(TIFF):
        return np.asarray(skimage.io.imread(path))
    pixels = imageio.v3.imread(path, plugin="pillow")
    return pixels[0] if pixels.ndim == 4 and len(pixels) == 1 else pixels  # GIF counts its frames


def _first_line(reason: Exception) -> str:
    return str(reason).strip().split("\n")[0][:200] or type(reason).__name__
