"""Contour maps over the effort of the packing, and the run times behind them, as NetCDF files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from grainfront.files.contract import LAW_UNITS, SCENE, VERSION, Contract, Variable
from grainfront.files.dataset import DTYPES, Path, read_dataset, write_dataset

AXES = ("n_angle", "n_loc", "seed")
DIMENSIONS = {
    "n_angle": "numbers of trial orientations, ascending",
    "n_loc": "half-sizes of the local front, ascending",
    "seed": "packings of each pair of n_angle and n_loc",
}
COORDINATES = {
    "n_angle": Variable("int64", ("n_angle",), "1", "trial orientations of each particle"),
    "n_loc": Variable("int64", ("n_loc",), "1", "half-size of the local front"),
    "seed": Variable("int64", ("seed",), "1", "seed of the random generators"),
}


def _law(law: str) -> dict[str, Variable]:
    name = law.replace("_", " ")
    meanings = {
        f"{law}_l2_error": f"L2 distribution error E2 of the {name}",
        f"{law}_noise_level": f"E2 of the {name} under independent sampling",
    }
    return {key: Variable("double", AXES, "1", text, optional=True)
            for key, text in meanings.items()}  # fmt: skip


CONTOUR = Contract(
    name="contour",
    title="Packings of a scene at many efforts: contour maps over n_angle and n_loc",
    dimensions=DIMENSIONS,
    variables={
        **COORDINATES,
        "volume_fraction": Variable(
            "double", AXES, "1", "area of the particles over area of the domain"
        ),
        "volume_fraction_outlines": Variable(
            "double", AXES, "1", "the same with the outlines for the hulls", optional=True
        ),
        "volume_fraction_bulk": Variable(
            "double", AXES, "1", "volume fraction away from the walls", finite=False
        ),
        "coordination_number": Variable("double", AXES, "1", "2 x contact pairs / particles"),
        "particles": Variable("int64", AXES, "1", "particles placed"),
        "left_over": Variable("int64", AXES, "1", "particles drawn that found no place"),
        **{name: variable for law in LAW_UNITS for name, variable in _law(law).items()},
    },
    attributes={**VERSION, **SCENE},
)

CONTOUR_TIMING = Contract(
    name="contour_timing",
    title="Run times of the packings of a contour map",
    dimensions=DIMENSIONS,
    variables={
        **COORDINATES,
        "kernel_s": Variable("double", AXES, "s", "time of one core spent packing"),
    },
    attributes={**VERSION, **SCENE},
)


@dataclass(frozen=True)
class Contour:
    """What packings at all pairs of efforts are like.

    `n_angle` (n,), `n_loc` (m,) and `seeds` (k,) are int64, the efforts ascending. `values` maps
    the name of each number (volume_fraction, coordination_number, size_l2_error …, or kernel_s) to
    an array of shape (n, m, k).
    """

    n_angle: np.ndarray
    n_loc: np.ndarray
    seeds: np.ndarray
    values: dict[str, np.ndarray]

    @classmethod
    def of(
        cls,
        n_angle: Sequence[int],
        n_loc: Sequence[int],
        seeds: Sequence[int],
        numbers: Callable[[int, int, int], Mapping[str, float]],
    ) -> Contour:
        """Put together the `numbers` of each n_angle, n_loc and seed."""
        rows = [numbers(a, b, c) for a in n_angle for b in n_loc for c in seeds]
        shape = len(n_angle), len(n_loc), len(seeds)
        variables = CONTOUR.variables | CONTOUR_TIMING.variables
        values = {
            name: np.array([row[name] for row in rows], DTYPES[variables[name].type]).reshape(shape)
            for name in rows[0]
        }
        angles, locs, numbered = (np.array(axis, np.int64) for axis in (n_angle, n_loc, seeds))
        return cls(angles, locs, numbered, values)

    @property
    def volume_fraction(self) -> np.ndarray:
        """Volume fraction of each pair, the mean over its seeds, shape (n, m).

        It is that of what the scene ends with: of the outlines, where they replace the hulls.
        """
        of_hulls = self.values["volume_fraction"]
        return self.values.get("volume_fraction_outlines", of_hulls).mean(axis=2)


def write_contour(path: Path, contour: Contour, *, scene_text: str, length_unit: str) -> None:
    """Write a contour map without its run times; equal input gives equal bytes.

    Errors: InputError where an array breaks the contract or the folder cannot be written to.
    """
    _write(path, CONTOUR, contour, scene_text, length_unit)


def write_contour_timing(
    path: Path, contour: Contour, *, scene_text: str, length_unit: str
) -> None:
    """Write the run times of a contour map alone.

    Errors: InputError where an array breaks the contract or the folder cannot be written to.
    """
    _write(path, CONTOUR_TIMING, contour, scene_text, length_unit)


def _write(
    path: Path, contract: Contract, contour: Contour, scene_text: str, length_unit: str
) -> None:
    arrays = {"n_angle": contour.n_angle, "n_loc": contour.n_loc, "seed": contour.seeds}
    arrays |= {name: a for name, a in contour.values.items() if name in contract.variables}
    write_dataset(path, contract, arrays, {"scene": scene_text, "length_unit": length_unit})


def read_contour(path: Path) -> Contour:
    """The contour map at `path`, bit for bit as written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    return _read(path, CONTOUR)


def read_contour_timing(path: Path) -> Contour:
    """The run times of a contour map, bit for bit as written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    return _read(path, CONTOUR_TIMING)


def _read(path: Path, contract: Contract) -> Contour:
    arrays, _ = read_dataset(path, contract)
    n_angle, n_loc, seeds = (arrays.pop(name) for name in AXES)
    return Contour(n_angle, n_loc, seeds, arrays)
