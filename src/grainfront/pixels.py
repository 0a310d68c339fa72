"""The pixels of image files, decoded only where their number is bearable."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Sequence
from pathlib import Path

import imageio.v3
import numpy as np
import skimage.data
import tifffile
from PIL import Image
from skimage import io

from grainfront.errors import InputError

# A path of this beginning names an image that ships inside scikit-image, not a file.
SHIPPED = "skimage:"
# Images of more pixels are refused: finding grains takes some 85 bytes a pixel, 8.5 GB for these.
MOST_PIXELS = 10**8
TIFF = (".tif", ".tiff")

# What tifffile logs of a damaged file is told by the error that follows.
logging.getLogger("tifffile").addHandler(logging.NullHandler())


def read_pixels(path: str, shipped: Sequence[str]) -> np.ndarray:
    """Pixels as they are, (rows, columns) or (rows, columns, channels), of an image file.

    `shipped` are the images inside scikit-image that may be asked for, as "skimage:gravel". Files
    are TIFF, by their suffix, or whatever Pillow reads. Raises InputError, naming the file, where
    it cannot be read, and before it is decoded where it has more than MOST_PIXELS.
    """
    if path.startswith(SHIPPED):
        name = path.removeprefix(SHIPPED)
        if name not in shipped:
            allowed = ", ".join(SHIPPED + known for known in shipped)
            raise InputError(f"{path}: no such image inside scikit-image; allowed are {allowed}")
        return getattr(skimage.data, name)()
    if not Path(path).is_file():
        raise InputError(f"{path}: there is no such image file")
    try:
        # what the readers warn of, such as a large image, either ends in an error or is none
        with warnings.catch_warnings(action="ignore"):
            count = _count(path)
            pixels = _decoded(path) if count <= MOST_PIXELS else np.empty(0)
    except Image.DecompressionBombError:  # Pillow's own limit is higher
        count = MOST_PIXELS + 1
    except Exception as reason:  # each of the image readers raises errors of its own
        raise InputError(f"{path}: not a readable image ({_first_line(reason)})") from reason
    if count > MOST_PIXELS:
        raise InputError(
            f"{path}: has more than {MOST_PIXELS:,} pixels, but at most that many are allowed"
        )
    if pixels.ndim not in (2, 3) or pixels.size == 0:
        raise InputError(f"{path}: an image has rows and columns, this has shape {pixels.shape}")
    return pixels


def _count(path: str) -> int:
    """Pixels of all pictures in a file, by its header."""
    if path.lower().endswith(TIFF):
        with tifffile.TiffFile(path) as file:
            return file.series[0].size // max(file.series[0].keyframe.samplesperpixel, 1)
    with Image.open(path) as image:
        return image.width * image.height * getattr(image, "n_frames", 1)


def _decoded(path: str) -> np.ndarray:
    if path.lower().endswith(TIFF):
        return np.asarray(io.imread(path))
    return imageio.v3.imread(path, plugin="pillow")


def _first_line(reason: Exception) -> str:
    return str(reason).strip().split("\n")[0][:200] or type(reason).__name__
