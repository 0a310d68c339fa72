"""Contacts on disk."""

from __future__ import annotations

import numpy as np
import pytest

from grainfront.errors import InputError
from grainfront.files.netcdf import read_contacts, read_packing, write_contacts
from grainfront.statistics import Contacts

SCENE = {"scene_text": "name: tiny\n", "seed": 1, "length_unit": "mm"}


def contacts(count: int) -> Contacts:
    rng = np.random.default_rng(0)
    angle = rng.uniform(0, 2 * np.pi, count)
    return Contacts(
        pairs=np.sort(rng.integers(0, 99, (count, 2)), axis=1),
        position=rng.uniform(0, 10, (count, 2)),
        normal=np.stack([np.cos(angle), np.sin(angle)], axis=1),
        wall_particle=rng.integers(0, 99, count // 2),
        wall=rng.integers(0, 4, count // 2),
    )


@pytest.mark.parametrize("count", [0, 1, 50])
def test_round_trip_and_equal_bytes(tmp_path, count):
    for name in ("a.nc", "b.nc"):
        write_contacts(tmp_path / name, contacts(count), **SCENE)
    assert (tmp_path / "a.nc").read_bytes() == (tmp_path / "b.nc").read_bytes()
    found = read_contacts(tmp_path / "a.nc")
    for name, array in vars(contacts(count)).items():
        assert getattr(found, name).dtype == array.dtype
        assert np.array_equal(getattr(found, name), array), name


def test_one_dataset_is_not_taken_for_another(tmp_path):
    write_contacts(tmp_path / "contacts.nc", contacts(3), **SCENE)
    with pytest.raises(InputError, match="not a packing dataset"):
        read_packing(tmp_path / "contacts.nc")
