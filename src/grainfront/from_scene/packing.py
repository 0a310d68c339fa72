"""From a scene to its packing: particles drawn, hulls placed, a target volume fraction reached."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from grainfront.errors import InputError
from grainfront.from_scene.limits import require_memory, require_outlined, require_resolved
from grainfront.particles import Cell
from grainfront.scene import Scene

if TYPE_CHECKING:
    from grainfront.draw import Coverage
    from grainfront.from_scene.regions import RegionLaws
    from grainfront.laws import Law
    from grainfront.packing.fraction import Attempts
    from grainfront.packing.pack import RunTime
    from grainfront.packing.state import OrientationLaw
    from grainfront.packing.under_way import State
    from grainfront.particles import Packing
    from grainfront.shapes.database import ShapeDatabase

# Every stage draws from a generator of its own, so that none disturbs another.
DRAW_STAGE, PACKING_STAGE = 1, 2
# A domain is never full, so particles of its whole area would be enough if their mean area were
# exact; the margin is for the scatter of that mean.
AREA_MARGIN = 1.05
# The largest size that is reckoned with is exceeded by this share of the particles, at most.
SMALLEST_SHARE = 2.0**-53


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
    domain lies too far from the origin, or is too small or too large for the grains, and where the
    scene's target volume fraction is not reached (see `pack_to_target`).
    Source: Du et al. (2023), doi 10.1016/j.jrmge.2022.03.009, sections 3 and 4.
    """
    from grainfront.packing.pack import fill

    if scene.target is not None:
        return pack_to_target(scene, database, seed, progress)[:2]
    if isinstance(scene.domain, Cell):
        return _pack_cell(scene, scene.domain, database, seed, progress)
    empty = empty_packing(scene, database, seed)
    packing, run_time = fill(empty, database.descriptors["aspect_ratio"], progress)
    _require_particles(scene, packing)
    return packing, run_time


def empty_packing(scene: Scene, database: ShapeDatabase, seed: int) -> State:
    """The domain of the scene without any particle, and all that it needs to be filled.

    `pack` fills it with `grainfront.packing.pack.fill`, and raises what this raises.
    """
    return _empty(scene, database, seed, _generator(seed, PACKING_STAGE))


def pack_to_target(
    scene: Scene,
    database: ShapeDatabase,
    seed: int,
    progress: Callable[[int, float], None] | None = None,
    effort: float | None = None,
) -> tuple[Packing, RunTime, Attempts]:
    """Pack hulls so that the scene's target volume fraction is reached; the attempts it took.

    The volume fraction is that of what the scene ends with: of the outlines, where it replaces
    hulls. `effort`, from 0 (plain advancing front method) to 1 (n_angle and n_loc of the scene), is
    a guess to start with. Raises InputError as `pack` does, and where the target is not reached,
    with the volume fractions that are. Source: `grainfront.packing.fraction`.
    """
    from grainfront.packing.fraction import HALF_WAY, pack_to_fraction

    assert scene.target is not None, "there is no target to be reached"
    rng = _generator(seed, PACKING_STAGE)
    packing, run_time, attempts = pack_to_fraction(
        _empty(scene, database, seed, rng),
        database.descriptors["aspect_ratio"],
        database.descriptors["area" if scene.replacement else "hull_area"],
        scene.target.volume_fraction,
        scene.target.tolerance,
        effort=HALF_WAY if effort is None else effort,
        rng=rng,
        progress=progress,
    )
    _require_particles(scene, packing)
    if not attempts.reached:
        raise InputError(_not_reached(scene, database, seed, attempts))
    return packing, run_time, attempts


def _pack_cell(
    scene: Scene,
    cell: Cell,
    database: ShapeDatabase,
    seed: int,
    progress: Callable[[int, float], None] | None,
) -> tuple[Packing, RunTime]:
    """As `pack`, for a domain that repeats itself."""
    from grainfront.packing.periodic import area_to_fill, pack_periodic

    require_resolved(scene)
    shape_coverage(scene, database)
    aspect_ratio = database.descriptors["aspect_ratio"]
    radius = 0.5 * float(aspect_ratio.mean()) * scene.size.moment(1)
    try:
        area = area_to_fill(cell, radius)
    except InputError as error:
        raise InputError(f"{scene.name}: {error}") from None
    shape, size = _draw_enough(scene, database, scene, area, (seed, DRAW_STAGE))
    packing, run_time, _ = pack_periodic(
        database.hulls,
        aspect_ratio,
        shape,
        size,
        _orientation(scene, scene.orientation),
        cell,
        scene.packing.n_angle,
        scene.packing.n_loc,
        _generator(seed, PACKING_STAGE),
        radius,
        progress,
    )
    _require_particles(scene, packing)
    return packing, run_time


