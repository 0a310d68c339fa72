"""How a packing came to its target volume fraction, as a NetCDF file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from grainfront.files.contract import SCENE, SEED, VERSION, Attribute, Contract, Variable
from grainfront.files.dataset import Path, read_dataset, write_dataset


def _of(type_: str, meanings: dict[str, str]) -> dict[str, Variable]:
    return {name: Variable(type_, ("finish",), "1", text) for name, text in meanings.items()}


TARGET = Contract(
    name="target",
    title="Attempts at a target volume fraction: finishes of packings made up to near the top",
    dimensions={"finish": "finishes in the order in which they were tried; the best was taken"},
    variables={
        **_of(
            "int64",
            {
                "start": "number of the packing that was finished, counted from 0",
                "shared_particles": "particles that all finishes of that packing share",
                "particles": "particles placed in all",
            },
        ),
        **_of(
            "double",
            {
                "shared_effort": "mean effort of the shared particles: 0 is the plain advancing "
                "front method, 1 the n_angle and n_loc of the scene",
                "aim": "volume fraction aimed at below the front",
                "lean": "aim less that of the shared particles",
                "effort": "mean effort of the particles that the finish added, from 0 to 1",
                "volume_fraction": "area of the particles, or of the outlines that will replace "
                "them, over area of the domain",
            },
        ),
    },
    attributes={
        **VERSION,
        **SEED,
        **SCENE,
        "target_volume_fraction": Attribute("number", "the volume fraction asked for"),
        "target_tolerance": Attribute("number", "largest difference allowed"),
        "packings": Attribute("number", "whole packings that would have taken as many placements"),
    },
)


def write_target(path: Path, finishes: Sequence[Any], **attributes: Any) -> None:
    """Write the finishes of a packing (`packing.fraction.Finish`), and the contract's attributes.

    Errors: InputError where an array breaks the contract or the folder cannot be written to.
    """
    types = {"int64": np.int64, "double": np.float64}
    arrays = {
        name: np.array([getattr(finish, name) for finish in finishes], types[variable.type])
        for name, variable in TARGET.variables.items()
    }
    write_dataset(path, TARGET, arrays, attributes)


def read_target(path: Path) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Variables and attributes of the attempts at `path`, bit for bit as written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    return read_dataset(path, TARGET)
