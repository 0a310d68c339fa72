"""Packings on disk: the same bits back, the same bytes again, the conventions kept."""

from __future__ import annotations

import shutil
import subprocess
import sys
from dataclasses import fields, replace
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import shapely
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from grainfront.errors import InputError
from grainfront.files.netcdf import read_attributes, read_packing, write_packing
from grainfront.files.seal import seal
from grainfront.particles import Cell, Packing, Rectangle, Region
from grainfront.polygons import Polygons

sys.path.insert(0, str(Path(__file__).parent))
import synthetic

SCENE = "name: tiny\n# φ and µm survive\nlength_unit: mm\n"


def write(path, packing, **changes):
    keywords = {"scene_text": SCENE, "seed": 7, "length_unit": "mm", "volume_fraction": 0.75}
    write_packing(path, packing, **(keywords | changes))


def assert_same(a, b):
    """Equal to the last bit, signs of zero included."""
    for f in fields(Packing):
        left, right = getattr(a, f.name), getattr(b, f.name)
        if isinstance(left, Polygons):
            assert left.nodes.tobytes() == right.nodes.tobytes()
            assert np.array_equal(left.offsets, right.offsets)
            assert right.offsets.dtype == np.int64
        elif isinstance(left, np.ndarray):
            assert left.dtype == right.dtype
            assert left.tobytes() == right.tobytes()
        else:
            assert left == right


finite = st.floats(allow_nan=False, allow_infinity=False)
positive = st.floats(min_value=0, allow_infinity=False, exclude_min=True)


@st.composite
def packings(draw):
    counts = draw(st.lists(st.integers(3, 6), min_size=0, max_size=5))
    n = len(counts)
    offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    nodes = draw(arrays(np.float64, (int(offsets[-1]), 2), elements=finite))
    x_min, x_max = sorted(draw(st.tuples(finite, finite)))
    y_min, y_max = sorted(draw(st.tuples(finite, finite)))
    column = arrays(np.float64, n, elements=finite)
    return Packing(
        domain=Rectangle(x_min, y_min, x_max, y_max),
        polygons=Polygons(nodes, offsets),
        **{f: draw(column) for f in
           ("x", "y", "size", "aspect_ratio", "orientation", "area", "circumradius")},
        shape=draw(arrays(np.int64, n)),
        left_over=draw(st.integers(0, 2**40)),
    )  # fmt: skip


