"""The schemas: one for each dataset, lawful, in step with the contracts, and strict."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import jsonschema
import netCDF4
import numpy as np
import pytest

from grainfront.files.contract import PACKING
from grainfront.files.dataset import header
from grainfront.files.header import cdl, json_schema
from grainfront.files.netcdf import write_packing
from grainfront.files.schema import CONTRACTS, documents, drifted

sys.path.insert(0, str(Path(__file__).parent))
import synthetic

RESULTS_SCHEMA = Path(__file__).parents[3] / "results_schema"


def test_the_documents_have_not_drifted_from_the_contracts():
    assert drifted(RESULTS_SCHEMA) == [], (
        "run `python -m grainfront.files.schema --fix results_schema`"
    )


def test_drift_is_found_and_fixed(tmp_path):
    command = [sys.executable, "-m", "grainfront.files.schema", str(tmp_path)]
    assert subprocess.run(command, capture_output=True).returncode == 1
    assert subprocess.run([*command, "--fix"], capture_output=True).returncode == 0
    assert drifted(tmp_path) == []
    (tmp_path / "packing.cdl").write_text("netcdf packing {}")
    assert drifted(tmp_path) == ["packing.cdl"]


@pytest.mark.parametrize("contract", CONTRACTS, ids=lambda c: c.name)
def test_schemas_are_lawful_and_documents_complete(contract):
    jsonschema.Draft202012Validator.check_schema(json_schema(contract))
    assert json.loads(documents()[f"{contract.name}.schema.json"]) == json_schema(contract)
    for name, variable in contract.variables.items():
        assert f"\t{variable.type} {name}" in cdl(contract)
        assert set(variable.dimensions) <= set(contract.dimensions)


def test_the_schema_takes_what_is_written_and_nothing_else(tmp_path):
    path = tmp_path / "packing.nc"
    packing = synthetic.packing(3, 2, np.random.default_rng(0))
    write_packing(path, packing, scene_text="", seed=1, length_unit="m", volume_fraction=0.5)
    validator = jsonschema.Draft202012Validator(json_schema(PACKING))
    with netCDF4.Dataset(path) as dataset:
        found = header(dataset)
    assert validator.is_valid(found)
    for group in ("dimensions", "attributes", "variables"):
        for name in found[group]:
            less = found | {group: {k: v for k, v in found[group].items() if k != name}}
            assert not validator.is_valid(less), name
        assert not validator.is_valid(found | {group: found[group] | {"other": 1}})
    for name, variable in found["variables"].items():
        for change in ({"type": "float"}, {"dimensions": ["other"]}, {"attributes": {}}):
            changed = found["variables"] | {name: variable | change}
            assert not validator.is_valid(found | {"variables": changed}), (name, change)
