"""Polygons with holes from a GeoJSON or WKT file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely

from grainfront.errors import InputError

READERS = {
    ".geojson": shapely.from_geojson,
    ".json": shapely.from_geojson,
    ".wkt": shapely.from_wkt,
}

# As in scenes: squares of larger coordinates are no numbers any more.
LARGEST_NUMBER = 1e50


def read_polygons(path: str) -> shapely.Geometry:
    """The union of all polygons in a file.

    `.geojson` and `.json`: any GeoJSON object of polygons; `.wkt`: one geometry a line. Raises
    InputError naming the file and what is wrong in it.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in READERS:
        raise InputError(f"{path}: polygons are read from files ending in {', '.join(READERS)}")
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as reason:
        raise InputError(f"{path}: not readable as text in UTF-8 ({reason})") from reason
    lines = [line for line in text.splitlines() if line.strip()] if suffix == ".wkt" else [text]
    parts: list[shapely.Geometry] = []
    for line in lines:
        try:
            with np.errstate(invalid="ignore", over="ignore"):  # NaN and ∞ are told below
                geometry = READERS[suffix](line)
        except (shapely.GEOSException, ValueError) as reason:
            told = str(reason).strip().split("\n")[0][:200]
            raise InputError(f"{path}: not {suffix[1:].upper()} ({told})") from reason
        parts.extend(_parts(geometry))
    if not parts:
        raise InputError(f"{path}: no polygon in this file, but there must be one at least")
    return shapely.union_all([_checked(path, part) for part in parts])


def _parts(geometry: shapely.Geometry) -> list[shapely.Geometry]:
    """Single geometries, of collections of collections too."""
    if geometry.geom_type in ("MultiPolygon", "GeometryCollection"):
        return [part for inner in geometry.geoms for part in _parts(inner)]
    return [geometry]


def _checked(path: str, part: shapely.Geometry) -> shapely.Geometry:
    if part.geom_type != "Polygon":
        raise InputError(f"{path}: holds a {part.geom_type}, but must hold polygons alone")
    if not np.isfinite(shapely.get_coordinates(part)).all():
        raise InputError(f"{path}: a coordinate is not a finite number")
    farthest = float(np.abs(shapely.get_coordinates(part)).max(initial=0.0))
    if farthest > LARGEST_NUMBER:
        raise InputError(
            f"{path}: a coordinate is {farthest:g}, but must be of a magnitude up to "
            f"{LARGEST_NUMBER:g}"
        )
    if not part.is_valid or part.area == 0.0:
        reason = shapely.is_valid_reason(part) if not part.is_valid else "its area is 0"
        raise InputError(f"{path}: a polygon is not simple with holes inside ({reason})")
    return shapely.force_2d(part)
