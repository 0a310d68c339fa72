"""What must be true of whatever is packed, and of the files written of it."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np

import grainfront
from grainfront import api
from grainfront.certificate import Certificate
from grainfront.errors import InputError
from grainfront.files import netcdf
from grainfront.files.statistics import SceneStatistics, read_statistics, write_statistics
from grainfront.packing.pack import fill
from grainfront.particles import Cell, Packing, Rectangle, Region
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import PackingStatistics
from grainfront.statistics.fractions import volume_fraction_between
from grainfront.studies.stability.run import unaccounted

# Rounding of an area that is summed from hundreds of others.
ROUNDING = 1e-9
# Arcs of discs that round a room off are polygons themselves.
ROUNDED_OFF = 0.01
SLICES = 4


def check_packing(path: Path, folder: Path) -> None:
    """Pack a scene twice, and check both, their statistics and their files."""
    scene = api.load_scene(path)
    database = api.build_shapes(scene)
    packing, _ = api.pack(scene, database, scene.seeds[0])
    again, _ = api.pack(scene, database, scene.seeds[0])
    assert packing.polygons.nodes.tobytes() == again.polygons.nodes.tobytes(), "not the same again"

    certificate = api.certify(packing)
    assert certificate.holds, certificate
    _check_particles(scene, database, packing)
    _check_accounted_for(scene, database, packing)
    measured = api.measure(scene, database, packing)
    _check_statistics(packing, measured)
    _check_slices(packing)
    _check_files(scene, database, packing, measured, certificate, folder)


def _check_particles(scene: Scene, database: ShapeDatabase, packing: Packing) -> None:
    hull_area = database.descriptors["hull_area"][packing.shape] * packing.size**2
    assert np.allclose(packing.area, hull_area, rtol=ROUNDING, atol=0)
    low, high = scene.size.quantile([0.0, 1.0])
    if scene.arrangement is None:
        assert (packing.size >= low * (1 - ROUNDING)).all()
        assert (packing.size <= high * (1 + ROUNDING)).all()
    domain = packing.domain
    assert (packing.x >= domain.x_min).all() and (packing.x <= domain.x_max).all()
    assert (packing.y >= domain.y_min).all() and (packing.y <= domain.y_max).all()
    if scene.target is not None:
        area = database.descriptors["area" if scene.replacement else "hull_area"]
        reached = np.sum(area[packing.shape] * packing.size**2) / packing.domain.area
        assert abs(reached - scene.target.volume_fraction) <= scene.target.tolerance * (1 + 1e-6)


def _check_accounted_for(scene: Scene, database: ShapeDatabase, packing: Packing) -> None:
    """Every particle drawn is placed once or left over."""
    assert packing.left_over >= 0
    low, high = scene.size.quantile([0.0, 1.0])
    if isinstance(scene.domain, Cell):
        # those that clash across a border are taken out, but none comes twice
        assert low == high or np.unique(packing.size).size == packing.size.size
    elif scene.target is None and scene.arrangement is None:
        state = api.empty_packing(scene, database, scene.seeds[0])
        same, _ = fill(state, database.descriptors["aspect_ratio"])
        assert same.polygons.nodes.tobytes() == packing.polygons.nodes.tobytes()
        assert unaccounted(state, packing.left_over) == 0


def _check_statistics(packing: Packing, measured: PackingStatistics) -> None:
    """Numbers are finite, or NaN where that is documented, and fractions are fractions."""
    domain, n = packing.domain, packing.x.size
    assert measured.particles == n
    assert 0 < measured.volume_fraction < 1 + ROUNDING
    bulk = measured.volume_fraction_bulk
    assert np.isnan(bulk) or -ROUNDING < bulk < 1 + ROUNDING, bulk
    assert -ROUNDING < measured.void_ratio < np.inf
    assert 0 <= measured.empty_area <= domain.area * (1 + ROUNDED_OFF)
    assert 0 <= measured.coordination_number < 100
    assert measured.contacts_per_particle.shape == (n,)
    assert np.isclose(measured.contact_shares.sum(), 1)
    assert np.isclose(measured.orientation_rose.shares.sum(), 1)
    for distribution in measured.distributions.values():
        assert 0 <= distribution.l2_error < 2 and 0 <= distribution.noise_level <= 1
    repeats, along_y = isinstance(domain, Cell), isinstance(domain, Cell) and domain.along_y
    correlation = measured.size_correlation
    for value, undefined in (
        (correlation.x, repeats), (correlation.y, along_y), (correlation.centre, repeats),
    ):  # fmt: skip
        assert np.isnan(value) if undefined else abs(value) <= 1 + ROUNDING, correlation
    n_walls = domain.rings.count if isinstance(domain, Region) else 4
    wall = measured.contacts.wall
    assert ((wall >= 0) & (wall < n_walls)).all()
    assert np.isfinite(measured.contacts.position).all()
    assert np.allclose(np.hypot(*measured.contacts.normal.T), 1)


def _check_slices(packing: Packing) -> None:
    """Fractions of slices are fractions, and add up to the whole."""
    domain = packing.domain
    sides = ((domain.x_min, domain.x_max), (domain.y_min, domain.y_max))
    for axis, (low, high) in enumerate(sides):
        edges = np.linspace(low, high, SLICES + 1)
        solid = 0.0
        for a, b in itertools.pairwise(edges.tolist()):
            fraction = volume_fraction_between(packing, axis, a, b)
            assert np.isnan(fraction) or -ROUNDING < fraction < 1 + 1e-6, (axis, a, b, fraction)
            solid += 0.0 if np.isnan(fraction) else fraction * _area_between(domain, axis, a, b)
        assert np.isclose(solid, packing.area.sum(), rtol=1e-6, atol=0), axis


def _area_between(domain: Rectangle, axis: int, low: float, high: float) -> float:
    import shapely

    if not isinstance(domain, Region):
        return (high - low) * (domain.height if axis == 0 else domain.width)
    sides = np.array([domain.x_min, domain.y_min, domain.x_max, domain.y_max])
    sides[[axis, axis + 2]] = low, high
    return float(shapely.intersection(domain.to_shapely(), shapely.box(*sides)).area)


def _check_files(
    scene: Scene,
    database: ShapeDatabase,
    packing: Packing,
    measured: PackingStatistics,
    certificate: Certificate,
    folder: Path,
) -> None:
    """What is written is read again, bit for bit, the domain too."""
    seed = scene.seeds[0]
    api.write_packing(folder / "packing.nc", packing, scene, seed)
    read = netcdf.read_packing(folder / "packing.nc")
    assert type(read.domain) is type(packing.domain) and read.domain == packing.domain
    assert read.domain == scene.domain
    assert read.left_over == packing.left_over
    assert read.polygons.nodes.tobytes() == packing.polygons.nodes.tobytes()
    api.write_shapes(folder / "shapes.nc", database, scene.shapes)
    shapes = netcdf.read_shapes(folder / "shapes.nc")
    assert shapes.outlines.nodes.tobytes() == database.outlines.nodes.tobytes()
    if scene.replacement:
        outlines = grainfront.replace(read, shapes)
        assert api.certify(outlines).holds
        assert (outlines.area <= packing.area * (1 + ROUNDING)).all()
    texts = {"scene_text": scene.text, "length_unit": scene.length_unit}
    netcdf.write_contacts(folder / "contacts.nc", measured.contacts, seed=seed, **texts)
    contacts = netcdf.read_contacts(folder / "contacts.nc")
    assert contacts.pairs.tobytes() == measured.contacts.pairs.tobytes()
    found = SceneStatistics.of([seed], [measured], [certificate])
    write_statistics(folder / "statistics.nc", found, **texts)
    for name, value in read_statistics(folder / "statistics.nc").values.items():
        assert value.tobytes() == found.values[name].tobytes(), name


def require_one_sentence(error: InputError) -> None:
    sentence = api.sentence(error)
    assert sentence.count("\n") == 0 and len(sentence) < 1000
