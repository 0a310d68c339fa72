"""Shapes, packings and contacts as NetCDF files.

Polygons are a geometry container of the CF conventions (CF-1.9, section 7.5), rings closed.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from grainfront.errors import InputError
from grainfront.files.contract import CONTACTS, PACKING, SHAPES
from grainfront.files.dataset import Path, read_dataset, write_dataset
from grainfront.particles import Cell, Packing, Rectangle, Region
from grainfront.polygons import Polygons

if TYPE_CHECKING:
    from grainfront.shapes.database import ShapeDatabase
    from grainfront.statistics.contacts import Contacts

PARTICLE_FIELDS = (
    "x", "y", "size", "aspect_ratio", "orientation", "area", "circumradius", "shape"
)  # fmt: skip

# How the attribute `periodic` tells of a cell: that repeats itself along x alone, and along y too.
PERIODIC = ("x", "x y")


def write_packing(
    path: Path,
    packing: Packing,
    *,
    scene_text: str,
    seed: int,
    length_unit: str,
    volume_fraction: float,
) -> None:
    """Write hulls as packed, or the outlines that replaced them; equal input gives equal bytes.

    Errors: InputError where an array breaks the contract or the folder cannot be written to.
    """
    fields = {name: getattr(packing, name) for name in PARTICLE_FIELDS}
    if packing.region is not None:
        fields["region"] = packing.region
    attributes: dict[str, Any] = {
        "scene": scene_text,
        "seed": seed,
        "length_unit": length_unit,
        "volume_fraction": float(volume_fraction),
        "domain": _to_wkt(packing.domain),
        "left_over": packing.left_over,
    }
    if isinstance(packing.domain, Cell):
        attributes["periodic"] = PERIODIC[packing.domain.along_y]
    write_dataset(path, PACKING, _closed_rings(packing.polygons) | fields, attributes)


def read_packing(path: Path) -> Packing:
    """The packing at `path`, bit for bit as written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    arrays, attributes = read_dataset(path, PACKING)
    return Packing(
        domain=_domain(path, attributes),
        polygons=_open_rings(path, arrays),
        left_over=attributes["left_over"],
        region=arrays.get("region"),
        **{name: arrays[name] for name in PARTICLE_FIELDS},
    )


def write_shapes(
    path: Path, database: ShapeDatabase, *, source: str, seed: int, source_unit: str
) -> None:
    """Write standardised shapes; `source` says where they come from, in lengths of `source_unit`.

    Errors: InputError where an array breaks the contract or the folder cannot be written to.
    """
    # The rings of the file are closed: every earlier outline moves the nodes by one.
    owner = np.repeat(np.arange(database.hulls.count), database.hulls.node_counts)
    hulls = {
        "hull_node_count": database.hulls.node_counts,
        "hull_node": database.hull_nodes + owner,
    }
    counts = {f"count_{name}": count for name, count in database.counts.items()}
    attributes = {"source": source, "seed": seed, "source_unit": source_unit, **counts}
    arrays = _closed_rings(database.outlines) | hulls | database.descriptors
    write_dataset(path, SHAPES, arrays, attributes)


def read_shapes(path: Path) -> ShapeDatabase:
    """The shape database at `path`, bit for bit as written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    from grainfront.shapes.database import ShapeDatabase

    arrays, attributes = read_dataset(path, SHAPES)
    outlines = _open_rings(path, arrays)
    counts = arrays.pop("hull_node_count")
    nodes = arrays.pop("hull_node") - np.repeat(np.arange(counts.size), counts)
    if nodes.size != counts.sum() or not _within(nodes, len(outlines.nodes)):
        raise InputError(f"{path}: hull_node does not index the nodes of the outlines")
    geometry = ("node_count", "node_x", "node_y")
    return ShapeDatabase(
        outlines=outlines,
        hulls=Polygons(outlines.nodes[nodes], _offsets(counts)),
        hull_nodes=nodes,
        descriptors={name: a for name, a in arrays.items() if name not in geometry},
        counts={
            name.removeprefix("count_"): count
            for name, count in attributes.items()
            if name.startswith("count_")
        },
    )


def write_contacts(
    path: Path, contacts: Contacts, *, scene_text: str, seed: int, length_unit: str
) -> None:
    """Write the contacts of one packing, the pairs of particles and those with walls.

    Errors: InputError where an array breaks the contract or the folder cannot be written to.
    """
    arrays = {
        "particle_a": contacts.pairs[:, 0],
        "particle_b": contacts.pairs[:, 1],
        "x": contacts.position[:, 0],
        "y": contacts.position[:, 1],
        "normal_x": contacts.normal[:, 0],
        "normal_y": contacts.normal[:, 1],
        "wall_particle": contacts.wall_particle,
        "wall": contacts.wall,
    }
    attributes = {"scene": scene_text, "seed": seed, "length_unit": length_unit}
    write_dataset(path, CONTACTS, arrays, attributes)


def read_contacts(path: Path) -> Contacts:
    """The contacts at `path`, bit for bit as written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    from grainfront.statistics.contacts import Contacts

    arrays, _ = read_dataset(path, CONTACTS)

    def columns(a: str, b: str) -> np.ndarray:
        return np.stack([arrays[a], arrays[b]], axis=1)

    return Contacts(
        pairs=columns("particle_a", "particle_b"),
        position=columns("x", "y"),
        normal=columns("normal_x", "normal_y"),
        wall_particle=arrays["wall_particle"],
        wall=arrays["wall"],
    )


