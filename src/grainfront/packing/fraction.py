"""Reaching a prescribed volume fraction: one packing, steered, with its top tried until it fits.

Below the front the controller keeps the volume fraction within a few particle areas of its aim.
What the top row adds is luck: how the last particles fit under the top. So the packing is made up
to some rows below the top, once, and from there finished again and again, each time with other
random numbers and an aim that makes up for what earlier finishes lacked, until the volume fraction
of the whole is the prescribed one. Where no finish can make up for the top, the packing is made
anew with what has been learned.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from grainfront.jit import compiling
from grainfront.packing.control import exponents, make_control
from grainfront.packing.fronts import advance_to
from grainfront.packing.pack import RunTime
from grainfront.packing.prepare import as_packing
from grainfront.packing.steering import MOST_LEAN, Finish, Steering
from grainfront.packing.under_way import State
from grainfront.particles import Packing

# Effort to start with where nothing is known: half way. The controller finds another within some
# hundred particles.
HALF_WAY = 0.5
# Packings started anew, and finishes of each, after which the target counts as missed. A domain of
# 1,000 long grains may need as many; with 4,000 and more, two starts are rare.
MOST_STARTS, MOST_FINISHES = 8, 8
# With the effort at its end and the fraction farther than this many tolerances away, the target is
# out of reach; nearer, so many starts in all may have more luck.
OUT_OF_LUCK, STARTS_AT_END = 5.0, 3
# Finishes in a row with effort or aim at their ends after which no other will do better; an effort
# that near to 0 or 1 is at its end.
ENOUGH_AT_END, AT_END = 3, 0.02


@dataclass(frozen=True)
class Attempts:
    """How a target was approached, finish by finish, and whether it was reached."""

    finishes: tuple[Finish, ...]
    reached: bool

    @property
    def packings(self) -> float:
        """Whole packings that would have taken as many placements."""
        shared = {finish.start: finish.shared_particles for finish in self.finishes}
        finished = (finish.particles - finish.shared_particles for finish in self.finishes)
        return (sum(shared.values()) + sum(finished)) / self.finishes[-1].particles


def pack_to_fraction(
    empty: State,
    aspect_ratio: np.ndarray,
    particle_area: np.ndarray,
    target: float,
    tolerance: float,
    *,
    effort: float = HALF_WAY,
    rng: np.random.Generator,
    progress: Callable[[int, float], None] | None = None,
) -> tuple[Packing, RunTime, Attempts]:
    """Fill an empty packing so that particles take up `target` of the domain, within `tolerance`.

    `particle_area`, (n_shapes,), is that of a particle of size 1 as the volume fraction counts it:
    of its hull, or of the outline that will replace it. `effort`, from 0 (the plain advancing front
    method) to 1 (n_angle and n_loc of `empty`), is a guess to start with. The packing closest to
    the target is returned; `Attempts.reached` tells whether it is close enough. This is ours: Du et
    al. (2023), section 4.3.4, choose n_angle and n_loc from a map.
    """
    arranged = "" if empty.arrangement is None else "arranged "
    with compiling(f"{arranged}controlled search") as compilation:
        make_ready(empty, particle_area)
    steering = Steering(empty, particle_area, rng)
    # what the top lacks differs from start to start: the next expects the mean of those before
    lacked = [steering.first_missing(target)]
    finishes: list[Finish] = []
    best, closest = empty, math.inf
    for number in range(MOST_STARTS):
        missing = float(np.mean(lacked))
        start = steering.start(number, target + missing, effort, progress)
        seen: list[float] = []
        for _ in range(MOST_FINISHES):
            aim = start.aim_for((target + missing) * empty.domain_area)
            state, finish = steering.finish(start, aim)
            finishes.append(finish)
            seen.append(start.expected(aim) / empty.domain_area - finish.volume_fraction)
            missing = float(np.mean(seen))
            if abs(finish.volume_fraction - target) < closest:
                best, closest = state, abs(finish.volume_fraction - target)
            if closest <= tolerance or _stuck(finishes, number, target):
                break
        effort = start.settled
        lacked.append(missing)
        hopeless = closest > OUT_OF_LUCK * tolerance or number + 1 >= STARTS_AT_END
        if closest <= tolerance or (hopeless and _spent(effort, finish.volume_fraction < target)):
            break
    attempts = Attempts(tuple(finishes), closest <= tolerance)
    return as_packing(best, aspect_ratio), RunTime(steering.seconds, compilation.seconds), attempts


def make_ready(empty: State, particle_area: np.ndarray) -> None:
    """Compile the kernel, or read it from the cache."""
    nothing = np.random.default_rng(0)
    control = make_control(0.5, 0.0, particle_area, empty.supply, nothing)
    advance_to(empty.copy().steered(control, nothing), 0)


def _spent(effort: float, denser: bool) -> bool:
    """Whether the effort is at the end beyond which it would become denser, or looser."""
    return effort >= 1.0 - AT_END if denser else effort <= AT_END


def _stuck(finishes: Sequence[Finish], start: int, target: float) -> bool:
    """Whether the last finishes of a start could not come closer."""
    last = [finish for finish in finishes if finish.start == start][-ENOUGH_AT_END:]
    return len(last) == ENOUGH_AT_END and all(_at_end(f, f.volume_fraction < target) for f in last)


def _at_end(finish: Finish, denser: bool) -> bool:
    """Whether a finish could not have been aimed denser, or looser, or could not follow."""
    lean = finish.lean if denser else -finish.lean
    return _spent(finish.effort, denser) or lean >= MOST_LEAN * (1.0 - AT_END)


def effort_from_map(
    n_angle: np.ndarray,
    n_loc: np.ndarray,
    volume_fraction: np.ndarray,
    most_n_angle: int,
    most_n_loc: int,
    target: float,
) -> float:
    """The effort that leads to a target, from a map of volume fractions over n_angle and n_loc.

    `volume_fraction` has the shape (n_angle.size, n_loc.size), both ascending; it is interpolated
    over the logarithms.
    """
    effort = np.linspace(0.0, 1.0, 101)
    along = []
    for of_angle, of_loc in map(exponents, effort):
        at_n_loc = [
            np.interp(of_loc * np.log(most_n_loc), np.log(n_loc), row) for row in volume_fraction
        ]
        along.append(np.interp(of_angle * np.log(most_n_angle), np.log(n_angle), at_n_loc))
    if np.ptp(along) == 0.0:
        return HALF_WAY  # a map of one point tells nothing
    # a map has noise: the first effort from which on the target is reached
    return float(effort[np.argmax(np.maximum.accumulate(along) >= min(target, np.max(along)))])
