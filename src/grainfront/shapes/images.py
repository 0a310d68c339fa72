"""Images to outlines: grey photographs, binary masks and label masks."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import ndimage
from skimage import feature, filters, measure, morphology, segmentation

from grainfront.errors import InputError
from grainfront.image_files import grey_values, read_image
from grainfront.polygons import Polygons
from grainfront.shapes.outlines import trace_labels
from grainfront.shapes.sources import (
    BinaryMasks,
    LabelMasks,
    Photographs,
    Segmentation,
)


class FoundOutlines(NamedTuple):
    """One image and the outlines found in it.

    `image` is grey, float64 in [0, 1], of shape (rows, columns); `outlines` are in pixels,
    x = column and y = row, pixel centres at whole numbers; `counts` tells what was found, kept and
    dropped.
    """

    path: str
    image: np.ndarray
    outlines: Polygons
    counts: dict[str, int]


def find_outlines(source: Photographs | BinaryMasks | LabelMasks) -> list[FoundOutlines]:
    """Find the outlines in every image of a source, in the order of its paths.

    Raises InputError, naming the file, where an image cannot be read or holds no grain to keep.
    """
    return [_find_in(path, source) for path in source.paths]


def _find_in(path: str, source: Photographs | BinaryMasks | LabelMasks) -> FoundOutlines:
    pixels = read_image(path)
    if isinstance(source, Photographs):
        image = grey_values(path, pixels)
        labels = segment(image, source.segmentation)
        limits = source.segmentation.min_perimeter, source.segmentation.min_solidity
    else:
        if isinstance(source, LabelMasks):
            labels = _labels(path, pixels)
        else:
            labels = _parts(path, pixels, source.dark_grains)
        image = (labels > 0).astype(np.float64)
        limits = source.min_perimeter, source.min_solidity
    outlines, counts = trace_labels(labels, *limits)
    if outlines.count == 0:
        dropped = ", ".join(f"{reason} {n}" for reason, n in counts.items() if n) or "nothing found"
        raise InputError(f"{path}: no grain to keep in this image ({dropped}).")
    return FoundOutlines(path, image, outlines, counts)


def segment(image: np.ndarray, options: Segmentation) -> np.ndarray:
    """Label the grains of a grey image, shape (rows, columns), values in [0, 1]; 0 is no grain.

    Local threshold, then a watershed of the distance transform, seeded at its maxima (Beucher &
    Meyer 1993). Raises InputError where `block_size` is not an odd number from 3 on.
    """
    if options.block_size < 3 or options.block_size % 2 == 0:
        raise InputError(
            f"segmentation: block_size is {options.block_size}; allowed are odd numbers from 3 on."
        )
    smoothed = ndimage.gaussian_filter(image, options.smoothing)
    threshold = filters.threshold_local(smoothed, options.block_size, offset=options.offset)
    grains = smoothed < threshold if options.dark_grains else smoothed > threshold
    grains = morphology.opening(grains, morphology.disk(1))
    # Dark spots on grains, smaller than a seed's reach, would draw the watershed's lines to them.
    grains = _without_small_holes(grains, options.min_distance**2)
    distance = ndimage.gaussian_filter(ndimage.distance_transform_edt(grains), 1.0)
    peaks = feature.peak_local_max(
        distance,
        min_distance=options.min_distance,
        labels=measure.label(grains),
        exclude_border=False,
    )
    seeds = np.zeros(image.shape, dtype=np.int64)
    seeds[tuple(peaks.T)] = np.arange(1, len(peaks) + 1)
    return segmentation.watershed(-distance, seeds, mask=grains)


def _without_small_holes(grains: np.ndarray, area: int) -> np.ndarray:
    holes, _ = ndimage.label(~grains)
    small = np.bincount(holes.ravel()) <= area
    small[0] = False
    return grains | small[holes]


def _parts(path: str, pixels: np.ndarray, dark_grains: bool) -> np.ndarray:
    """Label the connected components of a mask: grains are brighter (or darker) than half grey."""
    bright = grey_values(path, pixels) > 0.5
    return ndimage.label(~bright if dark_grains else bright)[0]


def _labels(path: str, pixels: np.ndarray) -> np.ndarray:
    if pixels.ndim != 2 or pixels.dtype.kind not in "biu":
        raise InputError(
            f"{path}: a label mask has one whole number a pixel, "
            f"this image has shape {pixels.shape} and type {pixels.dtype}."
        )
    if pixels.min() < 0:
        raise InputError(f"{path}: labels start at 0 (background), the least is {pixels.min()}.")
    # Consecutive labels: a mask may number its grains by any large numbers.
    return np.unique(pixels, return_inverse=True)[1].reshape(pixels.shape) + int(pixels.min() > 0)
