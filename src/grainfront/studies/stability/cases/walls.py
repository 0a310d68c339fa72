"""Cases of domains of any shape: a rectangle told as a polygon, many edges, thin walls, islands."""

from __future__ import annotations

from typing import Any

import shapely
from shapely import Point, Polygon, affinity, box

from grainfront.particles import Region
from grainfront.studies.stability.case import Case

NEAR_WALLS = "trials near a wall are held against each of its edges within reach"
FEW_SHARE = "few particles share the tries that end a packing, of all that wait in 24 orientations"


def disc(radius: float, edges: int) -> Any:
    """A regular polygon about (20, 20), its corners on a circle."""
    return Point(20.0, 20.0).buffer(radius, quad_segs=edges // 4)


def behind_thin_walls(thickness: float) -> Any:
    """A square with a hollow ring in it, a fifth of the square's area inside."""
    return box(0, 0, 40, 40).difference(disc(10.0, 48).difference(disc(10.0 - thickness, 48)))


def slanted(width: float) -> Any:
    """A shaft 100 high that leans by 30 degrees."""
    return affinity.rotate(box(0.0, 0.0, width, 100.0), -30.0)


SPIKES = Polygon(
    [(x, y) for n in range(10) for x, y in ((4.0 * n, 0.0), (4.0 * n + 2.0, 30.0))]
    + [(40.0, 0.0), (40.0, 40.0), (0.0, 40.0)]
)
ISLANDS = shapely.union_all([box(x, y, x + 9, y + 9) for x in range(0, 40, 10) for y in (0, 12)])

CASES = [
    Case(name="rectangle told as a polygon", domain=Region.of(box(0, 0, 40, 40)), like="moderate"),
    Case(name="polygon offset by 1e6", domain=Region.of(box(-1e6, 1e6, 40 - 1e6, 40 + 1e6)),
         like="moderate", most_lost=1e-7,
         reason="the clearance is in proportion to the farthest coordinate"),
    Case(name="disc of 40 edges", domain=Region.of(disc(20.0, 40))),
    Case(name="disc of 400 edges", domain=Region.of(disc(20.0, 400)),
         most_growth=70.0, reason=NEAR_WALLS),
    Case(name="behind a wall as thick as a grain", domain=Region.of(behind_thin_walls(1.0))),
    Case(name="behind a wall of 1e-9", domain=Region.of(behind_thin_walls(1e-9))),
    Case(name="spikes", domain=Region.of(SPIKES), most_growth=40.0, reason=FEW_SHARE),
    Case(name="eight islands", domain=Region.of(ISLANDS), most_growth=25.0, reason=FEW_SHARE),
    Case(name="shaft of two grains, slanted", domain=Region.of(slanted(3.0)), handed=True,
         most_growth=25.0, reason=FEW_SHARE),
    Case(name="shaft of one grain, slanted", domain=Region.of(slanted(1.5)), handed=True,
         most_growth=200.0, reason=FEW_SHARE),
]  # fmt: skip
