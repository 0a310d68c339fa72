"""Where shapes come from: one frozen dataclass a source, free of any import that costs time."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Segmentation:
    """How grains are told apart in a grey photograph; lengths in pixels.

    The photograph is smoothed (Gaussian of standard deviation `smoothing`), a pixel belongs to a
    grain where it is brighter than the Gaussian-weighted mean of its neighbourhood (odd edge
    `block_size`) minus `offset` (as a fraction of the grey range), and touching grains are parted
    by a watershed of the distance transform, whose seeds are `min_distance` apart at least.
    `dark_grains` is for grains darker than their surroundings.

    Grains whose outline is shorter than `min_perimeter` are specks; grains whose area is less than
    `min_solidity` times that of their hull are merged clumps; both are dropped and counted.
    """

    smoothing: float = 1.5
    block_size: int = 51
    offset: float = 0.0
    min_distance: int = 5
    dark_grains: bool = False
    min_perimeter: float = 36.0
    min_solidity: float = 0.9


@dataclass(frozen=True)
class Photographs:
    """Grey photographs; "skimage:gravel" is the photograph that ships inside scikit-image."""

    paths: tuple[str, ...] = ("skimage:gravel",)
    segmentation: Segmentation = Segmentation()


@dataclass(frozen=True)
class BinaryMasks:
    """Masks in which connected pixels brighter than half grey are a grain; lengths in pixels.

    `dark_grains`: the grains are the darker pixels. Specks and merged clumps as in `Segmentation`.
    """

    paths: tuple[str, ...]
    dark_grains: bool = False
    min_perimeter: float = 57.0
    min_solidity: float = 0.0


@dataclass(frozen=True)
class LabelMasks:
    """Masks in which grain k is the pixels of value k and 0 is the background; grains may touch.

    Lengths in pixels; specks and merged clumps as in `Segmentation`.
    """

    paths: tuple[str, ...]
    min_perimeter: float = 57.0
    min_solidity: float = 0.0


@dataclass(frozen=True)
class OutlinesFile:
    """Outlines read from a GeoJSON (.geojson, .json), WKT (.wkt) or CSV (.csv) file.

    The CSV has the columns outline, x and y: the nodes of one outline share its name or number.
    """

    path: str


@dataclass(frozen=True)
class Rectangles:
    """`count` rectangles, evenly spaced over the range of `aspect_ratio` (one if it is a point)."""

    aspect_ratio: tuple[float, float] = (1.0, 4.0)
    count: int = 61


@dataclass(frozen=True)
class RegularPolygon:
    """The regular polygon of so many `vertices`."""

    vertices: int = 6


@dataclass(frozen=True)
class RandomConvexPolygons:
    """`count` random convex polygons of exactly `vertices` vertices each (Valtr 1995)."""

    vertices: int = 12
    count: int = 200


@dataclass(frozen=True)
class FourierGrains:
    """`count` outlines of `vertices` nodes, of a Fourier spectrum after Mollon & Zhao (2012).

    `d2` (elongation), `d3` (main irregularities) and `d8` (roughness) are the normalised amplitudes
    of the modes 2, 3 and 8; between and beyond them amplitudes decay by the powers `decay_3_8` and
    `decay_8_up` of the mode number; phases are random.
    """

    vertices: int = 64
    count: int = 200
    d2: float = 0.10
    d3: float = 0.05
    d8: float = 0.015
    decay_3_8: float = 2.0
    decay_8_up: float = 2.0


ShapeSource = (
    Photographs
    | BinaryMasks
    | LabelMasks
    | OutlinesFile
    | Rectangles
    | RegularPolygon
    | RandomConvexPolygons
    | FourierGrains
)
