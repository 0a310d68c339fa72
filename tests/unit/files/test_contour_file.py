"""Contour maps on disk, and their run times apart from them."""

from __future__ import annotations

import numpy as np
import pytest
import xarray

from grainfront.errors import InputError
from grainfront.files.contour import (
    Contour,
    read_contour,
    read_contour_timing,
    write_contour,
    write_contour_timing,
)

SCENE = {"scene_text": "length_unit: mm\n", "length_unit": "mm"}
N_ANGLE, N_LOC, SEEDS = (1, 6, 24), (2, 20), (7, 8)


def numbers(n_angle: int, n_loc: int, seed: int) -> dict[str, float]:
    """Made-up numbers, different for each point."""
    at = 1e-4 * (100 * n_angle + 10 * n_loc + seed)
    return {
        "volume_fraction": 0.5 + at,
        "volume_fraction_bulk": np.nan if n_angle == 1 else 0.6 + at,
        "coordination_number": 3.9 + at,
        "particles": 1000 + n_angle,
        "left_over": n_loc,
        "size_l2_error": at,
        "size_noise_level": 2 * at,
        "kernel_s": 10 * at,
    }


def contour(**changes: float) -> Contour:
    return Contour.of(N_ANGLE, N_LOC, SEEDS, lambda *point: numbers(*point) | changes)


def test_each_number_stands_at_its_place():
    found = contour()
    for i, n_angle in enumerate(N_ANGLE):
        for j, n_loc in enumerate(N_LOC):
            for k, seed in enumerate(SEEDS):
                for name, value in numbers(n_angle, n_loc, seed).items():
                    assert np.array_equal(found.values[name][i, j, k], value, equal_nan=True), name
            mean = np.mean([numbers(n_angle, n_loc, s)["volume_fraction"] for s in SEEDS])
            assert found.volume_fraction[i, j] == pytest.approx(mean, rel=1e-15)


def test_round_trip(tmp_path):
    write_contour(tmp_path / "contour.nc", contour(), **SCENE)
    write_contour_timing(tmp_path / "timing.nc", contour(), **SCENE)
    parts = read_contour(tmp_path / "contour.nc"), read_contour_timing(tmp_path / "timing.nc")
    values = parts[0].values | parts[1].values
    assert set(parts[1].values) == {"kernel_s"}
    assert set(values) == set(contour().values)
    for name, array in contour().values.items():
        assert values[name].dtype == array.dtype
        assert np.array_equal(values[name], array, equal_nan=True), name
    for part in parts:
        for name in ("n_angle", "n_loc", "seeds"):
            assert np.array_equal(getattr(part, name), getattr(contour(), name))


def test_run_times_do_not_change_the_bytes_of_the_map(tmp_path):
    for name, seconds in (("a.nc", 0.1), ("b.nc", 0.2)):
        write_contour(tmp_path / name, contour(kernel_s=seconds), **SCENE)
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()


def test_xarray_selects_by_effort_and_seed(tmp_path):
    write_contour(tmp_path / "contour.nc", contour(), **SCENE)
    with xarray.open_dataset(tmp_path / "contour.nc") as found:
        at = found.sel(n_angle=6, n_loc=20, seed=8)
        assert at.volume_fraction == numbers(6, 20, 8)["volume_fraction"]
        assert found.attrs["scene"] == SCENE["scene_text"]
        assert "orientation_l2_error" not in found, "no law, no variable"


def test_a_map_is_not_taken_for_its_run_times(tmp_path):
    write_contour(tmp_path / "contour.nc", contour(), **SCENE)
    with pytest.raises(InputError, match="not a contour_timing dataset"):
        read_contour_timing(tmp_path / "contour.nc")


def test_a_number_that_is_not_finite_is_refused(tmp_path):
    with pytest.raises(InputError, match="volume_fraction holds values that are not finite"):
        write_contour(tmp_path / "contour.nc", contour(volume_fraction=np.nan), **SCENE)
    assert list(tmp_path.iterdir()) == []
