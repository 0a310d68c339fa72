"""The stability matrix as a Markdown table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

Quantities = Mapping[str, np.ndarray]

INTRODUCTION = """# Stability

{runs} runs of {cases} cases, {packings:,} packings of {particles:,} particles in all: {overlaps}
overlaps, {across_wall} particles across a wall, {unaccounted} of {drawn:,} drawn unaccounted for,
{scaled_differently} coordinates changed by scaling all lengths by 2^30.

φ: volume fraction, mean of the packings and their standard deviation. φ/φ₀ and t/t₀: volume
fraction and kernel time a particle over those of the moderate case. Mirror: φ of the mirror image,
its shapes in the opposite order, less φ, over the largest difference that is noise. E2: L2
distribution errors of sizes and orientations over their noise levels. Departure: of stored
coordinates from exact ones, in units in the last place of the farthest coordinate. Gaps: 5 %,
median and 95 % of the contacts, in clearances. Lost: share of the domain lost to clearances.
"""
HEADER = (
    "case", "n_angle / n_loc", "φ", "φ/φ₀", "mirror", "µs a particle", "t/t₀", "tries a particle",
    "E2 of S", "E2 of α", "departure", "gaps", "lost",
)  # fmt: skip
NOTHING = "–"


def markdown(found: Quantities) -> str:
    """The table of a record, with the reasons of its exceptions and the powers of the time."""
    totals = ("packings", "particles", "drawn", "overlaps", "across_wall", "unaccounted",
              "scaled_differently")  # fmt: skip
    lines = [
        INTRODUCTION.format(
            runs=found["case"].size,
            cases=np.unique(found["case"]).size,
            **{name: int(found[name].sum()) for name in totals},
        ),
        _line(HEADER),
        _line(["---", *["--:"] * (len(HEADER) - 1)]),
        *(_line(_cells(found, i)) for i in range(found["case"].size)),
        "",
        "## Exceptions",
        "",
        *_exceptions(found),
        "",
        "## Time a particle",
        "",
        "It grows, at 1 / 1 and 24 / 20, as",
        "",
        *_exponents(found),
    ]
    return "\n".join(lines) + "\n"


def _line(cells: list[str] | tuple[str, ...]) -> str:
    return f"| {' | '.join(cells)} |"


def _cells(found: Quantities, i: int) -> list[str]:
    of = {
        name: values[i] for name, values in found.items() if values.shape[:1] == found["case"].shape
    }
    effort = f"{of['n_angle']} / {of['n_loc']}"
    if of["refusal"]:
        return [of["case"], effort, "refused", *[NOTHING] * (len(HEADER) - 3)]
    quantiles = [int(np.argmin(np.abs(found["gap_quantile"] - q))) for q in (0.05, 0.5, 0.95)]
    gaps = of["gaps"][quantiles]
    return [
        of["case"],
        effort,
        f"{of['volume_fraction']:.4f} ± {of['volume_fraction_sd']:.4f}",
        f"{of['relative_fraction']:.2f}",
        f"{of['mirrored_difference'] / of['mirrored_noise']:+.2f}",
        f"{of['microseconds']:.3g}",
        f"{of['growth']:.2g}",
        f"{of['attempts']:.1f}",
        _over(of["size_l2_error"], of["size_noise_level"]),
        _over(of["orientation_l2_error"], of["orientation_noise_level"]),
        f"{of['departure']:.2f}",
        ", ".join(f"{gap:.2f}" for gap in gaps) if np.isfinite(gaps).all() else NOTHING,
        f"{of['lost']:.1g}",
    ]


def _over(error: float, level: float) -> str:
    """An error in noise levels; a law of a single value has none of either."""
    return f"{error / level:.2f}" if level > 0 else NOTHING


def _exceptions(found: Quantities) -> Iterator[str]:
    """Cases with less expected of them, and why; those refused, and how."""
    told = zip(found["case"], found["reason"], found["refusal"], strict=True)
    for name, reason, refusal in dict.fromkeys(told):
        if reason or refusal:
            yield f"- {name}: {refusal or reason}."


def _exponents(found: Quantities) -> Iterator[str]:
    names = ("series", "series_n_angle", "series_n_loc", "exponent")
    for series, n_angle, n_loc, power in zip(*(found[name] for name in names), strict=True):
        yield f"- {series} to the power {power:.2f} ({n_angle} / {n_loc})"