def read_attributes(path: Path) -> Mapping[str, Any]:
    """Global attributes of the packing at `path`: scene, seed, length_unit, volume_fraction …

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    return read_dataset(path, PACKING)[1]


def _closed_rings(polygons: Polygons) -> dict[str, np.ndarray]:
    """Node count and coordinates with each first node repeated, which GDAL needs."""
    order = np.insert(np.arange(len(polygons.nodes)), polygons.offsets[1:], polygons.offsets[:-1])
    x, y = polygons.nodes[order].T
    return {"node_count": polygons.node_counts + 1, "node_x": x, "node_y": y}


def _open_rings(path: Path, arrays: Mapping[str, np.ndarray]) -> Polygons:
    closed = _offsets(arrays["node_count"])
    if closed[-1] != arrays["node_x"].size or (arrays["node_count"] < 4).any():
        raise InputError(
            f"{path}: node_count must hold four nodes or more a ring and add up to the "
            f"{arrays['node_x'].size} nodes of the file"
        )
    nodes = np.stack([arrays["node_x"], arrays["node_y"]], axis=1)
    return Polygons(np.delete(nodes, closed[1:] - 1, axis=0), closed - np.arange(closed.size))


def _offsets(counts: np.ndarray) -> np.ndarray:
    return np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)


def _within(index: np.ndarray, size: int) -> bool:
    return bool(((index >= 0) & (index < size)).all())


def _to_wkt(domain: Rectangle) -> str:
    """The domain as WKT; Python's shortest digits give every float back exactly."""
    if isinstance(domain, Region):
        polygons = (
            f"({', '.join(_ring_to_wkt(domain.rings.polygon(r)) for r in range(first, last))})"
            for first, last in itertools.pairwise(domain.parts.tolist())
        )
        return f"MULTIPOLYGON ({', '.join(polygons)})"
    x0, y0, x1, y1 = domain.x_min, domain.y_min, domain.x_max, domain.y_max
    return f"POLYGON ({_ring_to_wkt(np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]))})"


def _domain(path: Path, attributes: Mapping[str, Any]) -> Rectangle:
    domain = _from_wkt(path, attributes["domain"])
    if "periodic" not in attributes:
        return domain
    if isinstance(domain, Region) or attributes["periodic"] not in PERIODIC:
        raise InputError(
            f"{path}: periodic is {attributes['periodic']!r}, but must be "
            f"{' or '.join(map(repr, PERIODIC))}, and the domain a rectangle"
        )
    along_y = attributes["periodic"] == PERIODIC[True]
    return Cell(domain.x_min, domain.y_min, domain.x_max, domain.y_max, along_y)


def _ring_to_wkt(ring: np.ndarray) -> str:
    nodes = [*ring.tolist(), ring[0].tolist()]
    return f"({', '.join(f'{x!r} {y!r}' for x, y in nodes)})"


def _from_wkt(path: Path, text: str) -> Rectangle:
    """The rectangle that `_to_wkt` wrote as a polygon, or the region it wrote as a multipolygon."""
    import shapely

    try:
        domain = shapely.from_wkt(text)
    except shapely.GEOSException as error:
        raise InputError(f"{path}: the domain is no WKT polygon ({error})") from error
    if domain.geom_type == "MultiPolygon":
        try:
            return Region.of(domain)
        except InputError as error:
            raise InputError(f"{path}: {error}") from None
    if domain.geom_type != "Polygon" or domain.is_empty:
        raise InputError(f"{path}: the domain is {text:.40}, but must be a polygon with an area")
    return Rectangle(*domain.bounds)
