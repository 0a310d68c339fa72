"""Wall effect and cost against the size of the domain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from grainfront.particles import Packing, Rectangle
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import volume_fraction, volume_fraction_bulk
from grainfront.studies.error_vs_time.record import AxisRecord, over_points, pareto_front
from grainfront.studies.error_vs_time.runs import Point, run, scaled_domain, with_effort

# Particles of the smallest domain, and of the largest for the plain advancing front and for more
# effort; four domains to a factor of 100.
FEWEST = 1_000
MOST_PLAIN = 1_000_000
MOST = 100_000
STEP = 10**0.5
# A volume fraction with which to guess the domain that so many particles fill.
FRACTION = 0.8


def measure_domain(
    scene: Scene,
    database: ShapeDatabase,
    seeds: Sequence[int],
    repeats: int,
    fewest: int = FEWEST,
    most: int = MOST,
    most_plain: int = MOST_PLAIN,
) -> AxisRecord:
    """Pack square-root-scaled copies of the domain, plainly and at the scene's own effort.

    They are for about `fewest` particles up to `most`, or `most_plain` for the plain advancing
    front. Regions, which have their place in the scene's own domain, are left out. The error is the
    wall effect: volume fraction of the bulk less that of the whole, of the hulls. Cost grows as N
    to the power `exponent`, fitted by least squares of the logarithms.
    """
    own = (scene.packing.n_angle, scene.packing.n_loc)
    efforts = sorted({(1, 1), own})
    points, effort_of = [], []
    for effort in efforts:
        largest = most_plain if effort == (1, 1) else most
        for domain in _domains(scene, database, fewest, largest):
            sized = replace(with_effort(scene, *effort), domain=domain, arrangement=None)
            points.append(Point(sized, database))
            effort_of.append(effort)
    found = run(points, seeds, repeats, _observe)
    fraction, bulk = found.numbers["volume_fraction"], found.numbers["volume_fraction_bulk"]
    wall_effect = bulk - fraction
    n_angle, n_loc = np.array(effort_of, dtype=np.int64).T
    groups = [np.array([one == effort for one in effort_of]) for effort in efforts]
    pareto = np.zeros(len(points), dtype=np.int64)
    for group in groups:
        pareto[group] = pareto_front(found.kernel_s[group], wall_effect[group])
    fits = [_power_law(found.numbers["particles"][g], found.kernel_s[g]) for g in groups]
    return AxisRecord(
        settings={
            "n_angle": n_angle,
            "n_loc": n_loc,
            "width": np.array([point.scene.domain.width for point in points]),
            "height": np.array([point.scene.domain.height for point in points]),
        },
        results=found.numbers | {"wall_effect": wall_effect},
        seconds={"kernel_s": found.kernel_s},
        pareto=pareto,
        fits={
            "fit_n_angle": np.array([effort[0] for effort in efforts], dtype=np.int64),
            "fit_n_loc": np.array([effort[1] for effort in efforts], dtype=np.int64),
            "exponent": np.array([exponent for exponent, _ in fits]),
            "coefficient": np.array([coefficient for _, coefficient in fits]),
        },
    )


def _domains(scene: Scene, database: ShapeDatabase, fewest: int, most: int) -> list[Rectangle]:
    """Domains of the scene's proportions for `fewest` to `most` particles."""
    mean_area = float(database.descriptors["hull_area"].mean()) * scene.size.moment(2)
    own = FRACTION * scene.domain.area / mean_area
    steps = round(np.log(most / fewest) / np.log(STEP))
    numbers = np.geomspace(fewest, most, steps + 1)
    return [scaled_domain(scene.domain, float(np.sqrt(n / own))) for n in numbers]


def _power_law(particles: np.ndarray, seconds: np.ndarray) -> tuple[float, float]:
    """Exponent and coefficient (seconds at one particle) of seconds over particles."""
    exponent, offset = np.polyfit(np.log(over_points(particles)), np.log(over_points(seconds)), 1)
    return float(exponent), float(np.exp(offset))


def _observe(_: Point, packing: Packing) -> dict[str, float]:
    return {
        "particles": packing.x.size,
        "volume_fraction": volume_fraction(packing),
        "volume_fraction_bulk": volume_fraction_bulk(packing),
    }
