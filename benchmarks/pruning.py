"""What the pruning of trials saves against exhaustive search, and that it changes nothing."""

from __future__ import annotations

import math
import time

import numpy as np
from scenes import scene_and_shapes
from table import Spread, Table

from grainfront.draw import draw_particles
from grainfront.packing.fronts import advance_to
from grainfront.packing.orientations import STEPS_A_BIN, orientation_law
from grainfront.packing.prepare import prepare
from grainfront.packing.turns import N_PLACED
from grainfront.packing.under_way import State
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase

SCENES = ("oafm_rectangles", "river_gravel")
EDGE, QUICK_EDGE = 60.0, 15.0
REPEATS = 3


def tables(quick: bool) -> list[Table]:
    """One table: a row a scene."""
    note = (
        f"The same grains in a square of edge {QUICK_EDGE if quick else EDGE:g}, packed by both "
        "in turn, n_angle = 24 and n_loc = 20; microseconds a grain and their ratio in one run, "
        "median (least–largest). Equal: each grain has the same place and orientation, bit for bit."
    )
    header = ("scene", "grains", "exhaustive (µs)", "pruned (µs)", "ratio", "equal")
    return [Table("Pruning", note, header, [_row(name, quick) for name in SCENES])]


def _row(name: str, quick: bool) -> tuple[str, ...]:
    scene, database = scene_and_shapes(name, QUICK_EDGE if quick else EDGE)
    for exhaustively in (True, False):
        advance_to(_prepared(scene, database, exhaustively), 0)  # compiles
    pairs = [
        tuple(_timed(_prepared(scene, database, exhaustively)) for exhaustively in (True, False))
        for _ in range(1 if quick else REPEATS)
    ]
    exhaustive, pruned = pairs[0][0][1], pairs[0][1][1]
    n = int(exhaustive.counters[N_PLACED])
    return (
        name,
        f"{n:,}",
        Spread.of(slow / n * 1e6 for (slow, _), _ in pairs).text(".0f"),
        Spread.of(fast / n * 1e6 for _, (fast, _) in pairs).text(".0f"),
        Spread.of(slow / fast for (slow, _), (fast, _) in pairs).text(".1f"),
        "yes" if _equal(exhaustive, pruned) else "**no**",
    )


def _prepared(scene: Scene, database: ShapeDatabase, exhaustively: bool) -> State:
    """The packing before its first particle; without its memory it searches exhaustively."""
    mean_area = scene.size.moment(2) * float(database.descriptors["hull_area"].mean())
    n = math.ceil(scene.domain.area / mean_area)  # more than find a place
    matched = scene.matched and (database.descriptors[scene.matched[0]], scene.matched[1])
    effort, law, rng = scene.packing, scene.orientation, np.random.default_rng(1)
    shape, size = draw_particles(database.count, scene.size, n, rng, matched)
    orientations = orientation_law(
        law.bins(effort.n_bin)[1], law.quantiles_within_support(effort.n_bin * STEPS_A_BIN)
    )
    state = prepare(
        database.hulls, shape, size, [orientations], scene.domain, effort.n_angle, effort.n_loc, rng
    )
    return state._replace(memory=None) if exhaustively else state


def _timed(state: State) -> tuple[float, State]:
    """Seconds until the domain is full, and the packing then."""
    start = time.perf_counter()
    advance_to(state, state.supply.size.size)
    return time.perf_counter() - start, state


def _equal(one: State, other: State) -> bool:
    n = int(one.counters[N_PLACED])
    return (
        n == int(other.counters[N_PLACED])
        and np.array_equal(one.placed.disc[:n], other.placed.disc[:n])
        and np.array_equal(one.placed.orientation[:n], other.placed.orientation[:n])
    )
