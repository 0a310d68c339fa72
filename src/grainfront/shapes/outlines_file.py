"""Outlines from a GeoJSON, WKT or CSV file."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import shapely
from shapely.geometry import shape

from grainfront.errors import InputError
from grainfront.polygons import Polygons

# Outlines are larger and smaller than these, so that fourth powers of lengths neither overflow nor
# vanish; and hold more than this share of their extent squared, or rounding would shape them.
SMALLEST_EXTENT, LARGEST_EXTENT = 1e-50, 1e50
LEAST_FILLED = 1e-9

# Where an outline stands in its file ("feature 3", "line 7", "outline a"), its nodes, its holes.
Placed = tuple[str, np.ndarray, int]


def read_outlines(path: str) -> tuple[Polygons, dict[str, int]]:
    """Read simple polygons, in the order of the file; holes are filled and counted.

    `.geojson` and `.json`: a FeatureCollection, Feature, Polygon, MultiPolygon or
    GeometryCollection. `.wkt`: one POLYGON or MULTIPOLYGON a line. `.csv`: the columns outline, x
    and y, one node a line; lines of the same `outline` are one polygon.

    Either sense of rotation will do, and the first node may be repeated at the end. Returns the
    polygons, counter-clockwise, in the units of the file, and the counts `found`, `kept` and
    `hole`. Raises InputError naming the file and the place in it.
    """
    readers = {".geojson": _geojson, ".json": _geojson, ".wkt": _wkt, ".csv": _csv}
    suffix = Path(path).suffix.lower()
    if suffix not in readers:
        allowed = ", ".join(readers)
        raise InputError(f"{path}: outlines are read from files ending in {allowed}.")
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as reason:
        raise InputError(f"{path}: not readable as text in UTF-8 ({reason}).") from reason
    holes = 0
    outlines = []
    try:
        for place, nodes, n_holes in readers[suffix](path, text):
            outlines.append(_checked(path, place, nodes))
            holes += int(n_holes > 0)
    except csv.Error as reason:
        raise InputError(f"{path}: not CSV ({reason}).") from reason
    except RecursionError as reason:
        raise InputError(f"{path}: its lists or collections are nested too deeply.") from reason
    if not outlines:
        raise InputError(f"{path}: no outline in this file; at least one polygon is needed.")
    counts = {"found": len(outlines), "kept": len(outlines), "hole": holes}
    return Polygons.of(outlines), counts


def _checked(path: str, place: str, nodes: np.ndarray) -> np.ndarray:
    """The nodes of a simple polygon, counter-clockwise, the first not repeated."""
    if not np.isfinite(nodes).all():
        raise InputError(f"{path}, {place}: a coordinate is not a finite number.")
    if len(nodes) > 1 and np.array_equal(nodes[0], nodes[-1]):
        nodes = nodes[:-1]
    distinct = len(np.unique(nodes, axis=0))
    if distinct < 3:
        raise InputError(f"{path}, {place}: {distinct} distinct vertices; 3 or more are needed.")
    extent = float(np.ptp(nodes, axis=0).max())
    if not SMALLEST_EXTENT <= extent <= LARGEST_EXTENT:
        raise InputError(
            f"{path}, {place}: the outline is {extent:g} wide; allowed are {SMALLEST_EXTENT:g} to "
            f"{LARGEST_EXTENT:g}."
        )
    polygon = shapely.Polygon(nodes)
    if not polygon.is_valid or polygon.area == 0.0:
        reason = shapely.is_valid_reason(polygon) if not polygon.is_valid else "its area is 0"
        raise InputError(f"{path}, {place}: the outline is not a simple polygon ({reason}).")
    if polygon.area < LEAST_FILLED * extent**2:
        raise InputError(
            f"{path}, {place}: the outline is too thin; it must hold {LEAST_FILLED:g} of the "
            "square of its extent."
        )
    return nodes if polygon.exterior.is_ccw else nodes[::-1]


def _geojson(path: str, text: str) -> Iterator[Placed]:
    try:
        content = json.loads(text)
    except json.JSONDecodeError as reason:
        raise InputError(
            f"{path}, line {reason.lineno}: truncated or not JSON ({reason.msg})."
        ) from reason
    if not isinstance(content, dict):
        raise InputError(f"{path}: GeoJSON is one object, this is a {type(content).__name__}.")
    collection = content.get("type") == "FeatureCollection"
    features = content.get("features") if collection else [content]
    if not isinstance(features, list):
        raise InputError(f"{path}: the features are {features!r:.60}; a list is needed.")
    for number, feature in enumerate(features, start=1):
        place = f"feature {number}"
        is_feature = isinstance(feature, dict) and feature.get("type") == "Feature"
        found = feature.get("geometry") if is_feature else feature
        if not isinstance(found, dict) or "type" not in found:
            raise InputError(f"{path}, {place}: no GeoJSON geometry, which has a type.")
        try:
            with np.errstate(invalid="ignore", over="ignore"):  # NaN and ∞ are told below
                geometry = shape(found)
        except Exception as reason:  # shapely raises many kinds for malformed geometry
            raise InputError(f"{path}, {place}: not a GeoJSON geometry ({reason}).") from reason
        yield from _rings(path, place, geometry)


def _wkt(path: str, text: str) -> Iterator[Placed]:
    for number, line in enumerate(text.splitlines(), start=1):
        if not line.strip():
            continue
        try:
            with np.errstate(invalid="ignore", over="ignore"):  # NaN and ∞ are told below
                geometry = shapely.from_wkt(line)
        except (shapely.GEOSException, ValueError, NotImplementedError) as reason:
            raise InputError(f"{path}, line {number}: not WKT ({reason}).") from reason
        yield from _rings(path, f"line {number}", geometry)


def _rings(path: str, place: str, geometry: shapely.Geometry) -> Iterator[Placed]:
    parts = shapely.get_parts(geometry, return_index=False)
    for part in parts:
        if part.geom_type in ("MultiPolygon", "GeometryCollection"):
            yield from _rings(path, place, part)
        elif part.geom_type == "Polygon":
            yield place, shapely.get_coordinates(part.exterior), len(part.interiors)
        else:
            raise InputError(f"{path}, {place}: a {part.geom_type}; allowed are polygons.")


def _csv(path: str, text: str) -> Iterator[Placed]:
    rows = csv.DictReader(text.splitlines(), skipinitialspace=True)
    columns = rows.fieldnames or ()
    if not {"outline", "x", "y"} <= set(columns):
        found = ", ".join(columns) or "missing"
        raise InputError(
            f"{path}, line 1: the columns are {found:.200}; outline, x and y are needed."
        )
    nodes: dict[str, list[tuple[float, float]]] = {}
    for row in rows:
        try:
            node = float(row["x"]), float(row["y"])
        except (TypeError, ValueError) as reason:
            found = f"x = {row['x']!r}, y = {row['y']!r}"
            where = f"{path}, line {rows.line_num}"
            raise InputError(f"{where}: {found}; numbers are needed.") from reason
        nodes.setdefault(row["outline"], []).append(node)
    for name, points in nodes.items():
        yield f"outline {name}", np.array(points, dtype=np.float64), 0
