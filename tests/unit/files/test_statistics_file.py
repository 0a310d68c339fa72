"""Statistics on disk."""

from __future__ import annotations

import sys
from pathlib import Path

import netCDF4
import numpy as np
import pytest

from grainfront.certificate import Certificate
from grainfront.errors import InputError
from grainfront.files.seal import seal
from grainfront.files.statistics import SceneStatistics, read_statistics, write_statistics
from grainfront.statistics import measure

sys.path.insert(0, str(Path(__file__).parent))
import synthetic

SCENE = {"scene_text": "name: tiny\n", "length_unit": "mm"}
LAWS = {
    "size": ("size", np.linspace(0.4, 1.0, 25), np.full(24, 1 / 24)),
    "aspect_ratio": ("aspect_ratio", np.linspace(1.0, 3.0, 25), np.full(24, 1 / 24)),
    "orientation": ("orientation", np.linspace(0.0, 180.0, 25), np.full(24, 1 / 24)),
}
CONSTANT = {"size": (np.ones(60), np.array([1.0, 1.0]), np.ones(1))}


def scene_statistics(laws) -> SceneStatistics:
    measured = [
        measure(synthetic.packing(10, 6, np.random.default_rng(seed)), laws) for seed in (1, 2, 5)
    ]
    none = np.empty(0, dtype=np.int64)
    certificates = [Certificate(60, 100 + i, i, 0, 0, none.reshape(0, 2), none) for i in range(3)]
    return SceneStatistics.of([1, 2, 5], measured, certificates)


@pytest.mark.parametrize("laws", [LAWS, CONSTANT, {}], ids=["laws", "constant", "none"])
def test_round_trip_and_equal_bytes(tmp_path, laws):
    written = scene_statistics(laws)
    for name in ("a.nc", "b.nc"):
        write_statistics(tmp_path / name, written, **SCENE)
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()
    found = read_statistics(tmp_path / "a.nc")
    assert np.array_equal(found.seeds, [1, 2, 5])
    assert found.values.keys() == written.values.keys()
    for name, array in written.values.items():
        assert np.array_equal(found.values[name], array, equal_nan=True), name
    assert np.array_equal(found.contact_shares, written.contact_shares)
    for ours, theirs in zip(found.distributions, written.distributions, strict=True):
        assert ours.keys() == theirs.keys() == laws.keys()
        for law in laws:
            for name, value in vars(theirs[law]).items():
                assert np.array_equal(getattr(ours[law], name), value), (law, name)
    for ours, theirs in zip(found.orientation_roses, written.orientation_roses, strict=True):
        for name, value in vars(theirs).items():
            assert np.array_equal(getattr(ours, name), value), name


def test_numbers_stand_under_their_own_names(tmp_path):
    packing = synthetic.packing(10, 6, np.random.default_rng(2))
    write_statistics(tmp_path / "statistics.nc", scene_statistics(LAWS), **SCENE)
    with netCDF4.Dataset(tmp_path / "statistics.nc") as dataset:
        assert dataset["particles"][1] == 60
        assert dataset["left_over"][1] == packing.left_over
        assert dataset["pairs_tested"][:].tolist() == [100, 101, 102]
        assert dataset["volume_fraction"][1] == packing.area.sum() / 60
        assert dataset["size_bin_edges"].units == "mm"
        assert dataset["size_share"].dimensions == ("seed", "size_bin")


def test_a_missing_number_is_named(tmp_path):
    write_statistics(tmp_path / "statistics.nc", scene_statistics(LAWS), **SCENE)
    with netCDF4.Dataset(tmp_path / "statistics.nc", "a") as dataset:
        dataset.renameVariable("void_ratio", "porosity")
    seal(tmp_path / "statistics.nc")
    with pytest.raises(InputError, match="void_ratio"):
        read_statistics(tmp_path / "statistics.nc")