@settings(max_examples=40, deadline=None)
@given(packings(), st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0")))
def test_round_trip_bit_for_bit(tmp_path_factory, packing, scene):
    path = tmp_path_factory.mktemp("packing") / "packing.nc"
    write(path, packing, scene_text=scene)
    assert_same(packing, read_packing(path))
    assert read_attributes(path)["scene"] == scene


def test_a_region_comes_back_bit_for_bit(tmp_path):
    frame = shapely.box(-0.1, 0.0, 4.0, 3.0).difference(shapely.Point(2.0, 1.0).buffer(1 / 3))
    region = Region.of(shapely.union_all([frame, shapely.box(5.0, 0.0, 6.0, 1.0)]))
    packing = replace(synthetic.packing(2, 3, np.random.default_rng(0)), domain=region)
    write(tmp_path / "packing.nc", packing)
    read = read_packing(tmp_path / "packing.nc").domain
    assert isinstance(read, Region)
    np.testing.assert_array_equal(read.rings.nodes, region.rings.nodes)
    np.testing.assert_array_equal(read.rings.offsets, region.rings.offsets)
    np.testing.assert_array_equal(read.parts, region.parts)
    assert (read.x_min, read.y_max, read.area) == (-0.1, 3.0, region.area)


@pytest.mark.parametrize("along_y", [False, True])
def test_a_cell_comes_back_bit_for_bit(tmp_path, along_y):
    packing = synthetic.packing(3, 2, np.random.default_rng(1))
    packing = replace(packing, domain=Cell(-0.1, 1e-9, 1 / 3, 2.0, along_y))
    write(tmp_path / "packing.nc", packing)
    assert_same(packing, read_packing(tmp_path / "packing.nc"))


@pytest.mark.parametrize(
    ("attribute", "value", "says"),
    [
        ("periodic", "y", "periodic is 'y', but must be 'x' or 'x y'"),
        ("domain", "POINT (1 2)", "the domain is POINT .1 2., but must be a polygon"),
        ("domain", "MULTIPOLYGON (((0 0, 2 2, 2 0, 0 2, 0 0)))", "no valid polygon"),
        ("domain", "MULTIPOLYGON (((0 0, 2 0, 2 2, 0 0)))", "periodic is 'x'"),
        ("domain", "POLY", "no WKT polygon"),
    ],
)
def test_a_damaged_domain_is_told(tmp_path, attribute, value, says):
    path = tmp_path / "packing.nc"
    packing = synthetic.packing(3, 2, np.random.default_rng(1))
    write(path, replace(packing, domain=Cell(0.0, 0.0, 3.0, 2.0, False)))
    with netCDF4.Dataset(path, "a") as dataset:
        dataset.setncattr(attribute, value)
    seal(path)
    with pytest.raises(InputError, match=says) as error:
        read_packing(path)
    assert str(path) in str(error.value)


def test_equal_input_gives_equal_bytes_in_any_process(tmp_path):
    script = (
        "import sys, numpy as np; sys.path.insert(0, sys.argv[1]); import test_packing_file as t\n"
        "t.write(sys.argv[2], t.synthetic.packing(8, 5, np.random.default_rng(3)))\n"
    )
    for name in ("a.nc", "b.nc"):
        folder = str(Path(__file__).parent)
        subprocess.run([sys.executable, "-c", script, folder, tmp_path / name], check=True)
    write(tmp_path / "c.nc", synthetic.packing(8, 5, np.random.default_rng(3)))
    a, b, c = ((tmp_path / name).read_bytes() for name in ("a.nc", "b.nc", "c.nc"))
    assert a == b == c


def test_cf_xarray_decodes_the_polygons(tmp_path):
    cf_xarray = pytest.importorskip("cf_xarray")
    packing = synthetic.packing(6, 4, np.random.default_rng(0), spikes=0.4)
    write(tmp_path / "packing.nc", packing)
    with xr.open_dataset(tmp_path / "packing.nc") as dataset:
        decoded = cf_xarray.geometry.decode_geometries(dataset.load())
        found = decoded["geometry"].values
    expected = packing.polygons.to_shapely()
    assert [p.wkb for p in found] == [p.wkb for p in expected]
    assert all(p.exterior.is_ccw for p in found)


def test_the_conventions_are_kept(tmp_path):
    write(tmp_path / "packing.nc", synthetic.packing(3, 2, np.random.default_rng(0)))
    with netCDF4.Dataset(tmp_path / "packing.nc") as dataset:
        assert dataset.Conventions == "CF-1.9"
        assert dataset["geometry"].geometry_type == "polygon"
        assert dataset["geometry"].node_coordinates == "node_x node_y"
        assert dataset["node_x"].axis == "X"
        assert dataset["size"].units == "mm"
        assert dataset["area"].units == "mm^2"
        assert dataset["orientation"].units == "degree"
        assert dataset.domain == "POLYGON ((0.0 0.0, 3.0 0.0, 3.0 2.0, 0.0 2.0, 0.0 0.0))"
        assert (dataset.seed, dataset.volume_fraction, dataset.left_over) == (7, 0.75, 3)
        assert dataset.scene == SCENE
        for name, variable in dataset.variables.items():
            assert variable.long_name
            assert name == "geometry" or variable.units


@pytest.mark.skipif(not shutil.which("ncdump"), reason="ncdump is not installed")
def test_ncdump_reads_the_header(tmp_path):
    write(tmp_path / "packing.nc", synthetic.packing(3, 2, np.random.default_rng(0)))
    dump = subprocess.run(
        ["ncdump", "-h", tmp_path / "packing.nc"], check=True, capture_output=True, text=True
    ).stdout
    assert "particle = 6 ;" in dump
    assert 'geometry:node_coordinates = "node_x node_y" ;' in dump


@pytest.mark.parametrize("keep", [0, 7, 600, 0.5, 0.99])
def test_a_file_cut_off_is_refused(tmp_path, keep):
    path = tmp_path / "packing.nc"
    write(path, synthetic.packing(20, 20, np.random.default_rng(0)))
    whole = path.read_bytes()
    path.write_bytes(whole[: keep if isinstance(keep, int) else int(keep * len(whole))])
    with pytest.raises(InputError, match=r"packing\.nc: not a whole NetCDF file"):
        read_packing(path)


def test_what_is_no_packing_is_refused(tmp_path):
    text, other = tmp_path / "text.nc", tmp_path / "other.nc"
    text.write_text("x, y\n")
    netCDF4.Dataset(other, "w").close()
    for path in (text, other):
        with pytest.raises(InputError, match="not a whole NetCDF file"):
            read_packing(path)
        seal(path)
    with pytest.raises(InputError, match="not a whole NetCDF file"):
        read_packing(text)
    with pytest.raises(InputError, match="not a packing dataset"):
        read_packing(other)
    with pytest.raises(InputError, match="no such file"):
        read_packing(tmp_path / "none.nc")


def rename(dataset):
    dataset.renameVariable("size", "diameter")


def change_units(dataset):
    dataset["orientation"].units = "radian"


def spoil_domain(dataset):
    dataset.domain = "POLYGON ((0 0"


def spoil_counts(dataset):
    dataset["node_count"][0] += 1


def spoil_node(dataset):
    dataset["node_x"][0] = np.nan


@pytest.mark.parametrize(
    ("spoil", "says"),
    [
        (rename, "'size' is a required property"),
        (change_units, "variables/orientation/attributes/units 'degree' was expected"),
        (spoil_domain, "domain is no WKT"),
        (spoil_counts, "node_count must"),
        (spoil_node, "node_x holds values that are not finite"),
    ],
)
def test_a_broken_contract_is_named(tmp_path, spoil, says):
    path = tmp_path / "packing.nc"
    write(path, synthetic.packing(3, 2, np.random.default_rng(0)))
    with netCDF4.Dataset(path, "a") as dataset:
        spoil(dataset)
    seal(path)
    with pytest.raises(InputError, match=says) as error:
        read_packing(path)
    assert str(error.value).startswith(str(path))


def test_every_flipped_bit_is_told(tmp_path):
    """Without the seal, one of ten goes unnoticed, and some end the process inside HDF5."""
    path = tmp_path / "packing.nc"
    write(path, synthetic.packing(3, 3, np.random.default_rng(1)))
    whole = path.read_bytes()
    for place in np.random.default_rng(2).integers(0, 8 * len(whole), 500):
        damaged = bytearray(whole)
        damaged[place // 8] ^= 1 << place % 8
        path.write_bytes(damaged)
        with pytest.raises(InputError, match="damaged or changed since it was written"):
            read_packing(path)


def test_other_readers_do_not_mind_the_seal(tmp_path):
    path = tmp_path / "packing.nc"
    packing = synthetic.packing(3, 3, np.random.default_rng(1))
    write(path, packing)
    with xr.open_dataset(path) as dataset:
        assert np.array_equal(dataset["size"], packing.size)
    with netCDF4.Dataset("memory", memory=path.read_bytes()) as dataset:
        assert np.array_equal(dataset["size"], packing.size)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"size": np.ones(6, np.float32)}, "size is float32, but must be double"),
        ({"size": np.ones(5)}, "size has 5 values along particle|others have 5"),
        ({"area": np.full(6, np.inf)}, "area holds values that are not finite"),
        ({"left_over": "three"}, "attributes/left_over 'three' is not of type 'integer'"),
    ],
)
def test_data_that_break_the_contract_are_not_written(tmp_path, changes, says):
    path = tmp_path / "packing.nc"
    path.write_text("earlier result")
    good = synthetic.packing(3, 2, np.random.default_rng(0))
    with pytest.raises(InputError, match=says):
        write(path, replace(good, **changes))
    assert path.read_text() == "earlier result"
    assert list(tmp_path.iterdir()) == [path]
