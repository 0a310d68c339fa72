"""A record of a stability matrix made by hand."""

from __future__ import annotations

import numpy as np

from grainfront.files.stability import COUNTS, GROWTHS, NUMBERS

CASES = ("moderate", "moderate", "2000 edges", "far away")
EFFORTS = ((1, 1), (24, 20), (24, 20), (1, 1))


def quantities() -> dict[str, np.ndarray]:
    """Three runs, and one that was refused."""
    n_runs, shape = len(CASES), (2, 3)
    numbers = {name: np.array([1.0, 1.0, 1.2, np.nan]) for name in NUMBERS}
    numbers |= {
        "volume_fraction": np.array([0.7, 0.8, 0.9, np.nan]),
        "volume_fraction_sd": np.array([0.01, 0.02, 0.03, np.nan]),
        "mirrored_difference": np.array([-0.01, 0.01, 0.0, np.nan]),
        "mirrored_noise": np.array([0.02, 0.03, 0.03, np.nan]),
        "size_noise_level": np.array([1.5, 1.5, 0.0, np.nan]),
        "growth": np.array([1.0, 1.0, 45.0, np.nan]),
        "most_growth": np.array([10.0, 10.0, 200.0, 10.0]),
    }
    gaps = np.outer(np.arange(1.0, n_runs + 1.0), np.geomspace(0.8, 4.0, 7))
    gaps[-1] = np.nan
    return {
        **{name: np.arange(n_runs) for name in COUNTS},
        **numbers,
        "n_angle": np.array([n for n, _ in EFFORTS]),
        "n_loc": np.array([n for _, n in EFFORTS]),
        "case": np.array(CASES, dtype=object),
        "group": np.array(["moderate", "moderate", "shapes", "domains"], dtype=object),
        "expected_refusal": np.array(["", "", "", "must stay"], dtype=object),
        "refusal": np.array(["", "", "", "it must stay within 3e7"], dtype=object),
        "reason": np.array(["", "", "there are many", ""], dtype=object),
        "gap_quantile": np.array([0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0]),
        "gaps": gaps,
        "series": np.array(["edges"], dtype=object),
        "series_n_angle": np.array([1]),
        "series_n_loc": np.array([1]),
        "exponent": np.array([0.9]),
        "size_ratio": np.array([1.0, 1000.0]),
        "offset": np.array([0.0, 1e3, 1e6]),
        **{name: np.full(shape, 0.5) for name in GROWTHS},
        "clearance": np.geomspace(1e-13, 1e-6, 6).reshape(shape),
        "edges": np.array([4, 100]),
        "edges_rounding": np.array([1.0, 4.0]),
        "clearance_ulps": np.array(64.0),
    }
