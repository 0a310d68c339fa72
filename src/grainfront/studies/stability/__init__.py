"""Extreme cases against a moderate one, and the growth of rounding errors.

Each case says what is expected of it (`case`); `matrix` runs them all, `expectations` judges, and
`error_growth` holds the clearance against rounding.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from grainfront.errors import InputError
from grainfront.studies.stability.case import Case
from grainfront.studies.stability.cases import CASES
from grainfront.studies.stability.error_growth import EDGES, OFFSETS, RATIOS, measure_error_growth
from grainfront.studies.stability.expectations import unmet
from grainfront.studies.stability.matrix import exponents, measure
from grainfront.studies.stability.record import quantities


def measure_stability(
    cases: Mapping[str, Case] = CASES,
    ratios: Sequence[float] = RATIOS,
    offsets: Sequence[float] = OFFSETS,
    edges: Sequence[int] = EDGES,
) -> dict[str, np.ndarray]:
    """Run all cases and measure the growth of errors: the arrays of `files.stability`.

    Raises InputError that names every case that is not as expected, with what was found.
    """
    rows = list(measure(cases))
    if failures := unmet(rows):
        raise InputError(
            f"stability: {len(failures)} expectations are not met: {'; '.join(failures)}"
        )
    return quantities(rows, exponents(rows), measure_error_growth(ratios, offsets, edges))
