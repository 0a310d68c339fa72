"""Clearance against rounding, over offset, size ratio and number of edges.

Packings are made with ever smaller clearances; the largest with which particles overlap or cross a
wall is the rounding error that the clearance must stay above.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from grainfront import api
from grainfront.laws import Constant, Law, Lognormal
from grainfront.packing.pack import fill
from grainfront.packing.state import CLEARANCE_ULPS, TOLERANCE_OF_CLEARANCE
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.studies.stability.case import MODERATE, PLAIN, square
from grainfront.studies.stability.outlines import many_edges
from grainfront.studies.stability.rounding import departure, ulp

RATIOS = (1.0, 10.0, 100.0, 1000.0)
OFFSETS = (0.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7)
EDGES = (4, 8, 40, 200, 500, 2000)
SEEDS = (1, 2)
# Side of the domain for shapes of so many edges.
SIDE_OF_EDGES = 20.0
# Sides of the domains, in largest grains: 500 particles of equal size, some thousand else.
SIDE = 25.0
# Clearances tried, in ulps, largest first.
TRIED_ULPS = tuple(2.0**power for power in range(5, -8, -1))


@dataclass(frozen=True)
class ErrorGrowth:
    """Arrays of shape (n_ratios, n_offsets), and others of `ratio`, `offset` and `edges` alone.

    Offsets of the domain from the origin are in mean sizes. `farthest`, the farthest coordinate of
    the domain, and `clearance` are in sizes of the smallest grain; `rounding` is the largest
    clearance tried that was too small, and `departure` the largest departure from the exact
    transformation of a shape, both in ulps of the farthest coordinate. `edges_rounding`, of the
    shape of `edges`, is the rounding of equal ellipses of so many edges, near the origin.
    """

    ratio: np.ndarray
    offset: np.ndarray
    farthest: np.ndarray
    clearance: np.ndarray
    rounding: np.ndarray
    departure: np.ndarray
    edges: np.ndarray
    edges_rounding: np.ndarray


def measure_error_growth(
    ratios: Sequence[float] = RATIOS,
    offsets: Sequence[float] = OFFSETS,
    edges: Sequence[int] = EDGES,
) -> ErrorGrowth:
    """Pack at all pairs of size ratio and offset, and shapes of all numbers of edges."""
    shape = len(ratios), len(offsets)
    farthest, clearance, rounding, departures = np.zeros((4, *shape))
    database = MODERATE.database()
    for at in np.ndindex(shape):
        size = _sizes(ratios[at[0]])
        start = offsets[at[1]] * size.moment(1)
        domain = square(SIDE * size.support[1], start, start)
        scene = replace(MODERATE.scene(PLAIN), size=size, domain=domain)
        unit = ulp(domain)
        farthest[at] = domain.x_max / size.support[0]
        clearance[at] = CLEARANCE_ULPS * unit / size.support[0]
        rounding[at] = _rounding(scene, database)
        departures[at] = max(
            departure(api.pack(scene, database, seed)[0], database) for seed in SEEDS
        )
    return ErrorGrowth(
        np.array(ratios),
        np.array(offsets),
        farthest,
        clearance,
        rounding,
        departures,
        np.array(edges, dtype=np.int64),
        np.array([_rounding_of_edges(n) for n in edges]),
    )


def _rounding_of_edges(n: int) -> float:
    case = replace(MODERATE, shapes=many_edges(n), domain=square(SIDE_OF_EDGES), size=Constant(1.0))
    return _rounding(case.scene(PLAIN), case.database())


def _rounding(scene: Scene, database: ShapeDatabase) -> float:
    """The largest clearance tried, in ulps, of which the certificate fails; 0 if none."""
    return next((ulps for ulps in TRIED_ULPS if not _holds(scene, database, ulps)), 0.0)


def _sizes(ratio: float) -> Law:
    """Sizes from 1 to `ratio`, about as many in each octave."""
    if ratio == 1.0:
        return Constant(1.0)
    return Lognormal(
        median=ratio**0.5, log_standard_deviation=10.0 * np.log(ratio), minimum=1.0, maximum=ratio
    )


def _holds(scene: Scene, database: ShapeDatabase, ulps: float) -> bool:
    """Whether the certificate holds of packings whose clearance is so many ulps."""
    clearance = ulps * ulp(scene.domain)
    for seed in SEEDS:
        state = api.empty_packing(scene, database, seed)
        walls = state.domain._replace(
            clearance=clearance, tolerance=TOLERANCE_OF_CLEARANCE * clearance
        )
        packing, _ = fill(state._replace(domain=walls), database.descriptors["aspect_ratio"])
        if not api.certify(packing).holds:
            return False
    return True
