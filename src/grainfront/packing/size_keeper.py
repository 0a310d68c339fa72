"""Keeping the size law of the whole while regions take its finer and its coarser part.

Where the law is parted depends on how many particles end up in each part, which nobody knows
beforehand. So the sizes that are still to be drawn are shared out again now and then: of what the
law still lacks, the finer regions get the finer part, as large as their share of the particles yet
to come, and the other regions the rest.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from grainfront.packing.state import Front, Placed, Queues, Supply

# Bins of equal probability in which the sizes drawn are counted: fine beside the 24 bins of E2, so
# that the place where the law is parted is known well.
N_BIN = 480
# The guess that all parts are filled alike, which was right within 1 %, counts as much as so many
# particles seen: with few below it, the front is too rough to tell how many there are for an area.
PARTICLES_GUESSED = 5000


# The part of laws with sizes of their own, which are left alone.
NO_PART = -1


class Columns(NamedTuple):
    """How the area of the coarser and of the finer regions is spread over upright columns."""

    x: np.ndarray  # (n,) middle of each column
    height: np.ndarray  # (k,) ascending, equally spaced
    area_below: np.ndarray  # (2, k, n) area of the part below each height in each column


class SizeKeeper:
    """Shares out the sizes yet to be drawn between the laws of coarser and of finer particles.

    `quantile` is that of the size law of the whole. `part` (n_laws,) is 1 for laws that take its
    finer part, 0 for its coarser part, or NO_PART; `level` (n,) is the probability of each particle
    of the supply within its part. `density` (2,) guesses the particles on each unit of area of the
    parts.
    """

    def __init__(
        self,
        quantile: Callable[[np.ndarray], np.ndarray],
        part: np.ndarray,
        level: np.ndarray,
        columns: Columns,
        density: np.ndarray,
    ) -> None:
        self.quantile, self.part, self.level = quantile, part, level
        self.columns, self.density = columns, density
        self.probability = np.zeros(level.size)

    def copy(self) -> SizeKeeper:
        """The same keeper, for a packing that is continued in another way."""
        other = SizeKeeper(self.quantile, self.part, self.level, self.columns, self.density)
        other.probability = self.probability.copy()
        return other

    def share_out(self, front: Front, placed: Placed, queues: Queues, supply: Supply) -> None:
        """Give the particles that are yet to be drawn the sizes that the law still lacks."""
        to_come = self._to_come(front, placed, queues)
        first = np.concatenate([[0], queues.last[:-1]])
        kept = self.part != NO_PART
        drawn = np.concatenate(
            [self.probability[a:b] for a, b in zip(first[kept], queues.drawn[kept], strict=True)]
        )
        wanted = (drawn.size + to_come.sum()) / N_BIN
        counts = np.histogram(drawn, N_BIN, (0.0, 1.0))[0]
        # what a bin has too much or too little by chance is made up for by its neighbours
        lacking = np.maximum.accumulate(np.concatenate([[0.0], np.cumsum(wanted - counts)]))
        # finer particles take the beginning of what is lacking, coarser ones the end
        parting = lacking[-1] * to_come[1] / to_come.sum()
        bounds = ((parting, lacking[-1]), (0.0, parting))
        kept_laws = zip(self.part[kept], queues.drawn[kept], queues.last[kept], strict=True)
        for part, start, end in kept_laws:
            low, high = bounds[part]
            mass = low + self.level[start:end] * (high - low)
            self.probability[start:end] = np.interp(mass, lacking, np.linspace(0.0, 1.0, N_BIN + 1))
            supply.size[start:end] = self.quantile(self.probability[start:end])

    def _to_come(self, front: Front, placed: Placed, queues: Queues) -> np.ndarray:
        """Particles of the coarser and the finer part that are likely to be placed yet.

        Those on the front, half below it and half above, count by halves.
        """
        back, ahead = front.member[: front.ends[0]], front.member[front.ends[1] :]
        members = np.concatenate([back, ahead])
        members = members[members >= 0]
        law = np.searchsorted(queues.last, placed.source[members], side="right")
        on_front = np.array([np.sum(self.part[law] == part) for part in (0, 1)])
        so_far = np.array([queues.n_placed[self.part == part].sum() for part in (0, 1)])
        so_far = so_far - 0.5 * on_front
        below = self._area_below(placed.disc[members])
        left = self.columns.area_below[:, -1].sum(axis=1) - below
        guessed = self.density * below
        of_all = max(so_far.sum(), 1.0) / max(guessed.sum(), 1.0)
        of_part = (so_far + PARTICLES_GUESSED) / (of_all * guessed + PARTICLES_GUESSED)
        # never nothing: the last particles need a size too
        return np.maximum(self.density * of_all * of_part * left - 0.5 * on_front, 1.0)

    def _area_below(self, disc: np.ndarray) -> np.ndarray:
        """Area of the coarser and the finer regions below the line of centres of the front."""
        x, height, area = self.columns
        if not len(disc):
            return np.zeros(2)
        level = np.interp(x, *disc[np.argsort(disc[:, 0], kind="stable"), :2].T)
        row = (level - height[0]) / (height[1] - height[0])
        return area[
            :, np.clip(np.rint(row).astype(int), 0, height.size - 1), np.arange(x.size)
        ].sum(axis=1)
