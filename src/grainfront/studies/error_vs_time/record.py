"""What one axis of a study of errors against run time finds."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

Arrays = dict[str, np.ndarray]


@dataclass(frozen=True)
class AxisRecord:
    """Points of one axis, the packings of each for several seeds, their times in several repeats.

    All arrays go by the name of their quantity. `settings` have the shape (n_points,); `results`,
    errors and what else repeats, (n_points,) or (n_points, n_seeds); `seconds`, of CPU time,
    (n_points, n_seeds, n_repeats). `pareto`, (n_points,), is 1 on the Pareto front and 0 elsewhere;
    it is None where the points are no choices. `fits` hold what was fitted to all points.
    """

    settings: Arrays
    results: Arrays
    seconds: Arrays
    pareto: np.ndarray | None = None
    fits: Arrays = field(default_factory=dict)

    @property
    def quantities(self) -> Arrays:
        """All arrays, by name."""
        front = {} if self.pareto is None else {"pareto": self.pareto}
        return self.settings | self.results | self.seconds | front | self.fits


def pareto_front(seconds: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Mark with 1 the points that no other beats in one of time and error and equals in the other.

    Arrays of shape (n_points, ...) are taken by their medians over all but the points; returns
    int64 of shape (n_points,).
    """
    time, error = over_points(seconds), over_points(error)
    no_worse = (time[:, None] <= time) & (error[:, None] <= error)
    better = (time[:, None] < time) | (error[:, None] < error)
    beaten = np.any(no_worse & better, axis=0)
    return np.where(beaten, np.int64(0), np.int64(1))


def over_points(values: np.ndarray) -> np.ndarray:
    """Medians over seeds and repeats, shape (n_points,)."""
    return np.array([np.median(of_point) for of_point in values])