def _not_reached(scene: Scene, database: ShapeDatabase, seed: int, attempts: Attempts) -> str:
    """Why a target was missed, with what the scene reaches."""
    assert scene.target is not None
    area = database.descriptors["area" if scene.replacement else "hull_area"]
    reached = []
    for n_angle, n_loc in ((1, 1), (scene.packing.n_angle, scene.packing.n_loc)):
        effort = dataclasses.replace(scene.packing, n_angle=n_angle, n_loc=n_loc)
        plain = dataclasses.replace(scene, packing=effort, target=None)
        packing, _ = pack(plain, database, seed)
        reached.append(float(np.sum(area[packing.shape] * packing.size**2)) / scene.domain.area)
    target = scene.target.volume_fraction
    closest = min((f.volume_fraction for f in attempts.finishes), key=lambda f: abs(f - target))
    return (
        f"{scene.name}: target_volume_fraction is {target:g}, but this scene reaches "
        f"{reached[0]:.4f} (n_angle and n_loc of 1) to {reached[1]:.4f} (n_angle "
        f"{scene.packing.n_angle}, n_loc {scene.packing.n_loc}), and the closest of "
        f"{len(attempts.finishes)} attempts {closest:.4f}, not within {scene.target.tolerance:g}"
    )


def _empty(scene: Scene, database: ShapeDatabase, seed: int, rng: np.random.Generator) -> State:
    """The domain of the scene, without any particle yet, and the particles to be packed."""
    from grainfront.packing.prepare import prepare

    require_resolved(scene)
    shape_coverage(scene, database)
    if scene.arrangement is not None:
        return _empty_arranged(scene, database, seed, rng)
    shape, size = _draw_enough(scene, database, scene, scene.domain.area, (seed, DRAW_STAGE))
    effort = scene.packing
    return prepare(
        database.hulls,
        shape,
        size,
        [_orientation(scene, scene.orientation)],
        scene.domain,
        effort.n_angle,
        effort.n_loc,
        rng,
    )


def _empty_arranged(
    scene: Scene, database: ShapeDatabase, seed: int, rng: np.random.Generator
) -> State:
    """As `_empty`, with particles for each law of the arrangement."""
    from grainfront.from_scene import regions
    from grainfront.packing.arranged import arrangement_of
    from grainfront.packing.prepare import prepare

    found = regions.plan(scene)
    for law in found.laws:
        _require_shapes(scene, database, law)
    drawn = [
        _draw_enough(scene, database, law, law.area, (seed, DRAW_STAGE, number))
        for number, law in enumerate(found.laws)
    ]
    shape, size = (np.concatenate(parts) for parts in zip(*drawn, strict=True))
    last = np.cumsum([one.size for _, one in drawn])
    require_memory(scene, database, size.size)
    effort = scene.packing
    empty = prepare(
        database.hulls,
        shape,
        size,
        [_orientation(scene, law.orientation) for law in found.laws],
        scene.domain,
        effort.n_angle,
        effort.n_loc,
        rng,
        arrangement_of(found.regions, np.array([law.region for law in found.laws])),
        last,
        float(scene.size.quantile(1.0 - SMALLEST_SHARE)),
    )
    hull_area = float(database.descriptors["hull_area"].mean())
    return empty._replace(keeper=regions.keeper(scene, found, last, size, hull_area))


def _orientation(scene: Scene, law: Law) -> OrientationLaw:
    """The table of an orientation law that the kernel takes."""
    from grainfront.packing.orientations import STEPS_A_BIN, orientation_law

    n_bin = scene.packing.n_bin
    return orientation_law(law.bins(n_bin)[1], law.quantiles_within_support(STEPS_A_BIN * n_bin))


def _require_particles(scene: Scene, packing: Packing) -> None:
    """Raise InputError where nothing was placed."""
    if packing.x.size == 0:
        raise InputError(
            f"{scene.name}: no particle fits into the domain of {scene.domain.width:g} by "
            f"{scene.domain.height:g} {scene.length_unit}: it must have room for the grains drawn"
        )


def _draw_enough(
    scene: Scene,
    database: ShapeDatabase,
    laws: Scene | RegionLaws,
    area: float,
    key: tuple[int, ...],
) -> tuple[np.ndarray, np.ndarray]:
    """Shapes and sizes of so many particles that they cannot all find a place in an area."""
    from grainfront.draw import draw_particles
    from grainfront.packing.turns import WAITING_PLACES

    hull_area = database.descriptors["hull_area"]
    matched = None
    if laws.matched is not None:
        name, law = laws.matched
        matched = database.descriptors[name], law
    mean_area = float(hull_area.mean()) * laws.size.moment(2)
    narrowest = min(scene.domain.width, scene.domain.height)
    n = math.ceil(AREA_MARGIN * area / mean_area) + WAITING_PLACES
    while True:
        require_memory(scene, database, n)
        rng = _generator(*key)
        shape, size = draw_particles(database.count, laws.size, n, rng, matched)
        of_each = np.where(size <= narrowest, hull_area[shape] * size**2, 0.0)
        largest = np.partition(of_each, -WAITING_PLACES)[-WAITING_PLACES:]
        wanted = area + largest.sum()
        if of_each.sum() >= wanted or not of_each.any():
            require_outlined(scene, size)
            return shape, size
        n = math.ceil(AREA_MARGIN * n * wanted / of_each.sum())


def _generator(seed: int, *stage: int) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=stage))


def _require_shapes(scene: Scene, database: ShapeDatabase, law: RegionLaws) -> None:
    """Raise InputError where no shape has the descriptor that follows a law in a region."""
    from grainfront.draw import coverage

    if law.matched is None:
        return
    name, prescribed = law.matched
    try:
        coverage(database.descriptors[name], prescribed)
    except InputError as error:
        key = f"arrangement.regions[{law.region}].{name}"
        raise InputError(f"{scene.name}: {key}: {error}") from None


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
