"""The database of standardised shapes, from any source."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import shapely

from grainfront.polygons import Polygons
from grainfront.shapes.descriptors import clean_outline, describe, feret, hull_indices
from grainfront.shapes.sources import (
    BinaryMasks,
    FourierGrains,
    LabelMasks,
    OutlinesFile,
    Photographs,
    RandomConvexPolygons,
    Rectangles,
    RegularPolygon,
    ShapeSource,
)


@dataclass(frozen=True)
class ShapeDatabase:
    """Standardised shapes: the hull's centroid at the origin, size 1, orientation 0.

    `hull_nodes` (int64) indexes `outlines.nodes`, and `hulls.nodes` is `outlines.nodes[hull_nodes]`
    bit for bit. `descriptors` are float64 arrays of shape (n_shapes,), see `descriptors.describe`;
    size and orientation are those found in the source (its unit, degrees), all else is of the
    standardised shape. `counts` tells what was found in the source, kept, and dropped and why.
    Terms after Du, Liu, Han & Deng (2023, section 2).
    """

    outlines: Polygons
    hulls: Polygons
    hull_nodes: np.ndarray
    descriptors: dict[str, np.ndarray]
    counts: dict[str, int]

    @property
    def count(self) -> int:
        """How many shapes there are."""
        return self.outlines.count


def build_database(source: ShapeSource, rng: np.random.Generator) -> ShapeDatabase:
    """Build the database of a source, in the order in which the source tells its shapes.

    `rng` serves the random families only. Raises InputError where the source is at fault.
    """
    outlines, counts = _read(source, rng)
    return standardised_database(outlines, counts)


def standardised_database(found: Polygons, counts: Mapping[str, int]) -> ShapeDatabase:
    """Standardise simple, counter-clockwise outlines, in any unit, and describe them."""
    cleaned = [clean_outline(found.polygon(i)) for i in range(found.count)]
    placed = [_standardise(outline) for outline in cleaned]
    outlines = Polygons.of([outline for outline, _, _ in placed])
    # The turn and the scaling do not change which nodes are hull vertices: clean_outline left none
    # so close to the hull that rounding could decide.
    indices = [hull_indices(outlines.polygon(i)) for i in range(outlines.count)]
    hulls = Polygons.of([outlines.polygon(i)[index] for i, index in enumerate(indices)])
    hull_nodes = np.concatenate(
        [index + start for index, start in zip(indices, outlines.offsets[:-1], strict=True)]
    )
    descriptors = describe(outlines, hulls)
    descriptors["size"] = np.array([size for _, size, _ in placed])
    descriptors["orientation"] = np.array([orientation for _, _, orientation in placed])
    return ShapeDatabase(outlines, hulls, hull_nodes, descriptors, dict(counts))


def _standardise(outline: np.ndarray) -> tuple[np.ndarray, float, float]:
    """The standardised outline, its size and its orientation before that."""
    outline = outline - outline.mean(axis=0)
    hull = outline[hull_indices(outline)]
    size, _, orientation = feret(hull)
    centroid = shapely.get_coordinates(shapely.centroid(shapely.Polygon(hull)))[0]
    turn = np.radians(orientation)
    cosine, sine = np.cos(turn), np.sin(turn)
    return (outline - centroid) @ [[cosine, -sine], [sine, cosine]] / size, size, orientation


def _read(source: ShapeSource, rng: np.random.Generator) -> tuple[Polygons, dict[str, int]]:
    """Outlines of any source, and the counts; each kind imports only what it needs."""
    match source:
        case Photographs() | BinaryMasks() | LabelMasks():
            return _from_images(source)
        case OutlinesFile():
            from grainfront.shapes.outlines_file import read_outlines

            return read_outlines(source.path)
    from grainfront.shapes import families

    match source:
        case Rectangles():
            outlines, rejected = families.rectangles(source), 0
        case RegularPolygon():
            outlines, rejected = families.regular_polygon(source), 0
        case RandomConvexPolygons():
            outlines, rejected = families.random_convex_polygons(source, rng), 0
        case FourierGrains():
            outlines, rejected = families.fourier_grains(source, rng)
    found = outlines.count + rejected
    return outlines, {"found": found, "kept": outlines.count, "self_crossing": rejected}


def _from_images(source: Photographs | BinaryMasks | LabelMasks) -> tuple[Polygons, dict[str, int]]:
    from grainfront.shapes.images import find_outlines

    counts: Counter[str] = Counter()
    outlines = []
    for found in find_outlines(source):
        counts.update(found.counts)
        # Rows run downwards: mirrored, so that shapes are seen as in the picture, y upwards.
        outlines += [
            (found.outlines.polygon(i) * [1.0, -1.0])[::-1] for i in range(found.outlines.count)
        ]
    return Polygons.of(outlines), dict(counts)
