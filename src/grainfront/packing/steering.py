"""A packing made up to some rows below its top, and finished from there to an aim of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from grainfront.errors import InputError
from grainfront.packing.control import (
    EFFORT_SUM,
    ENCLOSED,
    INTEGRAL,
    RISE,
    SOLID,
    Control,
    make_control,
)
from grainfront.packing.pack import run
from grainfront.packing.under_way import State

# Share of the domain that a finish fills: enough for the aim to make up for the top, and little
# enough for many finishes to cost less than another packing. At least some rows, as high as the
# mean particle is long.
FINISH_SHARE, FINISH_ROWS = 0.15, 4.0
# First guess of the solid missing along the top, in rows: 0.1 to 0.4 were seen for rectangles of
# λ = 1.5 and 4 and for gravel. Finishes tell better.
MISSING_ROWS = 0.25
# Finishes may aim this far beside the rest of the packing, which is to stay even.
MOST_LEAN = 0.02


@dataclass(frozen=True)
class Finish:
    """One finish of the packing started as number `start`; efforts are means, from 0 to 1.

    `lean` is how far it was aimed beside the rest of the packing.
    """

    start: int
    shared_particles: int
    shared_effort: float
    aim: float
    lean: float
    effort: float
    particles: int
    volume_fraction: float


@dataclass(frozen=True)
class Start:
    """A packing made up to where the finishes begin."""

    number: int
    state: State
    control: Control
    effort: float

    @property
    def settled(self) -> float:
        """The effort that the controller has settled on."""
        return float(self.control.tally[INTEGRAL])

    @property
    def left(self) -> float:
        """Area above the front."""
        return self.state.domain_area - float(self.control.tally[ENCLOSED])

    def expected(self, aim: float) -> float:
        """Solid of the whole if the rest of the domain were filled to the aim, up to its top."""
        return float(self.control.tally[SOLID]) + aim * self.left

    def aim_for(self, solid: float) -> float:
        """The aim that `expected` answers with this much solid, as far as it may lean."""
        aim = (solid - float(self.control.tally[SOLID])) / self.left
        return min(max(aim, self.control.aim - MOST_LEAN), self.control.aim + MOST_LEAN)


class Steering:
    """An empty packing to be filled to a volume fraction, with a count of the seconds spent."""

    def __init__(self, empty: State, particle_area: np.ndarray, rng: np.random.Generator) -> None:
        if empty.domain.obstacles is not None:
            raise InputError(
                "A target volume fraction is reached in rectangles only, but the domain is a "
                "polygon, where the volume fraction so far cannot be told from the front."
            )
        supply = empty.supply
        radii = supply.circumradius[supply.shape]
        self.empty, self.particle_area, self.rng = empty, particle_area, rng
        self.mean_area = float(np.mean(particle_area[supply.shape] * supply.size**2))
        self.row = 2.0 * float(np.mean(radii * supply.size)) / empty.domain_height
        self.seconds = 0.0

    def first_missing(self, target: float) -> float:
        """A guess of the solid missing along the top, as share of the domain."""
        return MISSING_ROWS * self.row * target

    def control(self, aim: float, effort: float) -> Control:
        """A controller with random numbers of its own."""
        return make_control(aim, effort, self.particle_area, self.empty.supply, self.rng)

    def particles(self, share: float, aim: float) -> int:
        """How many particles fill a share of the domain."""
        return int(share * aim * self.empty.domain_area / self.mean_area)

    def start(
        self,
        number: int,
        aim: float,
        effort: float,
        progress: Callable[[int, float], None] | None,
    ) -> Start:
        """Fill the domain up to where the finishes begin."""
        control = self.control(aim, effort)
        state = self.empty.copy().steered(control, self.rng)
        share = min(max(FINISH_SHARE, FINISH_ROWS * self.row), 1.0)
        self.seconds += run(state, self.particles(1.0 - share, aim), progress)
        return Start(number, state, control, _mean_effort(control, state.n_placed))

    def finish(self, start: Start, aim: float) -> tuple[State, Finish]:
        """Fill the rest of the domain."""
        lean = aim - start.control.aim
        control = self.control(aim, start.settled + lean / RISE)
        control.area[:] = start.control.area
        control.below[:] = start.control.below
        state = start.state.copy().steered(control, self.rng)
        self.seconds += run(state, state.supply.size.size)
        shared = start.state.n_placed
        return state, Finish(
            start=start.number,
            shared_particles=shared,
            shared_effort=start.effort,
            aim=aim,
            lean=lean,
            effort=_mean_effort(control, state.n_placed - shared),
            particles=state.n_placed,
            volume_fraction=float(control.area[: state.n_placed].sum()) / state.domain_area,
        )


def _mean_effort(control: Control, particles: int) -> float:
    return float(control.tally[EFFORT_SUM]) / max(particles, 1)
