"""What is expected of every packing and of a case: each expectation not met is a sentence."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from grainfront.packing.state import CLEARANCE_ULPS
from grainfront.studies.stability.case import Effort
from grainfront.studies.stability.matrix import Row, noise

# Nothing of these may ever be found; each is a field of `Found`, and what it means.
NEVER = {
    "overlaps": "pairs that share interior points",
    "across_wall": "particles across a wall",
    "unaccounted": "particles that are neither placed nor left over",
    "scaled_differently": "coordinates that scaling by a power of two changes",
}
# A volume fraction known exactly is met up to the rounding of the areas.
EXACT_FRACTION = 1e-12
# Stored coordinates and contacts may each be wrong by as much of the clearance: half would meet.
MOST_DEPARTURE = CLEARANCE_ULPS / 8.0
# Clearances less their tolerance, three quarters, lie between particles, but for that departure.
LEAST_GAP = 0.5


def unmet(rows: Sequence[Row]) -> list[str]:
    """Every expectation that is not met: the case, what was found and what was expected."""
    by_name = {(row.case.name, row.effort): row for row in rows}
    return [f"{row.name}: {text}" for row in rows for text in _of_row(row, by_name)]


def _of_row(row: Row, rows: Mapping[tuple[str, Effort], Row]) -> Iterator[str]:
    case, found = row.case, row.found
    if case.refused or found.refusal:
        expected = f'a refusal with "{case.refused}"' if case.refused else "a packing"
        got = f'a refusal: "{found.refusal}"' if found.refusal else "a packing"
        if not (case.refused and case.refused in found.refusal):
            yield f"{got} (expected {expected})"
        return
    for field, meaning in NEVER.items():
        if count := int(np.sum(getattr(found, field))):
            yield f"{count} {meaning} (expected none)"
    yield from _rounding(row)
    yield from _fractions(row, rows)
    yield from _laws(row)
    if row.growth > case.most_growth:
        yield f"{row.growth:.1f} times the moderate case's time (at most {case.most_growth:g})"


def _rounding(row: Row) -> Iterator[str]:
    found = row.found
    if (off := np.max(found.departure)) > MOST_DEPARTURE:
        yield f"coordinates {off:.1f} ulps from exact ones (at most {MOST_DEPARTURE:g})"
    if np.any(found.gaps < LEAST_GAP):
        yield f"a gap of {np.nanmin(found.gaps):.2f} clearances (at least {LEAST_GAP:g})"
    if (lost := np.max(found.lost)) > row.case.most_lost:
        yield f"{lost:.1e} of the domain lost to clearances (at most {row.case.most_lost:g})"


def _fractions(row: Row, rows: Mapping[tuple[str, Effort], Row]) -> Iterator[str]:
    case, found = row.case, row.found
    fraction = found.volume_fraction
    if case.volume_fraction is not None:
        off = np.max(np.abs(fraction - case.volume_fraction))
        if off > EXACT_FRACTION:
            yield f"volume fraction {off:.2g} off (expected {case.volume_fraction:.6f} exactly)"
    if row.relative_fraction < case.least_fraction:
        yield (
            f"{row.relative_fraction:.3f} of the moderate case's volume fraction "
            f"(at least {case.least_fraction:g})"
        )
    if not case.handed and abs(row.mirrored_difference) > row.mirrored_noise:
        yield (
            f"volume fraction {row.mirrored_difference:+.4f} in the mirror "
            f"(at most {row.mirrored_noise:.4f})"
        )
    if case.like:
        other = rows[case.like, row.effort].found
        difference = float(np.mean(fraction) - np.mean(other.volume_fraction))
        most = noise(found, fraction, other, other.volume_fraction)
        if abs(difference) > most:
            yield f"volume fraction {difference:+.4f} beside {case.like} (at most {most:.4f})"


def _laws(row: Row) -> Iterator[str]:
    for law in ("size", "orientation"):
        error = np.mean(getattr(row.found, f"{law}_l2_error"))
        level = np.mean(getattr(row.found, f"{law}_noise_level"))
        if error > row.case.most_e2 * level + EXACT_FRACTION:
            yield f"E2 of the {law} {error:.2g} (at most {row.case.most_e2:g} × {level:.2g})"
