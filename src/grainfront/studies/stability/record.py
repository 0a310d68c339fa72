"""Rows of the matrix and the growth of errors as the arrays of one record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from grainfront.packing.state import CLEARANCE_ULPS
from grainfront.studies.stability.case import Effort
from grainfront.studies.stability.error_growth import ErrorGrowth
from grainfront.studies.stability.matrix import Row
from grainfront.studies.stability.run import GAP_QUANTILES

SUMS = (
    "particles", "drawn", "left_over", "failed", "unaccounted", "overlaps", "across_wall",
    "pairs_exact", "scaled_differently",
)  # fmt: skip
MEANS = (
    "volume_fraction", "size_l2_error", "size_noise_level", "orientation_l2_error",
    "orientation_noise_level",
)  # fmt: skip
LARGEST = ("departure", "lost")
OF_ROW = (
    "relative_fraction", "mirrored_difference", "mirrored_noise", "microseconds", "growth",
    "attempts",
)  # fmt: skip


def quantities(
    rows: Sequence[Row], fits: Mapping[tuple[str, Effort], float], growth: ErrorGrowth
) -> dict[str, np.ndarray]:
    """All arrays of the record, by the names in `files.stability`."""
    texts = {
        "case": [row.case.name for row in rows],
        "group": [row.case.group for row in rows],
        "expected_refusal": [row.case.refused for row in rows],
        "refusal": [row.found.refusal for row in rows],
        "reason": [row.case.reason for row in rows],
        "series": [series for series, _ in fits],
    }
    counts = {
        "n_angle": [row.effort[0] for row in rows],
        "n_loc": [row.effort[1] for row in rows],
        "packings": [row.found.particles.size for row in rows],
        **{name: [int(np.sum(getattr(row.found, name))) for row in rows] for name in SUMS},
        "series_n_angle": [effort[0] for _, effort in fits],
        "series_n_loc": [effort[1] for _, effort in fits],
    }
    numbers = [_numbers(row) for row in rows]
    return {
        **{name: np.array(values, dtype=object) for name, values in texts.items()},
        **{name: np.array(values, dtype=np.int64) for name, values in counts.items()},
        **{name: np.array([one[name] for one in numbers]) for name in numbers[0]},
        "gap_quantile": np.array(GAP_QUANTILES),
        "gaps": np.array([_gaps(row.found.gaps) for row in rows]),
        "exponent": np.array(list(fits.values()), dtype=np.float64),
        "size_ratio": growth.ratio,
        "offset": growth.offset,
        "farthest": growth.farthest,
        "clearance": growth.clearance,
        "rounding": growth.rounding,
        "growth_departure": growth.departure,
        "edges": growth.edges,
        "edges_rounding": growth.edges_rounding,
        "clearance_ulps": np.array(CLEARANCE_ULPS),
    }


def _numbers(row: Row) -> dict[str, float]:
    """Numbers of a run; NaN where it was refused."""
    found = row.found
    limits = {"most_growth": row.case.most_growth}
    if found.refusal:
        return limits | dict.fromkeys((*MEANS, "volume_fraction_sd", *LARGEST, *OF_ROW), np.nan)
    return {
        **limits,
        **{name: float(np.mean(getattr(found, name))) for name in MEANS},
        "volume_fraction_sd": (
            float(np.std(found.volume_fraction, ddof=1)) if found.particles.size > 1 else 0.0
        ),
        **{name: float(np.max(getattr(found, name))) for name in LARGEST},
        **{name: float(getattr(row, name)) for name in OF_ROW},
    }


def _gaps(of_seeds: np.ndarray) -> np.ndarray:
    """The least and the largest of all packings, and means of the quantiles between."""
    known = of_seeds[np.isfinite(of_seeds).all(axis=1)] if of_seeds.size else of_seeds
    if known.size == 0:
        return np.full(len(GAP_QUANTILES), np.nan)
    return np.array([known[:, 0].min(), *known[:, 1:-1].mean(axis=0), known[:, -1].max()])
