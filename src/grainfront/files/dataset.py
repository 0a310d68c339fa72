"""One NetCDF dataset in, one out, both held to its contract."""

from __future__ import annotations

import os
from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

import netCDF4
import numpy as np
from jsonschema import Draft202012Validator
from jsonschema.exceptions import best_match

from grainfront.errors import InputError
from grainfront.files.atomic import replacing
from grainfront.files.contract import CONVENTIONS, Contract
from grainfront.files.header import json_schema
from grainfront.files.seal import require_sealed, seal

DTYPES: dict[str, Any] = {
    "int": np.int32, "int64": np.int64, "double": np.float64, "string": str
}  # fmt: skip
# In memory strings are objects, as netCDF4 reads them.
ARRAY_DTYPES = DTYPES | {"string": np.dtype(object)}
Path = str | os.PathLike[str]
Arrays = Mapping[str, np.ndarray]


def write_dataset(
    path: Path, contract: Contract, arrays: Arrays, attributes: Mapping[str, Any]
) -> None:
    """Write `arrays` under the names of `contract`, whole or not at all.

    The file holds nothing but its arguments and the package's version, so that equal arguments
    give equal bytes. Errors: InputError naming the variable that breaks the contract; OSError
    where the file cannot be written, as on a full disk.
    """
    attributes = {"grainfront_version": version("grainfront"), **attributes}
    sizes = _check_arrays(path, contract, arrays)
    try:
        with replacing(path) as temporary:
            with netCDF4.Dataset(temporary, "w", format="NETCDF4") as dataset:
                for name in contract.dimensions:
                    if name in sizes:
                        dataset.createDimension(name, sizes[name])
                for name, variable in contract.variables.items():
                    if name in contract.data and name not in arrays:
                        continue
                    # Without a fill value the bytes of a file are exactly its data.
                    target = dataset.createVariable(
                        name, DTYPES[variable.type], variable.dimensions, fill_value=False
                    )
                    target.long_name = variable.long_name
                    if variable.units:
                        target.units = variable.units.format(**attributes)
                    target.setncatts(variable.attributes)
                    target[...] = arrays.get(name, 0)
                dataset.Conventions = CONVENTIONS
                dataset.title = contract.title
                for name in sorted(attributes):
                    dataset.setncattr(name, attributes[name])
            with netCDF4.Dataset(temporary) as dataset:
                _check_header(path, contract, header(dataset))
            seal(temporary)
    except RuntimeError as error:  # so HDF5 tells of a full disk
        raise OSError(f"{path}: cannot be written ({error}), perhaps for want of space") from error


def read_dataset(path: Path, contract: Contract) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Variables and global attributes of the dataset at `path`.

    Errors: InputError where there is no such file, it is no NetCDF file, it is cut off or damaged,
    or it breaks the contract.
    """
    if not os.path.isfile(path):
        raise InputError(f"{path}: there is no such file")
    try:
        require_sealed(path)
        with netCDF4.Dataset(path) as dataset:
            dataset.set_auto_mask(False)
            found = header(dataset)
            _check_header(path, contract, found)
            present = [name for name in contract.data if name in dataset.variables]
            arrays = {name: dataset[name][...] for name in present}
    except (OSError, RuntimeError) as error:
        raise InputError(f"{path}: not a whole NetCDF file ({error})") from error
    _check_arrays(path, contract, arrays)
    return arrays, found["attributes"]


def header(dataset: netCDF4.Dataset) -> dict[str, Any]:
    """Dimensions, variables and attributes of an open dataset as plain JSON data."""
    return {
        "dimensions": {name: d.size for name, d in dataset.dimensions.items()},
        "variables": {
            name: {
                "type": next((t for t, d in DTYPES.items() if v.dtype == d), str(v.dtype)),
                "dimensions": list(v.dimensions),
                "attributes": _attributes(v),
            }
            for name, v in dataset.variables.items()
        },
        "attributes": _attributes(dataset),
    }


def _attributes(owner: netCDF4.Dataset | netCDF4.Variable) -> dict[str, Any]:
    values = {name: owner.getncattr(name) for name in owner.ncattrs()}
    return {k: v.tolist() if isinstance(v, np.ndarray | np.generic) else v
            for k, v in values.items()}  # fmt: skip


def _check_header(path: Path, contract: Contract, found: dict[str, Any]) -> None:
    error = best_match(Draft202012Validator(json_schema(contract)).iter_errors(found))
    if error:
        where = "/".join(str(step) for step in error.absolute_path)
        raise InputError(
            f"{path}: not a {contract.name} dataset, because in its {where or 'header'} "
            f"{error.message} (results_schema/{contract.name}.schema.json says what is allowed)"
        )


def _check_arrays(path: Path, contract: Contract, arrays: Arrays) -> dict[str, int]:
    """Sizes of the dimensions, after checking names, types, shapes and values of the arrays."""
    required = {name for name, v in contract.data.items() if not v.optional}
    if wrong := sorted((required - set(arrays)) | (set(arrays) - set(contract.data))):
        raise InputError(f"{path}: missing or unknown variables {wrong} in {contract.name} data")
    sizes: dict[str, int] = {}
    for name, array in arrays.items():
        variable = contract.variables[name]
        if array.dtype != ARRAY_DTYPES[variable.type]:
            raise InputError(f"{path}: {name} is {array.dtype}, but must be {variable.type}")
        if array.ndim != len(variable.dimensions):
            raise InputError(
                f"{path}: {name} has the shape {array.shape}, but the dimensions "
                f"{variable.dimensions}"
            )
        for dimension, size in zip(variable.dimensions, array.shape, strict=True):
            if sizes.setdefault(dimension, size) != size:
                raise InputError(
                    f"{path}: {name} has {size} values along {dimension}, others have "
                    f"{sizes[dimension]}"
                )
        if variable.type != "string" and variable.finite and not np.isfinite(array).all():
            raise InputError(f"{path}: {name} holds values that are not finite numbers")
    return sizes
