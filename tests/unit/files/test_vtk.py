"""VTK files read back with pyvista."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from grainfront.errors import InputError
from grainfront.files.vtk import CELL_FIELDS, write_vtp

sys.path.insert(0, str(Path(__file__).parent))
import synthetic

pyvista = pytest.importorskip("pyvista")


@pytest.mark.parametrize("spikes", [0.0, 0.5])
def test_polygons_and_cell_data_come_back(tmp_path, spikes):
    packing = synthetic.packing(7, 5, np.random.default_rng(1), spikes=spikes)
    write_vtp(tmp_path / "packing.vtp", packing)
    mesh = pyvista.read(tmp_path / "packing.vtp")
    assert mesh.n_cells == packing.polygons.count
    assert mesh.points.dtype == np.float64
    assert np.array_equal(mesh.points[:, :2], packing.polygons.nodes)
    assert not mesh.points[:, 2].any()
    for i in range(mesh.n_cells):
        cell = mesh.get_cell(i)
        assert np.array_equal(cell.points[:, :2], packing.polygons.polygon(i))
    for name in CELL_FIELDS:
        assert np.array_equal(mesh.cell_data[name], getattr(packing, name))
    assert np.array_equal(mesh.cell_data["particle"], np.arange(35))


def test_nonconvex_polygons_are_triangulated_without_overlap(tmp_path):
    """ParaView draws the ear-cut triangles of a polygon; their areas must add up to its area."""
    packing = synthetic.packing(5, 5, np.random.default_rng(2), spikes=0.6)
    write_vtp(tmp_path / "packing.vtp", packing)
    mesh = pyvista.read(tmp_path / "packing.vtp")
    assert mesh.triangulate().area == pytest.approx(packing.area.sum(), rel=1e-12)


def test_equal_packings_give_equal_bytes(tmp_path):
    for name in ("a.vtp", "b.vtp"):
        write_vtp(tmp_path / name, synthetic.packing(6, 6, np.random.default_rng(3)))
    assert (tmp_path / "a.vtp").read_bytes() == (tmp_path / "b.vtp").read_bytes()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.vtp", "b.vtp"]


def test_another_ending_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"ends in \.vtp"):
        write_vtp(tmp_path / "packing.vtk", synthetic.packing(2, 2, np.random.default_rng(0)))
