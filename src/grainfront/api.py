"""The stages tied together: from a scene to shapes, a packing, its proof and its statistics.

What a stage alone needs is imported when it is called, so that a scene pays only for what it names.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from grainfront.errors import InputError
from grainfront.from_scene.packing import empty_packing as empty_packing
from grainfront.from_scene.packing import pack as pack
from grainfront.from_scene.packing import pack_to_target as pack_to_target
from grainfront.from_scene.packing import shape_coverage as shape_coverage
from grainfront.from_scene.statistics import measure as measure
from grainfront.particles import LEAST_FILLED, Cell, Region
from grainfront.scene import Scene
from grainfront.scene import load_scene as load_scene
from grainfront.shapes.sources import BinaryMasks, LabelMasks, Photographs, ShapeSource

if TYPE_CHECKING:
    from grainfront.certificate import Certificate
    from grainfront.files.contour import Contour
    from grainfront.packing.fraction import Attempts
    from grainfront.particles import Packing
    from grainfront.shapes.database import ShapeDatabase
    from grainfront.statistics import Contacts, OrientationRose

ImageSource = Photographs | BinaryMasks | LabelMasks

# The shapes of a random family are the same for every seed, so that packings differ by the packing
# alone, and one more seed leaves the database as it is.
SHAPES_SEED = 0
# Begins the names of searches among particles of several regions.
ARRANGED = "arranged_"
# Ends the names of searches in domains that are no rectangles.
OUTLINED = "_outlined"
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


def volume_fraction_of_outlines(packing: Packing, database: ShapeDatabase) -> float:
    """Volume fraction that packed hulls have once their outlines have replaced them."""
    area = database.descriptors["area"][packing.shape] * packing.size**2
    return float(area.sum() / packing.domain.area)


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


def write_target(path: str | Path, attempts: Attempts, scene: Scene, seed: int) -> None:
    """Write how a target was reached as NetCDF; InputError where that is impossible."""
    from grainfront.files import target

    assert scene.target is not None, "attempts are made at a target only"
    target.write_target(
        path,
        attempts.finishes,
        scene=scene.text,
        seed=seed,
        length_unit=scene.length_unit,
        target_volume_fraction=scene.target.volume_fraction,
        target_tolerance=scene.target.tolerance,
        packings=attempts.packings,
    )


def effort_from_map(scene: Scene, contour: Contour) -> float:
    """The effort, from 0 to 1, that leads to the target of a scene, from its contour map."""
    from grainfront.packing.fraction import effort_from_map

    assert scene.target is not None, "an effort is looked up for a target only"
    return effort_from_map(
        contour.n_angle,
        contour.n_loc,
        contour.volume_fraction,
        scene.packing.n_angle,
        scene.packing.n_loc,
        scene.target.volume_fraction,
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


def warn_of_empty_rooms(name: str | Path, packing: Packing) -> None:
    """Say on standard error how many rooms of a domain stayed empty: islands, or beyond necks."""
    if not isinstance(packing.domain, Region):
        return
    from grainfront.statistics import find_rooms

    rooms = find_rooms(packing)
    if not rooms.empty.any():
        return
    largest = int(np.argmax(np.where(rooms.empty, rooms.area, 0.0)))
    print(
        f"grainfront: warning: {name}: {rooms.empty.sum()} of {rooms.empty.size} rooms of "
        "the domain, islands or beyond necks narrower than the mean grain, stayed empty, "
        f"{100 * rooms.empty_area / packing.domain.area:.2g} % of its area, the largest of them "
        f"about ({rooms.x[largest]:.4g}, {rooms.y[largest]:.4g}).",
        file=sys.stderr,
    )


def warn_of_much_left_over(name: str | Path, packing: Packing) -> None:
    """Say on standard error how many grains found no place in a domain that is not half full."""
    if not isinstance(packing.domain, Region):
        return
    filled = packing.area.sum() / packing.domain.area
    if filled < LEAST_FILLED:
        print(
            f"grainfront: warning: {name}: only {100 * filled:.2g} % of the domain is filled: "
            f"{packing.left_over} of {packing.left_over + packing.x.size} grains drawn found no "
            "place in what is left.",
            file=sys.stderr,
        )


def warn_of_empty_regions(name: str | Path, scene: Scene, packing: Packing) -> None:
    """Say on standard error which regions of an arrangement got no particle."""
    if scene.arrangement is None or packing.region is None:
        return
    empty = sorted(set(range(len(scene.arrangement.regions))).difference(packing.region.tolist()))
    if empty:
        print(
            f"grainfront: warning: {name}: no particle found a place in "
            f"{', '.join(f'arrangement.regions[{number}]' for number in empty)}: there may be no "
            "room for grains as large.",
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


def searches(scene: Scene) -> list[str]:
    """How the lowest trials of a scene are found: each search has kernels of its own.

    "exhaustive" or "pruned", or "controlled" where the effort follows a target volume fraction; led
    by "arranged_" where there are regions, and followed by "_outlined" in domains that are no
    rectangles. A cell that repeats itself is cut out of a rectangle, and its seam is none.
    """
    from grainfront.packing import search_of

    found = search_of(scene.packing.n_angle, scene.packing.n_loc)
    if scene.target is not None:
        found = "controlled"
    if scene.arrangement is not None:
        found = f"{ARRANGED}{found}"
    if isinstance(scene.domain, Cell):
        return [found, f"{found}{OUTLINED}"]
    return [f"{found}{OUTLINED}" if isinstance(scene.domain, Region) else found]
