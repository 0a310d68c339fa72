"""Zones of the plane as a scene names them: frozen dataclasses, free of imports that cost time.

Lengths are in the scene's unit, directions in degrees, counter-clockwise from the x axis. Source of
signed distances and set operations: Du, Liu, Han, Deng (2023), doi 10.1016/j.jrmge.2022.03.009,
section 4.2, Eqs. 5–7.
"""

from __future__ import annotations

from dataclasses import dataclass

from grainfront.image_files import SHIPPED

Point = tuple[float, float]


@dataclass(frozen=True)
class Circle:
    """A disc."""

    centre: Point
    radius: float


@dataclass(frozen=True)
class Box:
    """A rectangle with sides along the axes, about its centre."""

    centre: Point
    width: float
    height: float


@dataclass(frozen=True)
class Polygon:
    """A simple polygon with holes; either sense of rotation, the first node not repeated."""

    nodes: tuple[Point, ...]
    holes: tuple[tuple[Point, ...], ...] = ()


@dataclass(frozen=True)
class HalfPlane:
    """All on one side of the line through `point`; `normal` points out of it, of any length."""

    point: Point
    normal: Point


@dataclass(frozen=True)
class Bars:
    """Parallel bars without end (paper, Figs. 12 and 17).

    Each is `width` wide, and their centre lines, `spacing` apart, run along `direction`; one of
    them runs through `point`.
    """

    width: float
    spacing: float
    direction: float = 0.0
    point: Point = (0.0, 0.0)


@dataclass(frozen=True)
class Silhouette:
    """The figure in an image, scaled to the `width` or the `height` it is to have.

    `centre` is where the centre of its bounding box comes. The figure is what is darker than half
    grey, or brighter where not `dark`.
    """

    path: str
    centre: Point
    width: float | None = None
    height: float | None = None
    dark: bool = True


@dataclass(frozen=True)
class PolygonsFile:
    """The union of the polygons in a GeoJSON (.geojson, .json) or WKT (.wkt) file."""

    path: str


@dataclass(frozen=True)
class Union:
    """What lies in one of the zones at least: min(a, b) of distances (paper, Eq. 5)."""

    zones: tuple[Zone, ...]


@dataclass(frozen=True)
class Intersection:
    """What lies in all zones: max(a, b) of distances (paper, Eq. 7)."""

    zones: tuple[Zone, ...]


@dataclass(frozen=True)
class Difference:
    """What lies in the first zone and in none of the others: max(a, −b) (paper, Eq. 6)."""

    zones: tuple[Zone, ...]


@dataclass(frozen=True)
class Offset:
    """What lies nearer to the zone than `distance`; negative distances shrink it."""

    zone: Zone
    distance: float


@dataclass(frozen=True)
class Moved:
    """A zone scaled and turned (degrees), both about the point `about`, then shifted."""

    zone: Zone
    scale: float = 1.0
    angle: float = 0.0
    about: Point = (0.0, 0.0)
    shift: Point = (0.0, 0.0)


Zone = (
    Circle
    | Box
    | Polygon
    | HalfPlane
    | Bars
    | Silhouette
    | PolygonsFile
    | Union
    | Intersection
    | Difference
    | Offset
    | Moved
)


def files_of(zone: Zone) -> set[str]:
    """The images and files of the user's own that a zone comes from."""
    match zone:
        case Silhouette(path) | PolygonsFile(path):
            return set() if path.startswith(SHIPPED) else {path}
        case Union(zones) | Intersection(zones) | Difference(zones):
            return set().union(*map(files_of, zones))
        case Offset(inner) | Moved(inner):
            return files_of(inner)
    return set()
