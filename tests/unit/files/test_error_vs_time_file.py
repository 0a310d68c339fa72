"""The record of errors against run time: as written, so read, and as xarray finds it."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray

from grainfront.errors import InputError
from grainfront.files.error_vs_time import ERROR_VS_TIME, read_error_vs_time, write_error_vs_time

sys.path.insert(0, str(Path(__file__).parent))
import synthetic_errors

SEEDS = [5, 6]
LABELS = ("drawing_method", "checks_step")


@pytest.fixture
def records():
    """All axes of a made-up scene: two seeds, three repeats."""
    return synthetic_errors.records(np.random.default_rng(0), n_seeds=2, n_repeats=3)


def write(path, records):
    write_error_vs_time(path, records, seeds=SEEDS, scene_text="a: 1", length_unit="mm")


def test_what_is_read_is_what_was_written(tmp_path, records):
    write(tmp_path / "a.nc", records)
    seeds, found = read_error_vs_time(tmp_path / "a.nc")
    assert seeds.tolist() == SEEDS
    assert {axis: set(one) for axis, one in found.items()} == {
        axis: set(one) for axis, one in records.items()
    }
    for axis, quantities in records.items():
        for name, array in quantities.items():
            np.testing.assert_array_equal(found[axis][name], array)
            assert found[axis][name].dtype == array.dtype


def test_only_the_axes_measured_are_in_the_file(tmp_path, records):
    write(tmp_path / "a.nc", {"effort": records["effort"]})
    with xarray.open_dataset(tmp_path / "a.nc") as found:
        assert {name.partition("_")[0] for name in found.data_vars} == {"effort"}
        assert set(found.dims) == {"seed", "repeat", "effort_point"}


def test_xarray_finds_points_seeds_repeats_units_and_meanings(tmp_path, records):
    write(tmp_path / "a.nc", records)
    with xarray.open_dataset(tmp_path / "a.nc") as found:
        assert found.effort_kernel_s.dims == ("effort_point", "seed", "repeat")
        assert found.effort_deficit.sel(seed=6).sizes == {"effort_point": 4}
        stratified = found.where(found.drawing_method == "stratified", drop=True)
        assert stratified.drawing_size_l2_error.size == 2
        assert found.domain_width.units == "mm"
        assert "times" in found.title and found.scene == "a: 1"
        for name, variable in found.variables.items():
            assert len(variable.attrs["long_name"]) > 5, name
            assert ("units" in variable.attrs) == (name not in LABELS), name


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"deficit": np.zeros((4, 3))}, "along seed"),
        ({"n_loc": np.zeros(4)}, "must be int64"),
        ({"deficit": np.full((4, 2), np.nan)}, "not finite"),
        ({"surprise": np.zeros(4)}, "unknown variables"),
    ],
)
def test_what_breaks_the_contract_is_refused(tmp_path, records, change, told):
    with pytest.raises(InputError, match=re.escape(told)):
        write(tmp_path / "a.nc", {"effort": records["effort"] | change})
    assert not (tmp_path / "a.nc").exists()


def test_labels_must_be_strings(tmp_path, records):
    numbers = records["checks"] | {"step": np.arange(records["checks"]["step"].size)}
    with pytest.raises(InputError, match="must be string"):
        write(tmp_path / "a.nc", {"checks": numbers})


def test_the_title_says_that_times_do_not_repeat():
    assert "all but the times" in ERROR_VS_TIME.title
