"""Domain and packing: the plain data types that the stages after `shapes` hand on."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from grainfront.errors import InputError
from grainfront.polygons import Polygons

if TYPE_CHECKING:
    import shapely

CONTACT_TOLERANCE = 1e-6
"""Largest gap of a contact, in mean sizes.

Far above the gaps that packing leaves on purpose against rounding (about 1e-14 of the domain), far
below the distance of neighbours that do not touch.
"""

LEAST_FILLED = 0.5
"""A domain of any shape that is filled less has room, but not for any of the waiting particles.

Other packings of hulls fill more, but for slivers.
"""


@dataclass(frozen=True)
class Rectangle:
    """A rectangular domain, [x_min, x_max] × [y_min, y_max], in the scene's length unit."""

    x_min: float
    y_min: float
    x_max: float
    y_max: float

    @property
    def width(self) -> float:
        return self.x_max - self.x_min

    @property
    def height(self) -> float:
        return self.y_max - self.y_min

    @property
    def area(self) -> float:
        return self.width * self.height


@dataclass(frozen=True, eq=False)
class Region(Rectangle):
    """A domain of any shape, which as a rectangle is its own bounding rectangle.

    `rings` are the boundaries, the domain to the left of each: of polygon i, those from `parts[i]`
    to `parts[i + 1]`, its outer ring first, then its holes. `parts` has shape (n_polygons + 1,).
    """

    rings: Polygons
    parts: np.ndarray

    def __repr__(self) -> str:
        digest = hashlib.sha256(self.rings.nodes.tobytes())
        for offsets in (self.rings.offsets, self.parts):
            digest.update(np.asarray(offsets, dtype=np.int64).tobytes())
        sides = self.x_min, self.y_min, self.x_max, self.y_max
        return f"Region({', '.join(map(repr, sides))}, {digest.hexdigest()[:16]})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Region) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))

    @classmethod
    def of(cls, polygon: shapely.Geometry) -> Region:
        """The region that a shapely Polygon or MultiPolygon covers, its coordinates bit for bit.

        Raises InputError where the polygon is of another kind, empty, not valid or not finite.
        """
        import shapely

        if polygon.geom_type not in ("Polygon", "MultiPolygon") or polygon.is_empty:
            raise InputError(
                f"The domain is {'an empty ' if polygon.is_empty else 'a '}{polygon.geom_type}, "
                "but must be a Polygon or MultiPolygon that covers some area."
            )
        if not shapely.is_valid(polygon):
            raise InputError(f"The domain is no valid polygon: {shapely.is_valid_reason(polygon)}.")
        whole = shapely.force_2d(shapely.orient_polygons(polygon))
        _, nodes, (rings, parts, *_) = shapely.to_ragged_array([whole])
        open_nodes = np.delete(nodes, rings[1:] - 1, axis=0)
        open_rings = Polygons(open_nodes, (rings - np.arange(rings.size)).astype(np.int64))
        low, high = open_nodes.min(axis=0).tolist(), open_nodes.max(axis=0).tolist()
        return cls(low[0], low[1], high[0], high[1], open_rings, np.asarray(parts, dtype=np.int64))

    def without(self, inclusions: Sequence[shapely.Geometry]) -> Region:
        """The region around inclusions: fixed particles, shapely Polygons or MultiPolygons.

        Their area is no part of the domain any more. Raises InputError where one is no polygon,
        covers no area or is not valid, and where it crosses another one or the boundary, so that
        rounded nodes would come in where they cross.
        """
        import shapely

        rest = self.to_shapely()
        for number, inclusion in enumerate(inclusions):
            try:
                hole = Region.of(inclusion).to_shapely()
            except InputError as error:
                raise InputError(str(error).replace("The domain", f"Inclusion {number}")) from None
            if not shapely.covers(rest, hole):
                raise InputError(
                    f"Inclusion {number} crosses the boundary of the domain or an inclusion before "
                    "it, but must lie in the domain and beside the others."
                )
            rest = shapely.difference(rest, hole)
        if rest.is_empty:
            raise InputError("The inclusions cover the domain, but must leave some of it.")
        return Region.of(rest)

    def to_shapely(self) -> Any:
        """The region as a shapely MultiPolygon, its coordinates bit for bit."""
        import shapely

        offsets = self.rings.offsets
        closed = np.insert(np.arange(offsets[-1]), offsets[1:], offsets[:-1])
        return shapely.from_ragged_array(
            shapely.GeometryType.MULTIPOLYGON,
            self.rings.nodes[closed],
            (offsets + np.arange(offsets.size), self.parts, np.array([0, self.parts.size - 1])),
        )[0]

    @property
    def area(self) -> float:
        return float(self.to_shapely().area)

    def holds(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Whether points lie inside the region."""
        import shapely

        whole = self.to_shapely()
        shapely.prepare(whole)
        return shapely.contains_xy(whole, x, y)


@dataclass(frozen=True)
class Cell(Rectangle):
    """A rectangle that repeats itself along x, and where `along_y` along y too.

    Particles belong to the cell that their centre is in, and may reach into the next ones.
    """

    along_y: bool

    @property
    def shifts(self) -> np.ndarray:
        """From the cell to itself, first, and to those about it, shape (9, 2) or (3, 2)."""
        rows = (0, -1, 1) if self.along_y else (0,)
        return np.array([(i * self.width, j * self.height) for j in rows for i in (0, -1, 1)])


@dataclass(frozen=True)
class Packing:
    """Placed particles, in order of placement; arrays have shape (n_particles,).

    Lengths are in the scene's unit, `orientation` in degrees in [0, 180); (`x`, `y`) are centroids
    of the hulls. `polygons` are the hulls as packed or, after the replacement, the outlines; `area`
    and `circumradius` (about (x, y)) are theirs. `shape` indexes the shape database. `left_over`
    counts the particles that were drawn but found no place. `region` is the region of the scene's
    arrangement that a particle was drawn for, −1 for the rest of the domain; None without regions.
    """

    domain: Rectangle
    polygons: Polygons
    x: np.ndarray
    y: np.ndarray
    size: np.ndarray
    aspect_ratio: np.ndarray
    orientation: np.ndarray
    area: np.ndarray
    circumradius: np.ndarray
    shape: np.ndarray
    left_over: int
    region: np.ndarray | None = None

    def moved(self, by: np.ndarray) -> Packing:
        """The packing with every particle moved by a vector, (2,), or each by its own, (n, 2)."""
        by = np.broadcast_to(by, (self.x.size, 2))
        nodes = self.polygons.nodes + np.repeat(by, self.polygons.node_counts, axis=0)
        polygons = Polygons(nodes, self.polygons.offsets)
        return replace(self, polygons=polygons, x=self.x + by[:, 0], y=self.y + by[:, 1])

    def chosen(self, index: np.ndarray) -> Packing:
        """The packing with some of its particles alone."""
        return replace(
            self,
            polygons=self.polygons.chosen(index),
            region=None if self.region is None else self.region[index],
            **{name: getattr(self, name)[index] for name in _FIELDS},
        )

    def joined(self, other: Packing, domain: Rectangle) -> Packing:
        """The particles of two packings in one domain."""
        return replace(
            self,
            domain=domain,
            polygons=self.polygons.joined(other.polygons),
            left_over=self.left_over + other.left_over,
            **{n: np.concatenate([getattr(self, n), getattr(other, n)]) for n in _FIELDS},
        )


_FIELDS = ("x", "y", "size", "aspect_ratio", "orientation", "area", "circumradius", "shape")


def tiled(packing: Packing) -> Packing:
    """A periodic cell, first, and those about it as one packing between walls.

    Along axes that repeat, the walls are about all particles.
    """
    cell = packing.domain
    assert isinstance(cell, Cell), "only a cell repeats itself"
    whole = replace(packing, left_over=0)
    copies = [whole.moved(shift) for shift in cell.shifts[1:]]
    for copy in copies:
        whole = whole.joined(copy, cell)
    (left, bottom), (right, top) = np.array(
        [whole.polygons.nodes.min(axis=0), whole.polygons.nodes.max(axis=0)]
    ).tolist()
    if not cell.along_y:
        bottom, top = cell.y_min, cell.y_max
    return replace(whole, domain=Rectangle(left, bottom, right, top))
