"""The same scene in other words: scaled, or mirrored with its shapes in the opposite order."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.typing import ArrayLike

from grainfront.laws import Law
from grainfront.particles import Rectangle, Region
from grainfront.polygons import Polygons
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase, standardised_database


@dataclass(frozen=True)
class Scaled(Law):
    """A law whose values are multiplied by `factor`; exactly, where that is a power of two."""

    law: Law
    factor: float

    def quantile(self, u: ArrayLike) -> np.ndarray:
        return self.factor * self.law.quantile(u)

    def cdf(self, x: ArrayLike) -> np.ndarray:
        return self.law.cdf(np.asarray(x) / self.factor)


@dataclass(frozen=True)
class Mirrored(Law):
    """A law of orientations as a mirror shows it: 180 degrees less each value."""

    law: Law

    def quantile(self, u: ArrayLike) -> np.ndarray:
        return 180.0 - self.law.quantile(1.0 - np.asarray(u))

    def cdf(self, x: ArrayLike) -> np.ndarray:
        return 1.0 - self.law.cdf(180.0 - np.asarray(x))


def scaled(scene: Scene, factor: float) -> Scene:
    """The scene with all its lengths multiplied by `factor`."""
    return replace(scene, domain=_scaled(scene.domain, factor), size=Scaled(scene.size, factor))


def _scaled(domain: Rectangle, factor: float) -> Rectangle:
    if isinstance(domain, Region):
        return Region.of(shapely.transform(domain.to_shapely(), lambda nodes: factor * nodes))
    sides = (domain.x_min, domain.y_min, domain.x_max, domain.y_max)
    return Rectangle(*(factor * side for side in sides))


def mirrored(scene: Scene, database: ShapeDatabase) -> tuple[Scene, ShapeDatabase]:
    """Shapes and orientations as a mirror shows them, and the shapes in the opposite order.

    The domain stays where it is: its place matters to rounding alone.
    """
    outlines = [
        (database.outlines.polygon(i) * [-1.0, 1.0])[::-1] for i in reversed(range(database.count))
    ]
    seen = standardised_database(Polygons.of(outlines), {})
    return replace(scene, orientation=Mirrored(scene.orientation)), seen
