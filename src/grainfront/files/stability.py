"""The stability matrix and the growth of rounding errors, as one NetCDF file."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from grainfront.files.contract import VERSION, Contract, Variable
from grainfront.files.dataset import Path, read_dataset, write_dataset

Quantities = Mapping[str, np.ndarray]

RUN = ("run",)
ULPS = "units in the last place of the farthest coordinate of the domain"
E2 = "L2 distribution error E2 of the {}, in 24 bins, mean over the packings"
NOISE = "E2 of the {} under independent sampling, mean over the packings"

# Units and meaning of every quantity, in groups of one type and one tuple of dimensions; numbers
# but the first group's are NaN or 0 for runs that are refused.
Meanings = dict[str, tuple[str, str]]
TEXTS: Meanings = {
    "case": ("", "name of the case"),
    "group": ("", "group of the case"),
    "expected_refusal": ("", "words of the sentence that must refuse it; empty: it is packed"),
    "refusal": ("", "the sentence that refused it; empty: it was packed"),
    "reason": ("", "why less is expected of it than of others; empty where it is not"),
}
COUNTS: Meanings = {
    "n_angle": ("1", "trial orientations of each particle"),
    "n_loc": ("1", "half-size of the local front"),
    "packings": ("1", "packings, each of a seed of its own; counts below are sums over them"),
    "particles": ("1", "particles placed"),
    "drawn": ("1", "particles drawn"),
    "left_over": ("1", "particles drawn that found no place"),
    "failed": ("1", "tries to place a particle that found no place"),
    "unaccounted": ("1", "particles drawn that are not once among those placed and left over"),
    "overlaps": ("1", "certificate: pairs of particles that share interior points"),
    "across_wall": ("1", "certificate: particles that cross a wall"),
    "pairs_exact": ("1", "certificate: pairs that floating point could not decide"),
    "scaled_differently": ("1", "coordinates that scaling all lengths by 2^30 changes in a bit"),
}
NUMBERS: Meanings = {
    "volume_fraction": ("1", "area of the particles over area of the domain, mean"),
    "volume_fraction_sd": ("1", "its standard deviation over the packings; 0 of one packing"),
    "relative_fraction": ("1", "volume fraction over that of the moderate case"),
    "mirrored_difference": (
        "1", "volume fraction with shapes and orientations mirrored, and the shapes in the "
        "opposite order, less the volume fraction",
    ),
    "mirrored_noise": ("1", "the largest such difference that is noise"),
    "size_l2_error": ("1", E2.format("size")),
    "size_noise_level": ("1", NOISE.format("size")),
    "orientation_l2_error": ("1", E2.format("orientation")),
    "orientation_noise_level": ("1", NOISE.format("orientation")),
    "microseconds": ("us", "kernel time a particle, of the quickest packing"),
    "growth": ("1", "kernel time a particle over that of the moderate case"),
    "most_growth": ("1", "the most of it that is expected"),
    "attempts": ("1", "particles tried for each one placed"),
    "departure": ("1", f"largest distance from the exact transformation of a hull, in {ULPS}"),
    "lost": ("1", "largest share of the domain by which particles are tested larger than stored"),
}  # fmt: skip
SERIES: Meanings = {
    "series_n_angle": ("1", "trial orientations along the series; of a series of them, 24"),
    "series_n_loc": ("1", "half-size of the local front along the series"),
}
GROWTH = ("size_ratio", "offset")
GROWTHS: Meanings = {
    "farthest": ("1", "farthest coordinate of the domain over the smallest size"),
    "clearance": ("1", "clearance over the smallest size"),
    "rounding": ("1", f"largest clearance tried with which the certificate failed, in {ULPS}"),
    "growth_departure": ("1", f"largest departure from the exact transformation, in {ULPS}"),
}


def _of(
    type_: str, dimensions: tuple[str, ...], meanings: Meanings, finite: bool = True
) -> dict[str, Variable]:
    return {
        name: Variable(type_, dimensions, units, meaning, finite=finite)
        for name, (units, meaning) in meanings.items()
    }


STABILITY = Contract(
    name="stability",
    title="Extreme cases against a moderate one, and the growth of rounding errors",
    dimensions={
        "run": "cases at their efforts, the moderate case first",
        "gap_quantile": "quantiles of the contact gaps",
        "series": "series of cases along which the kernel time is fitted",
        "size_ratio": "ratios of the largest size to the smallest",
        "offset": "offsets of the domain from the origin",
        "edges": "numbers of edges of equal ellipses",
    },
    variables={
        **_of("string", RUN, TEXTS),
        **_of("int64", RUN, COUNTS),
        **_of("double", RUN, NUMBERS, finite=False),
        **_of("double", ("gap_quantile",), {"gap_quantile": ("1", "shares of the gaps below")}),
        **_of(
            "double",
            (*RUN, "gap_quantile"),
            {"gaps": ("1", "gaps of the contacts, in clearances; NaN where there are none")},
            finite=False,
        ),
        **_of("string", ("series",), {"series": ("", "what changes along the series")}),
        **_of("int64", ("series",), SERIES),
        **_of(
            "double",
            ("series",),
            {"exponent": ("1", "kernel time a particle grows as what changes to this power")},
        ),
        **_of("double", ("size_ratio",), {"size_ratio": ("1", "largest over smallest size")}),
        **_of("double", ("offset",), {"offset": ("1", "distance from the origin in mean sizes")}),
        **_of("double", GROWTH, GROWTHS),
        **_of("int64", ("edges",), {"edges": ("1", "edges of each particle")}),
        **_of("double", ("edges",), {"edges_rounding": GROWTHS["rounding"]}),
        **_of(
            "double",
            (),
            {"clearance_ulps": ("1", f"clearance that packings are made with, {ULPS}")},
        ),
    },
    attributes=VERSION,
)


def write_stability(path: Path, quantities: Quantities) -> None:
    """Write all quantities under the names of the contract.

    Errors: InputError where an array breaks the contract or the folder cannot be written to.
    """
    write_dataset(path, STABILITY, quantities, {})


def read_stability(path: Path) -> dict[str, np.ndarray]:
    """All quantities, as they were written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    return read_dataset(path, STABILITY)[0]
