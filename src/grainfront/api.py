"""The stages tied together: from a scene to shapes, a packing, its proof and its statistics.

What a stage alone needs is imported when it is called, so that a scene pays only for what it names.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from grainfront.errors import InputError
from grainfront.scene import Scene
from grainfront.scene import load_scene as load_scene
from grainfront.shapes.sources import BinaryMasks, LabelMasks, Photographs, ShapeSource

if TYPE_CHECKING:
    from grainfront.certificate import Certificate
    from grainfront.draw import Coverage
    from grainfront.packing.pack import RunTime
    from grainfront.particles import Packing
    from grainfront.shapes.database import ShapeDatabase
    from grainfront.statistics import Contacts, OrientationRose, PackingStatistics

ImageSource = Photographs | BinaryMasks | LabelMasks

# Every stage draws from a generator of its own, so that none disturbs another.
DRAW_STAGE, PACKING_STAGE = 1, 2
# The shapes of a random family are the same for every seed, so that packings differ by the packing
# alone, and one more seed leaves the database as it is.
SHAPES_SEED = 0
# A domain is never full, so particles of its whole area would be enough if their mean area were
# exact; the margin is for the scatter of that mean.
AREA_MARGIN = 1.05
# More particles than this are refused: their arrays would fill some 10 GB.
MOST_PARTICLES = 5 * 10**7
# A progress bar shows up only on packings that take longer than this.
SECONDS_BEFORE_BAR = 1.0


def build_shapes(scene: Scene) -> ShapeDatabase:
    """Build the shape database of a scene, the same one for all its seeds.

    Raises InputError where an image or an outlines file is at fault.
    """
    return build_shapes_of(scene.shapes)


def build_shapes_of(source: ShapeSource) -> ShapeDatabase:
    """Build the shape database of a source alone, as the scenes that name it get it."""
    from grainfront.shapes.database import build_database

    return build_database(source, np.random.default_rng(SHAPES_SEED))


def shape_coverage(scene: Scene, database: ShapeDatabase) -> Coverage | None:
    """How far the shapes can follow the scene's law of a descriptor; None where there is none."""
    from grainfront.draw import coverage

    if scene.matched is None:
        return None
    name, law = scene.matched
    try:
        return coverage(database.descriptors[name], law)
    except InputError as error:
        raise InputError(f"{scene.name}: {name}: {error}") from None


def pack(
    scene: Scene,
    database: ShapeDatabase,
    seed: int,
    progress: Callable[[int, float], None] | None = None,
) -> tuple[Packing, RunTime]:
    """Pack hulls of the database into the domain of the scene until it is full.

    `seed` decides sizes, shapes and orientations: the same scene, database and seed give the same
    packing, bit for bit. `progress` is told the particles placed and the volume fraction so far.
    Raises InputError where no shape has the descriptor that is to follow a law, and where the
    domain lies too far from the origin, or is too small or too large for the grains.
    Source: Du et al. (2023), doi 10.1016/j.jrmge.2022.03.009, sections 3 and 4.
    """
    from grainfront.packing.orientations import STEPS_A_BIN, orientation_law
    from grainfront.packing.pack import pack_hulls

    _require_resolved(scene)
    shape_coverage(scene, database)
    shape, size = _draw_enough(scene, database, seed)
    effort = scene.packing
    law = scene.orientation
    packing, run_time = pack_hulls(
        database.hulls,
        database.descriptors["aspect_ratio"],
        shape,
        size,
        orientation_law(
            law.bins(effort.n_bin)[1], law.quantiles_within_support(STEPS_A_BIN * effort.n_bin)
        ),
        scene.domain,
        n_angle=effort.n_angle,
        n_loc=effort.n_loc,
        rng=_generator(seed, PACKING_STAGE),
        progress=progress,
    )
    if packing.x.size == 0:
        raise InputError(
            f"{scene.name}: no particle fits into the domain of {scene.domain.width:g} by "
            f"{scene.domain.height:g} {scene.length_unit}: it must have room for the grains drawn"
        )
    return packing, run_time


def _require_resolved(scene: Scene) -> None:
    """Raise InputError where the rounding of coordinates would open the contacts of the grains."""
    from grainfront.packing.state import CLEARANCE_ULPS
    from grainfront.particles import CONTACT_TOLERANCE

    domain = scene.domain
    farthest = max(map(abs, (domain.x_min, domain.y_min, domain.x_max, domain.y_max)))
    # the clearance between placed particles may take up half of a contact's tolerance
    clearance = 0.5 * CONTACT_TOLERANCE * scene.size.moment(1)
    allowed = clearance / (CLEARANCE_ULPS * float(np.spacing(1.0)))
    if farthest > allowed:
        raise InputError(
            f"{scene.name}: domain reaches to a coordinate of {farthest:g}, but must stay within "
            f"{allowed:.3g}, beyond which rounding spoils the contacts of grains of these sizes"
        )


