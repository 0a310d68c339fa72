"""Pilots: packings smaller than the scene, and what they say of the whole scene.

Walls matter more in a pilot. What they take is seen in the pilot itself, away from them, and goes
with their length; likewise the time at the top, where the last grains find no place.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from grainfront import api
from grainfront.particles import Packing, Rectangle
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import volume_fraction_between

# Depth, in square roots of the mean hull area, to which walls are felt: with 3, 4 or 5 the volume
# fractions foretold were the same within their scatter, which then grows.
WALL_DEPTH = 2.0
# A pilot is so many of the longest grains wide and high, so that none is left out for its size;
# with 3 or 4 the volume fractions foretold of wide sizes and gravel were no closer.
LONGEST_GRAINS = 2.0


class Pilot(NamedTuple):
    """A packing of a part of the domain.

    `volume_fraction` is that of what the scene ends with, hulls or outlines, with the walls of the
    pilot exchanged for those of the scene; `share_of_hulls` its area over that of the hulls.
    """

    n_angle: int
    n_loc: int
    domain: Rectangle
    volume_fraction: float
    particles: int
    mean_hull_area: float
    share_of_hulls: float
    kernel_s: float
    compile_s: float


@dataclass(frozen=True)
class PilotScale:
    """The scene and shapes of pilots, their least `width`, and the `unit` of their sides."""

    scene: Scene
    database: ShapeDatabase
    width: float

    @cached_property
    def unit(self) -> float:
        """Square root of the mean hull area."""
        hull_area = float(self.database.descriptors["hull_area"].mean())
        return float(np.sqrt(hull_area * self.scene.size.moment(2)))

    def domain(self, height: float) -> Rectangle:
        """The lower left of the scene's domain, wider or higher where the other side is short."""
        whole = self.scene.domain
        area = self.width * height * self.unit**2
        diameter = 2.0 * float(np.hypot(*self.database.hulls.nodes.T).max())
        longest = LONGEST_GRAINS * diameter * self.scene.size.support[1]
        least_height = max(height * self.unit, longest)
        least_width = max(self.width * self.unit, longest)
        width = min(whole.width, max(least_width, area / min(whole.height, least_height)))
        height = min(whole.height, max(least_height, area / width))
        return Rectangle(whole.x_min, whole.y_min, whole.x_min + width, whole.y_min + height)


def pack_pilot(scale: PilotScale, n_angle: int, n_loc: int, height: float, seed: int) -> Pilot:
    """Pack a pilot of `height` square roots of the mean hull area."""
    scene, database = scale.scene, scale.database
    part = replace(
        scene,
        packing=replace(scene.packing, n_angle=n_angle, n_loc=n_loc),
        domain=scale.domain(height),
        target=None,
    )
    packing, run_time = api.pack(part, database, seed)
    share = 1.0
    if scene.replacement:
        area = database.descriptors["area"][packing.shape] * packing.size**2
        share = float(area.sum() / packing.area.sum())
    return Pilot(
        n_angle,
        n_loc,
        packing.domain,
        share * fraction_with_walls_of(scene.domain, packing, WALL_DEPTH * scale.unit),
        packing.x.size,
        float(packing.area.mean()),
        share,
        run_time.kernel_s,
        run_time.compile_s,
    )


def fraction_with_walls_of(whole: Rectangle, packing: Packing, wall_depth: float) -> float:
    """Volume fraction of hulls that `whole` would have, from a packing of a part of it.

    Opposite walls take a share of the area in inverse proportion to their distance, seen where the
    strips along them, `wall_depth` wide, are left out: φ = φ_bulk (1 − a / width)(1 − b / height).
    A side as long as that of the whole is left as it is.
    """
    domain = packing.domain
    found = float(packing.area.sum() / domain.area)
    expected = found
    for axis, length, full in ((0, domain.width, whole.width), (1, domain.height, whole.height)):
        if length < full:
            low = (domain.x_min, domain.y_min)[axis] + wall_depth
            high = (domain.x_max, domain.y_max)[axis] - wall_depth
            gain = volume_fraction_between(packing, axis, low, high) / found - 1.0
            expected *= 1.0 + gain * (1.0 - length / full)
    return expected


def seconds_in(whole: Rectangle, pilots: list[Pilot]) -> float:
    """Kernel seconds of the whole: so much for each area, and for each width of the top."""
    cost = np.array([[p.domain.area, p.domain.width] for p in pilots])
    # equal heights leave the two apart undetermined, and then the least squares of least norm,
    # which give the seconds of that height, are meant: so the columns must be alike in size
    scale = cost.max(axis=0)
    seconds = np.array([pilot.kernel_s for pilot in pilots])
    solution = np.linalg.lstsq(cost / scale, seconds, rcond=None)[0]
    return float(np.array([whole.area, whole.width]) / scale @ solution)
