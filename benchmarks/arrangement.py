"""What an arrangement costs, and how well the laws are kept with it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scenes import SMALL, scene_and_shapes
from table import Spread, Table

from grainfront import api
from grainfront.arrangement.regions import Arrangement, LocalLaws, Region
from grainfront.arrangement.zones import Polygon
from grainfront.scene import Scene
from grainfront.statistics import PackingStatistics

SCENE = "river_gravel"
SEEDS = 5
SEGMENTS = 200
# A star that fills half of the domain: its boundary is long, and runs in all directions.
POINTS_OF_STAR = 10


def tables(quick: bool) -> list[Table]:
    """Two tables: the cost of regions alone, and the horse."""
    scene, database = scene_and_shapes(SCENE, SMALL if quick else None)
    plain = replace(scene, arrangement=None)
    same_laws = replace(scene, arrangement=_star(scene))
    seeds = range(1, 2 if quick else 1 + SEEDS)
    cost, kept = [], []
    seconds: dict[str, list[float]] = {"none": [], "star": [], "horse": []}
    arranged = {"none": plain, "star": same_laws} | ({} if quick else {"horse": scene})
    for one in arranged.values():
        api.pack(one, database, seed=1)  # compiles
    for seed in seeds:
        for name, one in arranged.items():
            packing, run_time = api.pack(one, database, seed)
            seconds[name].append(run_time.kernel_s)
            if name == "horse":
                kept.append(api.measure(one, database, packing))
    without = np.median(seconds["none"])
    for name in arranged:
        spread = Spread.of(seconds[name])
        cost.append((name, spread.text(), f"{np.median(seconds[name]) / without:.2f}"))
    note = (
        f"Kernel seconds of {packing.x.size:,} grains of {SCENE}, median (least–largest) of "
        f"{len(seeds)} seeds, and their ratio to those without arrangement. The star has "
        f"{SEGMENTS} segments and the scene's own laws inside and out, so that it costs what "
        "regions cost; the horse takes the finer grains."
    )
    found = [Table("Arrangement", note, ("arrangement", "seconds", "ratio"), cost)]
    if kept:
        found.append(_laws_kept(kept))
    return found


def _laws_kept(kept: list[PackingStatistics]) -> Table:
    """E2 of the size in the horse's scene."""
    rows = [
        (
            str(seed),
            f"{100 * one.distributions['size'].l2_error:.2f}",
            *(f"{100 * region['size'].l2_error:.2f}" for region in one.regions.distributions),
            f"{100 * one.regions.misplaced:.2f}",
        )
        for seed, one in enumerate(kept, start=1)
    ]
    note = (
        "The horse, `finer_than: auto`: E2 of the size in %, of the whole against the scene's law, "
        "inside and outside against the law parted where the finer grains placed leave off; share "
        "of misplaced grains in %."
    )
    return Table("Laws kept", note, ("seed", "whole", "inside", "outside", "misplaced"), rows)


def _star(scene: Scene) -> Arrangement:
    """A star of SEGMENTS segments in the middle of the domain, with the scene's own laws."""
    angle = 2.0 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    domain = scene.domain
    radius = domain.width * (0.38 + 0.08 * np.cos(POINTS_OF_STAR * angle))
    nodes = np.column_stack(
        [
            0.5 * (domain.x_min + domain.x_max) + radius * np.cos(angle),
            0.5 * (domain.y_min + domain.y_max) + radius * np.sin(angle),
        ]
    )
    own = LocalLaws(scene.size, scene.matched, scene.orientation)
    return Arrangement((Region(Polygon(tuple(map(tuple, nodes.tolist()))), (own,)),))
