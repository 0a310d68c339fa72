"""Errors of a scene against the run time they cost, as one NetCDF file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from grainfront.files.contract import (
    LENGTH,
    SCENE,
    VERSION,
    Contract,
    Variable,
)
from grainfront.files.dataset import Path, read_dataset, write_dataset

Records = Mapping[str, Mapping[str, np.ndarray]]

# What a row is of, beside its point.
SETTING: tuple[str, ...] = ()
SEEDED = ("seed",)
TIMED = ("seed", "repeat")
KERNEL = ("double", TIMED, "s", "CPU time of the packing kernel, on one core")
PARTICLES = ("int64", SEEDED, "1", "particles placed")
FRACTION = "area of the {} over area of the domain"
DELIVERED = (
    "double", SEEDED, "1", FRACTION.format("outlines, or of the hulls where none replace them")
)  # fmt: skip
FRONT = "1 on the Pareto front of time and {}, 0 elsewhere"
E2 = "L2 distribution error E2 of the {}, in 24 bins"
OF_SHAPES = "mean over the shapes of |{0} / {0} of the reference - 1|"

# Type, dimensions beside the axis's points, units and meaning of every quantity of an axis.
Row = tuple[str, tuple[str, ...], str, str]
EFFORT: dict[str, Row] = {
    "n_angle": ("int64", SETTING, "1", "trial orientations of each grain"),
    "n_loc": ("int64", SETTING, "1", "half-size of the local front"),
    "particles": PARTICLES,
    "volume_fraction": ("double", SEEDED, "1", FRACTION.format("hulls")),
    "deficit": ("double", SEEDED, "1", "largest median volume fraction less the volume fraction"),
    "kernel_s": KERNEL,
    "pareto": ("int64", SETTING, "1", FRONT.format("deficit")),
}
OUTLINES: dict[str, Row] = {
    "tolerance": ("double", SETTING, "1", "simplification over the size; 0 of the reference"),
    "vertices": ("double", SETTING, "1", "vertices of the outlines, mean over the shapes"),
    "hull_vertices": ("double", SETTING, "1", "vertices of the hulls, mean over the shapes"),
    **{
        f"{name}_error": ("double", SETTING, "1", OF_SHAPES.format(name.replace("_", " ")))
        for name in ("area", "perimeter", "aspect_ratio", "circularity", "convexity")
    },
    "particles": PARTICLES,
    "volume_fraction": DELIVERED,
    "volume_fraction_error": (
        "double", SEEDED, "1", "|volume fraction - that of the reference for the same seed|"
    ),
    "kernel_s": KERNEL,
    "pareto": ("int64", SETTING, "1", FRONT.format("perimeter error")),
}  # fmt: skip
DRAWING: dict[str, Row] = {
    "method": (
        "string", SETTING, "",
        "independent, stratified or deficit-controlled: values drawn alone; packing: values placed",
    ),
    "n_bin": ("int64", SETTING, "1", "bins whose deficits steer the drawing; 0 where none do"),
    "n_angle": ("int64", SETTING, "1", "trial orientations of each grain; 0 without a packing"),
    "particles": ("int64", SEEDED, "1", "particles placed, or values drawn"),
    "size_l2_error": ("double", SEEDED, "1", E2.format("size")),
    "descriptor_l2_error": (
        "double", SEEDED, "1", E2.format("descriptor with a law; NaN where there is none")
    ),
    "orientation_l2_error": ("double", SEEDED, "1", E2.format("orientation")),
    "cpu_s": ("double", TIMED, "s", "CPU time of the drawing, or of the packing kernel"),
    "pareto": (
        "int64", SETTING, "1",
        "1 on the Pareto front, 0 elsewhere; of values drawn: time and the largest of the errors, "
        "of packings: time and the error of the orientation",
    ),
}  # fmt: skip
DOMAIN: dict[str, Row] = {
    "n_angle": ("int64", SETTING, "1", "trial orientations of each grain"),
    "n_loc": ("int64", SETTING, "1", "half-size of the local front"),
    "width": ("double", SETTING, LENGTH, "width of the domain"),
    "height": ("double", SETTING, LENGTH, "height of the domain"),
    "particles": PARTICLES,
    "volume_fraction": ("double", SEEDED, "1", FRACTION.format("hulls")),
    "volume_fraction_bulk": ("double", SEEDED, "1", "volume fraction away from the walls"),
    "wall_effect": ("double", SEEDED, "1", "volume fraction of the bulk less that of the whole"),
    "kernel_s": KERNEL,
    "pareto": ("int64", SETTING, "1", FRONT.format("wall effect, at each effort by itself")),
}
TARGET: dict[str, Row] = {
    "tolerance": ("double", SETTING, "1", "tolerance of the volume fraction"),
    "prescribed": ("double", SETTING, "1", "volume fraction prescribed"),
    "particles": PARTICLES,
    "packings": ("double", SEEDED, "1", "whole packings that would take as many placements"),
    "volume_fraction": DELIVERED,
    "deviation": ("double", SEEDED, "1", "|volume fraction - volume fraction prescribed|"),
    "kernel_s": ("double", TIMED, "s", "CPU time of the kernel in all packings, on one core"),
    "pareto": ("int64", SETTING, "1", FRONT.format("deviation")),
}
CHECKS: dict[str, Row] = {
    "step": ("string", SETTING, "", "step from the scene to a certified packing and its files"),
    "share": ("double", SEEDED, "1", "share of the CPU time of all steps, of the median repeat"),
    "cpu_s": ("double", TIMED, "s", "CPU time of the step"),
}
AXES = {
    "effort": EFFORT, "outlines": OUTLINES, "drawing": DRAWING, "domain": DOMAIN,
    "target": TARGET, "checks": CHECKS,
}  # fmt: skip

# What is fitted to all domains of one effort.
DOMAIN_FIT: dict[str, Row] = {
    "fit_n_angle": ("int64", (), "1", "trial orientations of the domains fitted"),
    "fit_n_loc": ("int64", (), "1", "half-size of the local front of the domains fitted"),
    "exponent": ("double", (), "1", "kernel time grows as the number of particles to this power"),
    "coefficient": ("double", (), "s", "kernel time of the fit at one particle"),
}


def _variables(axis: str, point: str, rows: Mapping[str, Row]) -> dict[str, Variable]:
    return {
        f"{axis}_{name}": Variable(
            type, (point, *dimensions), units, meaning, optional=True, finite="l2" not in name
        )
        for name, (type, dimensions, units, meaning) in rows.items()
    }


ERROR_VS_TIME = Contract(
    name="error_vs_time",
    title="Errors of a scene against the CPU time they cost; all but the times repeats bit for bit",
    dimensions={
        "seed": "packings of each point",
        "repeat": "times that each packing was repeated",
        **{f"{axis}_point": f"points of the axis {axis}" for axis in AXES},
        "domain_fit": "efforts at which the domains were packed",
    },
    variables={
        "seed": Variable("int64", ("seed",), "1", "seed of the random generators"),
        **{
            name: variable
            for axis, rows in AXES.items()
            for name, variable in _variables(axis, f"{axis}_point", rows).items()
        },
        **_variables("domain", "domain_fit", DOMAIN_FIT),
    },
    attributes={**VERSION, **SCENE},
)


def write_error_vs_time(
    path: Path, records: Records, *, seeds: Sequence[int], scene_text: str, length_unit: str
) -> None:
    """Write the quantities of each axis, under the names of AXES and DOMAIN_FIT.

    Settings have the shape (n_points,), what differs by seed (n_points, n_seeds), times (n_points,
    n_seeds, n_repeats). Errors: InputError where an array breaks the contract or the folder cannot
    be written to.
    """
    arrays = {
        f"{axis}_{name}": array for axis, found in records.items() for name, array in found.items()
    }
    arrays["seed"] = np.array(seeds, dtype=np.int64)
    attributes = {"scene": scene_text, "length_unit": length_unit}
    write_dataset(path, ERROR_VS_TIME, arrays, attributes)


def read_error_vs_time(path: Path) -> tuple[np.ndarray, dict[str, dict[str, np.ndarray]]]:
    """The seeds, and the quantities of each axis in the file, as they were written.

    Errors: InputError where the file is missing, cut off, no NetCDF or breaks the contract.
    """
    arrays, _ = read_dataset(path, ERROR_VS_TIME)
    records: dict[str, dict[str, np.ndarray]] = {}
    for name, array in arrays.items():
        axis, _, quantity = name.partition("_")
        if quantity:
            records.setdefault(axis, {})[quantity] = array
    return arrays["seed"], records
