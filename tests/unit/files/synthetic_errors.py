"""Records of errors against run time, made up from the contract: every quantity of every axis."""

from __future__ import annotations

import numpy as np

from grainfront.files.error_vs_time import ERROR_VS_TIME

METHODS = ["independent", "stratified", "deficit-controlled", "packing"]
N_POINTS = 4
N_FITS = 2


def records(rng, n_seeds, n_repeats):
    """Axis, quantity, array: N_POINTS points of each axis, numbers between 0.01 and 1."""
    sizes = {"seed": n_seeds, "repeat": n_repeats, "domain_fit": N_FITS}
    found: dict[str, dict[str, np.ndarray]] = {}
    for name, variable in ERROR_VS_TIME.variables.items():
        axis, _, quantity = name.partition("_")
        if quantity:
            shape = tuple(sizes.get(d, N_POINTS) for d in variable.dimensions)
            found.setdefault(axis, {})[quantity] = _values(rng, variable.type, shape)
    return found


def _values(rng, type, shape):
    if type == "string":
        return np.array(METHODS[: shape[0]], dtype=object)
    if type == "int64":
        return rng.integers(1, 9, shape)
    return rng.uniform(0.01, 1.0, shape)
