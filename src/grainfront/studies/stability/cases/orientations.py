"""Cases of orientation: lattices, single and repeated angles, a law narrower than a bin."""

from __future__ import annotations

from dataclasses import replace

from grainfront.laws import Constant, Histogram, Normal, Uniform
from grainfront.shapes.sources import Rectangles, RegularPolygon
from grainfront.studies.stability.case import Case, square
from grainfront.studies.stability.outlines import tilted

SQUARES = Case(
    name="equal squares at 0°, domain 20.5",
    shapes=Rectangles((1.0, 1.0), 1),
    size=Constant(1.0),
    orientation=Constant(0.0),
    domain=square(20.5),
    volume_fraction=20**2 / 20.5**2,
)
# Orientations at two angles: bins as wide as rounding, a gap between.
HAIR = 1e-12
LATTICES = [
    SQUARES,
    replace(SQUARES, name="equal squares at 0°, domain 7.25", domain=square(7.25),
            volume_fraction=7**2 / 7.25**2),
    replace(SQUARES, name="equal squares at 0°, domain 20", domain=square(20.0),
            volume_fraction=19**2 / 20**2,
            reason="with 20 clearances between them, 20 squares are longer than 20"),
    replace(SQUARES, name="equal squares at 90°", orientation=Constant(90.0)),
    replace(SQUARES, name="equal triangles at 0°", shapes=RegularPolygon(3), volume_fraction=None,
            least_fraction=0.5, reason="triangles that all point upwards fill 2/3 at the most"),
    replace(SQUARES, name="equal triangles", shapes=RegularPolygon(3), volume_fraction=None,
            orientation=Uniform(0.0, 180.0)),
]  # fmt: skip
ONE_ANGLE = Case(name="all at 30°", shapes=tilted(0.0), orientation=Constant(30.0), handed=True)
ANGLES = [
    ONE_ANGLE,
    replace(ONE_ANGLE, name="all within 1e-12° of 30°", like="all at 30°",
            orientation=Uniform(30.0, 30.0 + 1e-12),
            most_e2=2.0, reason="a bin is but 12 floating point numbers wide"),
    replace(ONE_ANGLE, name="all within 1e-3° of 30°", like="all at 30°",
            orientation=Normal(mean=30.0, standard_deviation=5.0, minimum=30.0, maximum=30.001)),
    Case(name="all at 0°", shapes=tilted(0.0), orientation=Constant(0.0)),
    Case(name="at 0° and 90°", shapes=tilted(0.0),
         orientation=Histogram((-HAIR, HAIR, 90.0 - HAIR, 90.0 + HAIR), (1.0, 0.0, 1.0))),
    Case(name="identical particles", size=Constant(1.0), orientation=Constant(0.0)),
]  # fmt: skip
CASES = [*LATTICES, *ANGLES]
