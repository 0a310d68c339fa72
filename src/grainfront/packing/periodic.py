"""A packing that repeats itself, for representative volume elements.

A packing somewhat larger than the cell is cut along the borders of the cell. Of two particles that
would overlap across a border, the smaller one is taken out; of some places where the cell may be
cut out, the one where least is lost is taken. A closing pass then fills the hollows along the seam.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import shapely

from grainfront.errors import InputError
from grainfront.packing.pack import RunTime, fill
from grainfront.packing.prepare import prepare
from grainfront.packing.state import CLEARANCE_ULPS, OrientationLaw
from grainfront.particles import Cell, Packing, Rectangle, Region
from grainfront.polygons import Polygons

# The packing reaches this many mean circumradii beyond the cell on each side, walls left out.
BEYOND = 6.0
# Of these, the cell may lie so many nearer to either side.
PLAY = 2.0
# Places along each axis where the cell may be cut out.
CUTS = 9
# Half of the width of the seam that is closed, in mean circumradii.
SEAM = 4.0


def surroundings(cell: Cell, radius: float) -> Rectangle:
    """The rectangle that is packed for a cell to be cut out of, for a mean circumradius.

    Raises InputError where the seams of a cell that narrow would meet.
    """
    narrowest = min(cell.width, cell.height) if cell.along_y else cell.width
    if narrowest <= 2.0 * (SEAM + PLAY) * radius:
        raise InputError(
            f"a periodic cell must be more than {2.0 * (SEAM + PLAY) * radius:.3g} wide along the "
            f"axes that repeat, {SEAM + PLAY:g} mean particles, but is {narrowest:g}"
        )
    beyond = np.array([BEYOND * radius, BEYOND * radius * cell.along_y])
    return Rectangle(
        cell.x_min - beyond[0], cell.y_min - beyond[1],
        cell.x_max + beyond[0], cell.y_max + beyond[1],
    )  # fmt: skip


def area_to_fill(cell: Cell, radius: float) -> float:
    """Area for which `pack_periodic` needs particles; raises InputError as `surroundings` does."""
    return surroundings(cell, radius).area + _seam(cell, SEAM * radius).area


def pack_periodic(
    hulls: Polygons,
    aspect_ratio: np.ndarray,
    shape: np.ndarray,
    size: np.ndarray,
    orientation: OrientationLaw,
    cell: Cell,
    n_angle: int,
    n_loc: int,
    rng: np.random.Generator,
    radius: float,
    progress: Callable[[int, float], None] | None = None,
) -> tuple[Packing, RunTime, float]:
    """Pack a periodic cell; with the run time and the volume fraction before closing.

    Hulls, `shape` and `size` are as in `prepare`; particles, of a mean circumradius `radius`, must
    be enough for `area_to_fill`. `progress` is told of those that the cell is cut out of.
    """
    larger = surroundings(cell, radius)
    empty = prepare(hulls, shape, size, [orientation], larger, n_angle, n_loc, rng)
    packed, time = fill(empty, aspect_ratio, progress)
    if packed.x.size == 0:  # where none fits, all were tried, and none is left for the seam
        return replace(packed, domain=cell), time, 0.0
    kept = max(
        (_cut(packed, cell, offset) for offset in _offsets(PLAY * radius, cell)),
        key=lambda part: float(part.area.sum()),
    )
    used = packed.x.size + packed.left_over
    seam = _seam(cell, SEAM * radius)
    about = _images(kept, cell, seam)
    hollows = prepare(
        hulls, shape[used:], size[used:], [orientation], seam, n_angle, n_loc, rng, fixed=about
    )
    filled, closing = fill(hollows, aspect_ratio)
    both = kept.joined(_brought_home(filled, cell), cell)
    whole_time = RunTime(time.kernel_s + closing.kernel_s, time.compile_s + closing.compile_s)
    return both, whole_time, float(kept.area.sum() / cell.area)


def _offsets(play: float, cell: Cell) -> list[np.ndarray]:
    steps = np.linspace(-play, play, CUTS)
    return [np.array([x, y]) for x in steps for y in (steps if cell.along_y else [0.0])]


def _cut(packed: Packing, cell: Cell, offset: np.ndarray) -> Packing:
    """The particles of the cell, cut out at an offset, without overlaps across its borders."""
    inside = (packed.x - offset[0] >= cell.x_min) & (packed.x - offset[0] < cell.x_max)
    inside &= (packed.y - offset[1] >= cell.y_min) & (packed.y - offset[1] < cell.y_max)
    part = packed.chosen(np.flatnonzero(inside)).moved(-offset)
    near = _near_border(part, cell)
    shapes = part.polygons.chosen(near).to_shapely()
    # of particles closer than this, rounding might make their images overlap
    farthest = float(np.abs(part.polygons.nodes).max(initial=0.0))
    apart = CLEARANCE_ULPS * float(np.spacing(1.0)) * farthest
    clashes = []
    for shift in cell.shifts[1:]:
        tree = shapely.STRtree(shapely.transform(shapes, lambda nodes, by=shift: nodes + by))
        clashes.append(tree.query(shapes, predicate="dwithin", distance=apart).T)
    kept = np.ones(part.x.size, dtype=np.bool_)
    for pair in np.unique(np.sort(near[np.concatenate(clashes)], axis=1), axis=0):
        if kept[pair].all():
            kept[pair[np.argmin(part.area[pair])]] = False
    return part.chosen(np.flatnonzero(kept))


def _near_border(part: Packing, cell: Cell) -> np.ndarray:
    """Particles that may reach those of another cell."""
    reach = 2.0 * float(part.circumradius.max(initial=0.0))
    near = np.minimum(part.x - cell.x_min, cell.x_max - part.x) <= reach
    if cell.along_y:
        near |= np.minimum(part.y - cell.y_min, cell.y_max - part.y) <= reach
    return np.flatnonzero(near)


def _seam(cell: Cell, half_width: float) -> Region:
    """A strip along the left border of the cell, and along its bottom, moved by half a cell."""
    height = 0.5 * cell.height * cell.along_y
    low, high = cell.y_min - height, cell.y_max - height
    seam = shapely.box(cell.x_min - half_width, low, cell.x_min + half_width, high)
    if cell.along_y:
        half = 0.5 * cell.width
        left, right = cell.x_min - half, cell.x_max - half
        seam = seam.union(
            shapely.box(left, cell.y_min - half_width, right, cell.y_min + half_width)
        )
    return Region.of(seam)


def _images(part: Packing, cell: Cell, seam: Region) -> Polygons:
    """The particles of the cell and of those about it that reach into the seam."""
    moved = [part.moved(shift).polygons for shift in cell.shifts]
    strip = seam.to_shapely()
    shapely.prepare(strip)
    return Polygons.of(
        polygons.polygon(i)
        for polygons in moved
        for i in np.flatnonzero(shapely.intersects(strip, polygons.to_shapely())).tolist()
    )


def _brought_home(part: Packing, cell: Cell) -> Packing:
    """The particles moved by whole cells, so that their centres are in the cell."""
    columns = np.floor((part.x - cell.x_min) / cell.width) * -cell.width
    rows = np.floor((part.y - cell.y_min) / cell.height) * -cell.height * cell.along_y
    return part.moved(np.column_stack([columns, rows]))
