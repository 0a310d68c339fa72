"""The least effort that reaches a volume fraction, estimated from short pilot packings.

Volume fraction and time depend smoothly on n_angle and n_loc (Du et al. 2023, Figs. 16 and 18): a
map of them over few pairs tells which pair to try, and larger pilots measure that pair.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from grainfront.errors import InputError
from grainfront.packing import PRUNED_FROM_N_LOC, search_of
from grainfront.particles import Cell, Rectangle, Region
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase
from grainfront.studies.pilots import Pilot, PilotScale, pack_pilot, seconds_in

# Pairs up to these are considered, or up to the scene's own where that is larger: twice the
# defaults, beyond which the time rises far and the volume fraction hardly.
MOST_ANGLE, MOST_LOC = 48, 40
# Pairs of the map: so many n_angle, and so many n_loc for each of the two searches; the fits need
# no more.
ANGLE_LEVELS, LOC_LEVELS = 5, 3
# Degrees of the fits over the logarithms of n_angle and n_loc. On 168 pairs of rectangles and
# gravel hulls they left 0.002 to 0.003 of the volume fraction and 4 to 6 % of the time.
FRACTION_DEGREE, TIME_DEGREE = 3, 2

# Sides of pilots in square roots of the mean hull area. The width is room for the longest local
# front, 2 n_loc grains; two heights at each pair checked tell the time at the top apart.
WIDTH = 80.0
MAP_HEIGHT = 16.0
CHECK_HEIGHTS = (16.0, 16.0, 48.0, 48.0)
# Pairs measured at most before the cheapest of them is taken.
MOST_CHECKS = 5
# The spread covers so many standard deviations: 19 of 20 packings.
SPREAD_DEVIATIONS = 2.0


@dataclass(frozen=True)
class Recommendation:
    """The cheapest pair that reaches `target`, and what to expect of the whole scene.

    `volume_fraction` ± `spread` (two standard deviations) is of the outlines where the scene
    replaces hulls; `kernel_s` are seconds of one core, on this machine now. `pilots` were packed
    in `pilot_s` seconds, after `compile_s` seconds of compiling or reading the cache.
    """

    target: float
    n_angle: int
    n_loc: int
    volume_fraction: float
    spread: float
    particles: int
    kernel_s: float
    pilots: int
    pilot_s: float
    compile_s: float


class Checked(NamedTuple):
    """What the pilots of one pair promise for the scene."""

    volume_fraction: float
    standard_error: float
    particles: int
    kernel_s: float

    def reaches(self, target: float) -> bool:
        """Whether the target is reached as far as the pilots can tell."""
        return self.volume_fraction + self.standard_error >= target


def recommend(
    scene: Scene,
    database: ShapeDatabase,
    target: float,
    progress: Callable[[int], None] | None = None,
) -> Recommendation:
    """The cheapest n_angle and n_loc that reach a volume fraction, from pilot packings.

    Pairs up to MOST_ANGLE and MOST_LOC, or the scene's own where larger, are considered. A pair
    reaches the target where its pilots do within their standard error. The same scene gives the
    same volume fractions; times, and so the choice among pairs of nearly equal cost, vary.
    `progress` is told the particles of each pilot. Raises InputError where the target is out of
    reach, and where the domain is too small for the grains.
    """
    if isinstance(scene.domain, Cell | Region):
        raise InputError(
            f"{scene.name}: its domain is no plain rectangle, but pilot packings tell the effort "
            "in plain rectangles only"
        )
    return _Study(scene, database, progress).recommend(target)


class _Study:
    """The pilots of one scene, and what they say."""

    def __init__(
        self, scene: Scene, database: ShapeDatabase, progress: Callable[[int], None] | None
    ) -> None:
        self.progress = progress
        self.most = (max(MOST_ANGLE, scene.packing.n_angle), max(MOST_LOC, scene.packing.n_loc))
        self.scale = PilotScale(scene, database, max(WIDTH, 2.0 * self.most[1]))
        self.pilots: list[Pilot] = []
        self.checks: dict[tuple[int, int], Checked] = {}
        for seed, pair in enumerate(self._map_pairs()):
            self._pack(pair, MAP_HEIGHT, seed)
        self.first_check_seed = len(self.pilots)
        self.surface = Surface(self.pilots, *self.most)

    def recommend(self, target: float) -> Recommendation:
        """The cheapest pair that reaches the target: the map tells which to check, then they do."""
        pair = self._cheapest(target)
        while pair not in self.checks and len(self.checks) < MOST_CHECKS:
            self._check(pair)
            pair = self._cheapest(target)
        if pair not in self.checks:
            pair = self._best_checked(target)
        self._require_reached(pair, target)
        found = self.checks[pair]
        return Recommendation(
            target,
            *pair,
            found.volume_fraction,
            self._spread(found),
            found.particles,
            found.kernel_s,
            len(self.pilots),
            sum(pilot.kernel_s for pilot in self.pilots),
            sum(pilot.compile_s for pilot in self.pilots),
        )

    def _map_pairs(self) -> list[tuple[int, int]]:
        exhaustive = _levels(1, PRUNED_FROM_N_LOC - 1, LOC_LEVELS)
        pruned = _levels(PRUNED_FROM_N_LOC, self.most[1], LOC_LEVELS)
        angles = _levels(1, self.most[0], ANGLE_LEVELS)
        return [(angle, loc) for angle in angles for loc in (*exhaustive, *pruned)]

    def _pack(self, pair: tuple[int, int], height: float, seed: int) -> Pilot:
        pilot = pack_pilot(self.scale, *pair, height, seed)
        self.pilots.append(pilot)
        if self.progress is not None:
            self.progress(pilot.particles)
        return pilot

    def _cheapest(self, target: float) -> tuple[int, int]:
        """The cheapest pair expected to reach the target; the largest where none is."""
        reaches = self.surface.volume_fraction + self._nearest_offset() >= target
        for (n_angle, n_loc), found in self.checks.items():
            reaches[n_angle - 1, n_loc - 1] = found.reaches(target)
        if not reaches.any():
            return self.most
        cost = np.where(reaches, self.surface.seconds, np.inf)
        row, column = np.unravel_index(np.argmin(cost), cost.shape)
        return int(row) + 1, int(column) + 1

    def _nearest_offset(self) -> np.ndarray:
        """How far the nearest pair checked (in logarithms) lies above the fit, for each pair."""
        fitted = self.surface.volume_fraction
        log_angle, log_loc = (np.log(np.arange(1, n + 1)) for n in fitted.shape)
        offset, nearest = np.zeros_like(fitted), np.full_like(fitted, np.inf)
        for (n_angle, n_loc), found in self.checks.items():
            distance = np.hypot(
                log_angle[:, None] - np.log(n_angle), log_loc[None, :] - np.log(n_loc)
            )
            above = found.volume_fraction - fitted[n_angle - 1, n_loc - 1]
            offset = np.where(distance < nearest, above, offset)
            nearest = np.minimum(distance, nearest)
        return offset

    def _best_checked(self, target: float) -> tuple[int, int]:
        """Of the pairs checked the cheapest that reaches the target, or else the densest."""
        reaching = [pair for pair, found in self.checks.items() if found.reaches(target)]
        if reaching:
            return min(reaching, key=lambda pair: self.checks[pair].kernel_s)
        return max(self.checks, key=lambda pair: self.checks[pair].volume_fraction)

    def _check(self, pair: tuple[int, int]) -> Checked:
        """Measure a pair, once, by larger pilots, of the same seeds for all pairs."""
        if pair not in self.checks:
            pilots = [
                self._pack(pair, height, seed)
                for seed, height in enumerate(CHECK_HEIGHTS, start=self.first_check_seed)
            ]
            self.checks[pair] = _promise(self.scale.scene.domain, pilots, self.surface)
        return self.checks[pair]

    def _require_reached(self, pair: tuple[int, int], target: float) -> None:
        """Raise InputError, saying what can be reached, where the target cannot."""
        least, most = (1, 1), self.most
        found = self.checks[pair]
        too_low = pair == least and found.volume_fraction - self._spread(found) > target
        if too_low or (pair == most and not found.reaches(target)):
            low, high = (self._check(end).volume_fraction for end in (least, most))
            raise InputError(
                f"{self.scale.scene.name}: a volume fraction of {target:g} is out of reach: pilot "
                f"packings promise from {low:.3f} (n_angle and n_loc of 1) to {high:.3f} (n_angle "
                f"{most[0]}, n_loc {most[1]})"
            )

    def _spread(self, found: Checked) -> float:
        """Two standard deviations of one packing of the scene about the promise."""
        of_one_packing = self.surface.deviation_of_one / np.sqrt(found.particles)
        return float(SPREAD_DEVIATIONS * np.hypot(of_one_packing, found.standard_error))


def _promise(whole: Rectangle, pilots: list[Pilot], surface: Surface) -> Checked:
    """What pilots of one pair promise for the whole."""
    weights = [pilot.particles for pilot in pilots]
    fraction, share, mean_area = (
        float(np.average(values, weights=weights))
        for values in zip(
            *((p.volume_fraction, p.share_of_hulls, p.mean_hull_area) for p in pilots), strict=True
        )
    )
    return Checked(
        fraction,
        surface.deviation_of_one / float(np.sqrt(sum(weights))),
        round(fraction / share * whole.area / mean_area),
        seconds_in(whole, pilots),
    )


class Surface:
    """Volume fraction and seconds of the pilots of the map, fitted for every pair up to the most.

    Row n_angle − 1, column n_loc − 1. `deviation_of_one` is the standard deviation of the volume
    fraction times the square root of the particles: that of a mean falls as their root grows.
    """

    def __init__(self, pilots: list[Pilot], most_angle: int, most_loc: int) -> None:
        n_angle, n_loc = np.meshgrid(
            np.arange(1, most_angle + 1), np.arange(1, most_loc + 1), indexing="ij"
        )
        fraction = np.array([pilot.volume_fraction for pilot in pilots])
        root = np.sqrt([pilot.particles for pilot in pilots])
        at = np.array([pilot[:2] for pilot in pilots])
        fit = _fit(at, fraction, root, FRACTION_DEGREE)
        self.volume_fraction = fit(n_angle, n_loc)
        residual = root * (fraction - fit(*at.T))
        coefficients = _terms(at[:, 0], at[:, 1], FRACTION_DEGREE).shape[-1]
        self.deviation_of_one = float(np.sqrt(np.sum(residual**2) / (fraction.size - coefficients)))
        self.seconds = np.empty(n_angle.shape)
        seconds = np.log([pilot.kernel_s for pilot in pilots])
        searched = np.array([search_of(*pair) for pair in at])
        search = np.vectorize(search_of)(n_angle, n_loc)
        for one in np.unique(searched):
            here = searched == one
            fit = _fit(at[here], seconds[here], np.ones(int(here.sum())), TIME_DEGREE)
            where = search == one
            self.seconds[where] = np.exp(fit(n_angle[where], n_loc[where]))


def _levels(first: int, last: int, n: int) -> tuple[int, ...]:
    """Whole numbers from first to last, their logarithms about evenly spaced."""
    return tuple(int(level) for level in np.rint(np.geomspace(first, last, n)))


def _terms(n_angle: np.ndarray, n_loc: np.ndarray, degree: int) -> np.ndarray:
    """Monomials of the logarithms up to a total degree, along the last axis."""
    u, v = np.log(n_angle), np.log(n_loc)
    powers = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    return np.stack([u**i * v**j for i, j in powers], axis=-1)


def _fit(
    at: np.ndarray, values: np.ndarray, weights: np.ndarray, degree: int
) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """The weighted least-squares polynomial of the logarithms of n_angle and n_loc."""
    terms = _terms(at[:, 0], at[:, 1], degree)
    coefficients = np.linalg.lstsq(terms * weights[:, None], values * weights, rcond=None)[0]
    return lambda n_angle, n_loc: _terms(n_angle, n_loc, degree) @ coefficients
