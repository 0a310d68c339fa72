"""What a case of the stability matrix is: a scene, and what is expected of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from grainfront.laws import Law, Uniform
from grainfront.particles import Rectangle
from grainfront.polygons import Polygons
from grainfront.scene import PackingEffort, Scene
from grainfront.shapes.database import ShapeDatabase, build_database, standardised_database
from grainfront.shapes.sources import RandomConvexPolygons, ShapeSource

Effort = tuple[int, int]  # n_angle, n_loc
PLAIN: Effort = (1, 1)
OPTIMISED: Effort = (24, 20)
N_BIN = 24
# The shapes of the random families; every case of a family has the same.
SHAPES_SEED = 0

# What holds of a case that says nothing else.
SEEDS = 4
MOST_GROWTH = 10.0
LEAST_FRACTION = 0.75
MOST_E2 = 1.0
MOST_LOST = 1e-9

# Why packings of slivers may leave much of the domain empty.
STEERED = "it ends where no grain in waiting fits in the orientations that its law offers"


def square(side: float, x: float = 0.0, y: float = 0.0) -> Rectangle:
    """A square domain with its lower left corner at (x, y)."""
    return Rectangle(x, y, x + side, y + side)


# The moderate case, from which the others differ in as little as they can.
POLYGONS = RandomConvexPolygons(vertices=8, count=50)
SIZES = Uniform(0.5, 1.5)
ALL_ORIENTATIONS = Uniform(0.0, 180.0)
DOMAIN = square(40.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Case:
    """A scene, packed at each of `efforts` for `seeds` seeds, and what is expected of it.

    Lengths are in any unit, orientations in degrees; `shapes` are a source or outlines.

    A case is `refused` with a sentence that holds these words, or else it is packed. Beyond what
    holds of every packing: its volume fraction is `volume_fraction`, if that is known exactly; is
    that of the case `like`, within the noise; is `least_fraction` of the moderate case's at least.
    A particle takes `most_growth` times as long as in the moderate case, at most; E2 is `most_e2`
    noise levels, at most; clearances take `most_lost` of the domain, at most. Where any of these
    four is loosened, `reason` tells why. `handed`: the mirror image is another packing. The time of
    a particle is fitted along the cases of a `series`, each at its place, `at`.
    """

    name: str
    group: str = ""
    shapes: ShapeSource | Polygons = POLYGONS
    size: Law = SIZES
    orientation: Law = ALL_ORIENTATIONS
    domain: Rectangle = DOMAIN
    efforts: tuple[Effort, ...] = (PLAIN, OPTIMISED)
    seeds: int = SEEDS
    refused: str = ""
    volume_fraction: float | None = None
    like: str = ""
    handed: bool = False
    series: str = ""
    at: float = 0.0
    most_growth: float = MOST_GROWTH
    least_fraction: float = LEAST_FRACTION
    most_e2: float = MOST_E2
    most_lost: float = MOST_LOST
    reason: str = ""

    def database(self) -> ShapeDatabase:
        """The shapes, standardised."""
        if isinstance(self.shapes, Polygons):
            return standardised_database(self.shapes, {})
        return build_database(self.shapes, np.random.default_rng(SHAPES_SEED))

    def scene(self, effort: Effort) -> Scene:
        """The scene at an effort."""
        return Scene(
            name=self.name,
            text="",
            length_unit="1",
            seeds=tuple(range(1, self.seeds + 1)),
            domain=self.domain,
            shapes=self.shapes if not isinstance(self.shapes, Polygons) else OUTLINES,
            size=self.size,
            matched=None,
            orientation=self.orientation,
            packing=PackingEffort(*effort, N_BIN),
        )


# What a scene names where a case brings outlines of its own; it is never read.
OUTLINES = RandomConvexPolygons()
MODERATE = Case(name="moderate", group="moderate")
