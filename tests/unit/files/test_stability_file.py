"""The record of the stability matrix and its table."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from grainfront.errors import InputError
from grainfront.files.stability import STABILITY, read_stability, write_stability
from grainfront.files.stability_table import HEADER, markdown

sys.path.insert(0, str(Path(__file__).parent))
import synthetic_stability


def test_what_is_written_is_read(tmp_path):
    written = synthetic_stability.quantities()
    write_stability(tmp_path / "stability.nc", written)
    read = read_stability(tmp_path / "stability.nc")
    assert set(read) == set(STABILITY.variables)
    for name, values in written.items():
        if values.dtype == object:
            assert read[name].tolist() == values.tolist(), name
        else:
            assert np.array_equal(read[name], values, equal_nan=True), name


def test_a_record_without_a_quantity_is_refused(tmp_path):
    written = synthetic_stability.quantities()
    del written["overlaps"]
    with pytest.raises(InputError, match="overlaps"):
        write_stability(tmp_path / "stability.nc", written)
    assert list(tmp_path.iterdir()) == []


def test_the_table_has_a_line_for_every_run_and_tells_exceptions():
    found = synthetic_stability.quantities()
    text = markdown(found)
    lines = [line for line in text.splitlines() if line.startswith("|")][2:]
    assert len(lines) == found["case"].size
    assert all(line.count("|") == len(HEADER) + 1 for line in lines)
    assert lines[0].startswith("| moderate | 1 / 1 | 0.7000 ± 0.0100 | 1.00 | -0.50 |")
    assert "| refused |" in lines[-1]
    assert "- far away: it must stay within 3e7." in text
    assert "- 2000 edges: there are many." in text
    assert "- edges to the power 0.90 (1 / 1)" in text
    assert f"{found['packings'].sum()} packings of {found['particles'].sum():,} particles" in text