def _draw_enough(scene: Scene, database: ShapeDatabase, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Shapes and sizes of so many particles that they cannot all find a place."""
    from grainfront.draw import draw_particles
    from grainfront.packing.advance import WAITING_PLACES

    hull_area = database.descriptors["hull_area"]
    matched = None
    if scene.matched is not None:
        name, law = scene.matched
        matched = database.descriptors[name], law
    mean_area = float(hull_area.mean()) * scene.size.moment(2)
    narrowest = min(scene.domain.width, scene.domain.height)
    n = math.ceil(AREA_MARGIN * scene.domain.area / mean_area) + WAITING_PLACES
    while n <= MOST_PARTICLES:
        rng = _generator(seed, DRAW_STAGE)
        shape, size = draw_particles(database.count, scene.size, n, rng, matched)
        area = np.where(size <= narrowest, hull_area[shape] * size**2, 0.0)
        largest = np.partition(area, -WAITING_PLACES)[-WAITING_PLACES:]
        wanted = scene.domain.area + largest.sum()
        if area.sum() >= wanted or not area.any():
            return shape, size
        n = math.ceil(AREA_MARGIN * n * wanted / area.sum())
    raise InputError(
        f"{scene.name}: a domain of {scene.domain.width:g} × {scene.domain.height:g} takes more "
        f"than {MOST_PARTICLES:,} particles of these sizes to fill, but at most that many are "
        "allowed"
    )


def _generator(seed: int, stage: int) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(stage,)))


def replace(packing: Packing, database: ShapeDatabase) -> Packing:
    """Give each packed hull its own outline back (Du et al. 2023, section 4.3.4).

    Raises InputError where the packing was not made of these shapes.
    """
    from grainfront.replacement import replace_hulls

    return replace_hulls(packing, database.outlines, database.hulls, database.hull_nodes)


def certify(packing: Packing) -> Certificate:
    """Prove, exactly, that no two particles share interior points and none crosses a wall.

    Raises InputError where a polygon is not finite, simple and counter-clockwise.
    """
    from grainfront import certificate

    return certificate.certify(packing)


def require_certificate(name: str | Path, packing: Packing) -> Certificate:
    """The certificate of a packing; InputError naming it where the certificate does not hold."""
    certificate = certify(packing)
    if not certificate.holds:
        raise InputError(
            f"{name}: the certificate does not hold: {certificate.overlaps} pairs of particles "
            f"share interior points and {certificate.across_wall} particles cross a wall, but "
            "there must be none"
        )
    return certificate


def volume_fractions(packing: Packing) -> tuple[float, float]:
    """Volume fraction of the domain, and of its inside away from the walls."""
    from grainfront import statistics

    return statistics.volume_fraction(packing), statistics.volume_fraction_bulk(packing)


def measure(scene: Scene, database: ShapeDatabase, packing: Packing) -> PackingStatistics:
    """Measure fractions, contacts and segregation, and compare what was placed with the laws.

    Raises InputError for a packing without particles.
    """
    from grainfront import statistics

    laws = {"size": (packing.size, *scene.size.bins(statistics.N_BIN))}
    if scene.matched is not None:
        name, law = scene.matched
        placed = database.descriptors[name][packing.shape]
        laws[name] = (placed, *law.bins(statistics.N_BIN))
    laws["orientation"] = (packing.orientation, *scene.orientation.bins(statistics.N_BIN))
    return statistics.measure(packing, laws)


def contact_rose(contacts: Contacts) -> OrientationRose | None:
    """The rose of the normals of the contacts between particles; None where there are none."""
    from grainfront.statistics import orientation_rose

    if not len(contacts.pairs):
        return None
    return orientation_rose(np.degrees(np.arctan2(contacts.normal[:, 1], contacts.normal[:, 0])))


def write_shapes(path: str | Path, database: ShapeDatabase, source: ShapeSource) -> None:
    """Write the shape database of a source as NetCDF; InputError where that is impossible."""
    from grainfront.files import netcdf

    netcdf.write_shapes(
        path,
        database,
        source=repr(source),
        seed=SHAPES_SEED,
        source_unit="pixel" if isinstance(source, ImageSource) else "1",
    )


def write_packing(path: str | Path, packing: Packing, scene: Scene, seed: int) -> None:
    """Write a packing of a scene as NetCDF; InputError where that is impossible."""
    from grainfront.files import netcdf

    netcdf.write_packing(
        path,
        packing,
        scene_text=scene.text,
        seed=seed,
        length_unit=scene.length_unit,
        volume_fraction=float(packing.area.sum() / packing.domain.area),
    )


def warn_of_uncovered(scene: Scene, database: ShapeDatabase) -> None:
    """Say on standard error which share of the particles cannot follow the law of a descriptor."""
    found = shape_coverage(scene, database)
    if scene.matched is not None and found is not None and found.empty_bins:
        print(
            f"grainfront: warning: {scene.name}: no shape lies in {found.empty_bins} of "
            f"{found.shapes_per_bin.size} bins of the {scene.matched[0]} law, so that "
            f"{100 * found.empty_probability:.2g} % of the particles get the closest shapes from "
            "other bins.",
            file=sys.stderr,
        )


def sentence(error: Exception) -> str:
    """What a user is told of an error in the input or in reading and writing: one sentence."""
    text = " ".join(str(error).split()).rstrip(".") or type(error).__name__
    if isinstance(error, MemoryError):
        text = f"the memory of this machine does not suffice ({text})"
    return f"grainfront: {text}."


@contextmanager
def progress_bar() -> Iterator[Callable[[int, float], None] | None]:
    """A bar of particles, volume fraction and particles/s for `pack`, on a terminal only."""
    if not sys.stderr.isatty():
        yield None
        return
    from tqdm import tqdm

    with tqdm(desc="packing", unit=" particles", delay=SECONDS_BEFORE_BAR) as bar:

        def tell(placed: int, volume_fraction: float) -> None:
            bar.set_postfix_str(f"volume fraction {volume_fraction:.3f}", refresh=False)
            bar.update(placed - bar.n)

        yield tell


def search(scene: Scene) -> str:
    """How the lowest trials of a scene are found, "exhaustive" or "pruned": it has own kernels."""
    from grainfront.packing import search_of

    return search_of(scene.packing.n_angle, scene.packing.n_loc)
