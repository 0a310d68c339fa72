"""Cases of shape: aspect ratio, number of edges, edges nearly parallel, slivers."""

from __future__ import annotations

from grainfront.shapes.sources import Rectangles, RegularPolygon
from grainfront.studies.stability.case import MOST_GROWTH, SEEDS, STEERED, Case, square
from grainfront.studies.stability.outlines import bulging, many_edges, sliver, tilted

LONG = "long grains leave wide gaps, most of all where each has one orientation alone"
MANY_EDGES = "the new particle is turned and tested edge by edge: time grows with their number"

# Part of the moderate case's volume fraction that is reached at least.
LEAST_FRACTIONS = {1: 0.75, 5: 0.6, 20: 0.2, 50: 0.1, 100: 0.05}
ASPECT_RATIOS = [
    Case(
        name=f"aspect ratio {ratio}",
        series="aspect ratio",
        at=float(ratio),
        shapes=Rectangles((float(ratio), float(ratio)), 1),
        domain=square(40.0 * ratio**0.5 if ratio < 20 else 4.0 * ratio),
        least_fraction=least,
        reason=LONG if ratio > 1 else "",
    )
    for ratio, least in LEAST_FRACTIONS.items()
]
EDGES = [
    Case(
        name=f"{n} edges",
        series="edges, from 40 on" if n >= 40 else "",
        at=float(n),
        shapes=RegularPolygon(n) if n <= 8 else many_edges(n),
        domain=square(40.0 if n <= 200 else 20.0),
        seeds=SEEDS if n <= 200 else 2,
        most_growth=MOST_GROWTH if n <= 200 else n / 10.0,
        reason=MANY_EDGES if n > 200 else "",
    )
    for n in (3, 4, 5, 8, 40, 200, 500, 2000)
]
PARALLEL = [
    Case(name="edges parallel", shapes=tilted(0.0)),
    Case(name="edges parallel to 1e-9", shapes=tilted(1e-9), like="edges parallel"),
    Case(name="edges parallel to 1e-14", shapes=tilted(1e-14), like="edges parallel"),
    Case(name="vertices in line to 1e-6", shapes=bulging(1e-6), like="edges parallel"),
    Case(name="vertices in line to 1e-8", shapes=bulging(1e-8), like="edges parallel"),
    Case(name="vertices in line to 1e-12", shapes=bulging(1e-12), like="edges parallel"),
]
SLIVERS = [
    Case(
        name=f"slivers 1:{ratio}",
        shapes=sliver(float(ratio)),
        domain=square(4.0 * ratio),
        least_fraction=0.1 / ratio,
        reason=STEERED,
    )
    for ratio in (30, 300)
]
CASES = [*ASPECT_RATIOS, *EDGES, *PARALLEL, *SLIVERS]
