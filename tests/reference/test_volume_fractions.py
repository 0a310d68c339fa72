"""Volume fractions that the method is known for.

AFM: those of a trial implementation and of 8203 squares packed by Du et al. (2023), S ~ U(0.5, 2);
OAFM: the paper reports 0.831 as its highest, the trial 0.842 for λ = 1.5. The seeds' standard
deviations are 0.001 to 0.006.
"""

import numpy as np
import pytest

from grainfront.packing.orientations import orientation_law
from grainfront.packing.pack import fill
from grainfront.packing.prepare import prepare
from grainfront.particles import Rectangle
from grainfront.polygons import Polygons


def volume_fraction(aspect_ratio, n_angle, n_loc, seed):
    nodes = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [aspect_ratio / 2, 0.5]
    rng = np.random.default_rng(seed)
    n = int(1.2 * 200**2 / (aspect_ratio * 1.75)) + 50
    empty = prepare(
        Polygons.of([nodes]), np.zeros(n, dtype=np.int64), rng.uniform(0.5, 2.0, n),
        [orientation_law(np.full(24, 1 / 24), np.linspace(0, 180, 6145))],
        Rectangle(0.0, 0.0, 200.0, 200.0), n_angle, n_loc, rng,
    )  # fmt: skip
    packing, _ = fill(empty, np.full(1, aspect_ratio))
    return packing.area.sum() / 200.0**2


@pytest.mark.parametrize(
    ("aspect_ratio", "expected", "tolerance"),
    [
        (1.0, 0.716, 0.003),
        (1.5, 0.700, 0.003),
        (2.0, 0.673, 0.004),
        (3.0, 0.610, 0.006),
        (4.0, 0.553, 0.008),
        (6.0, 0.459, 0.012),
        (8.0, 0.392, 0.015),
        (10.0, 0.339, 0.015),
    ],
)
def test_afm_of_rectangles(aspect_ratio, expected, tolerance):
    fractions = [volume_fraction(aspect_ratio, 1, 1, seed) for seed in range(3)]
    assert np.mean(fractions) == pytest.approx(expected, abs=tolerance)


def test_oafm_of_rectangles_reaches_what_it_is_known_for():
    assert volume_fraction(1.5, 24, 20, 0) >= 0.842
