"""The statistics of all packings of a scene as one NetCDF file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from grainfront.certificate import Certificate
from grainfront.files.contract import LAW_UNITS
from grainfront.files.dataset import Path, read_dataset, write_dataset
from grainfront.files.statistics_contract import (
    REGION_VARIABLES,
    SEED_COUNTS,
    SEED_FRACTIONS,
    STATISTICS,
)
from grainfront.statistics import Distribution, OrientationRose, PackingStatistics
from grainfront.statistics.regions import RegionStatistics

CERTIFICATE_COUNTS = ("pairs_tested", "pairs_exact", "overlaps", "across_wall")


@dataclass(frozen=True)
class SceneStatistics:
    """What was measured in the packings of a scene, one a seed.

    `seeds` has the shape (n_seeds,). `values` maps the name of each number (volume_fraction,
    coordination_number, overlaps ...) to an array of that shape. `contact_shares` has the shape
    (n_seeds, largest number of contacts + 1). `distributions` and `orientation_roses` have one
    entry a seed; bins and prescribed probabilities are the same in all of them. `regions` holds
    what was found in the regions of an arrangement, under the names of the contract.
    """

    seeds: np.ndarray
    values: dict[str, np.ndarray]
    contact_shares: np.ndarray
    distributions: tuple[dict[str, Distribution], ...]
    orientation_roses: tuple[OrientationRose, ...]
    regions: dict[str, np.ndarray]

    @classmethod
    def of(
        cls,
        seeds: Sequence[int],
        measured: Sequence[PackingStatistics],
        certificates: Sequence[Certificate],
    ) -> SceneStatistics:
        """Put together what was measured in, and certified of, the packing of each seed."""
        rows = [_numbers(*pair) for pair in zip(measured, certificates, strict=True)]
        dtypes = dict.fromkeys(SEED_COUNTS, np.int64) | dict.fromkeys(SEED_FRACTIONS, np.float64)
        longest = max(m.contact_shares.size for m in measured)
        return cls(
            seeds=np.array(seeds, dtype=np.int64),
            values={name: np.array([row[name] for row in rows], d) for name, d in dtypes.items()},
            contact_shares=np.stack(
                [np.pad(m.contact_shares, (0, longest - m.contact_shares.size)) for m in measured]
            ),
            distributions=tuple(m.distributions for m in measured),
            orientation_roses=tuple(m.orientation_rose for m in measured),
            regions=_regions([m.regions for m in measured if m.regions is not None]),
        )


def _numbers(measured: PackingStatistics, certificate: Certificate) -> dict[str, float]:
    """Every single number of one packing, under the names of the contract."""
    numbers = {name: getattr(certificate, name) for name in CERTIFICATE_COUNTS}
    correlation = measured.size_correlation
    numbers |= {f"size_correlation_{name}": getattr(correlation, name)
                for name in ("x", "y", "centre", "noise_level")}  # fmt: skip
    rest = (SEED_COUNTS.keys() | SEED_FRACTIONS) - numbers.keys()
    return numbers | {name: getattr(measured, name) for name in rest}


def _regions(found: Sequence[RegionStatistics]) -> dict[str, np.ndarray]:
    """What was found in the regions by each seed, under the names of the contract."""
    if not found:
        return {}
    arrays = {
        "region_area": found[0].area,
        "misplaced_share": np.array([each.misplaced for each in found]),
        **{
            f"region_{name}": np.stack([getattr(each, name) for each in found])
            for name in ("particles", "volume_fraction", "mean_size")
        },
    }
    for law in LAW_UNITS:
        of_law = [[region.get(law) for region in each.distributions] for each in found]
        if any(one for each in of_law for one in each):
            for name in ("l2_error", "noise_level"):
                arrays[f"region_{law}_{name}"] = np.array(
                    [[getattr(one, name, np.nan) for one in each] for each in of_law]
                )
        if law in found[0].forced:
            arrays[f"{law}_forced_l2_error"] = np.array([each.forced[law] for each in found])
    return arrays


def write_statistics(
    path: Path, statistics: SceneStatistics, *, scene_text: str, length_unit: str
) -> None:
    """Write the statistics of a scene; equal input gives equal bytes.

    Errors: InputError where an array breaks the contract or the folder cannot be written to.
    """
    roses = statistics.orientation_roses
    arrays = {
        "seed": statistics.seeds,
        **statistics.values,
        "contact_share": statistics.contact_shares,
        "rose_bin_edges": roses[0].edges,
        "rose_share": np.stack([rose.shares for rose in roses]),
        **statistics.regions,
    }
    if roses[0].probabilities is not None:
        arrays["rose_probability"] = roses[0].probabilities
    for law, first in statistics.distributions[0].items():
        placed = [distributions[law] for distributions in statistics.distributions]
        arrays |= {
            f"{law}_bin_edges": first.edges,
            f"{law}_probability": first.probabilities,
            f"{law}_share": np.stack([d.shares for d in placed]),
            f"{law}_l2_error": np.array([d.l2_error for d in placed]),
            f"{law}_noise_level": np.array([d.noise_level for d in placed]),
        }
    attributes = {"scene": scene_text, "length_unit": length_unit}
    write_dataset(path, STATISTICS, arrays, attributes)


def read_statistics(path: Path) -> SceneStatistics:
    """The statistics at `path`, bit for bit as written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    arrays, _ = read_dataset(path, STATISTICS)
    laws = [law for law in LAW_UNITS if f"{law}_share" in arrays]
    seeds = range(arrays["seed"].size)
    return SceneStatistics(
        seeds=arrays["seed"],
        values={name: arrays[name] for name in (*SEED_COUNTS, *SEED_FRACTIONS)},
        contact_shares=arrays["contact_share"],
        distributions=tuple({law: _distribution(arrays, law, i) for law in laws} for i in seeds),
        orientation_roses=tuple(
            OrientationRose(
                arrays["rose_bin_edges"], arrays["rose_share"][i], arrays.get("rose_probability")
            )
            for i in seeds
        ),
        regions={name: arrays[name] for name in REGION_VARIABLES if name in arrays},
    )


def _distribution(arrays: dict[str, np.ndarray], law: str, seed: int) -> Distribution:
    return Distribution(
        edges=arrays[f"{law}_bin_edges"],
        probabilities=arrays[f"{law}_probability"],
        shares=arrays[f"{law}_share"][seed],
        l2_error=float(arrays[f"{law}_l2_error"][seed]),
        noise_level=float(arrays[f"{law}_noise_level"][seed]),
    )
