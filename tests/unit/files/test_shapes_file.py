"""Shape databases on disk: the same bits back, the same bytes again."""

from __future__ import annotations

import netCDF4
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from grainfront.errors import InputError
from grainfront.files.contract import SHAPES
from grainfront.files.netcdf import read_shapes, write_shapes
from grainfront.files.seal import seal
from grainfront.polygons import Polygons
from grainfront.shapes.database import ShapeDatabase

SOURCE = {"source": "photographs: [skimage:gravel]\n", "seed": 3, "source_unit": "pixel"}
DESCRIPTORS = (
    "size", "length", "aspect_ratio", "orientation", "area", "hull_area", "perimeter",
    "convex_perimeter", "convexity", "regularity", "inscribed_radius", "circumscribed_radius",
    "circularity",
)  # fmt: skip


@st.composite
def databases(draw, smallest=0):
    counts = draw(st.lists(st.integers(3, 7), min_size=smallest, max_size=5))
    offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    finite = st.floats(allow_nan=False, allow_infinity=False)
    nodes = draw(arrays(np.float64, (int(offsets[-1]), 2), elements=finite))
    # Any three or more nodes of an outline may be the hull's, in any rotation.
    hull_nodes = [
        np.roll(np.sort(draw(st.permutations(range(n)))[: draw(st.integers(3, n))]), 1) + start
        for n, start in zip(counts, offsets, strict=False)
    ]
    joined = np.concatenate([np.empty(0, dtype=np.int64), *hull_nodes]).astype(np.int64)
    hull_offsets = np.concatenate([[0], np.cumsum([h.size for h in hull_nodes])]).astype(np.int64)
    column = arrays(np.float64, len(counts), elements=finite)
    descriptors = {name: draw(column) for name in DESCRIPTORS}
    descriptors["regularity"] = np.full(len(counts), np.inf)
    return ShapeDatabase(
        outlines=Polygons(nodes, offsets),
        hulls=Polygons(nodes[joined], hull_offsets),
        hull_nodes=joined,
        descriptors=descriptors,
        counts={"found": 7, "border": draw(st.integers(0, 9))},
    )


@settings(max_examples=30, deadline=None)
@given(databases())
def test_round_trip_bit_for_bit(tmp_path_factory, database):
    path = tmp_path_factory.mktemp("shapes") / "shapes.nc"
    write_shapes(path, database, **SOURCE)
    again = path.with_name("again.nc")
    write_shapes(again, database, **SOURCE)
    assert path.read_bytes() == again.read_bytes()
    found = read_shapes(path)
    for ours, theirs in ((found.outlines, database.outlines), (found.hulls, database.hulls)):
        assert ours.nodes.tobytes() == theirs.nodes.tobytes()
        assert np.array_equal(ours.offsets, theirs.offsets)
    assert np.array_equal(found.hull_nodes, database.hull_nodes)
    assert found.descriptors.keys() == database.descriptors.keys()
    for name, values in database.descriptors.items():
        assert found.descriptors[name].tobytes() == values.tobytes()
    assert found.counts == database.counts


@settings(max_examples=5, deadline=None)
@given(databases(smallest=1))
def test_hull_nodes_index_the_nodes_of_the_file(tmp_path_factory, database):
    path = tmp_path_factory.mktemp("shapes") / "shapes.nc"
    write_shapes(path, database, **SOURCE)
    with netCDF4.Dataset(path) as dataset:
        dataset.set_auto_mask(False)
        index = dataset["hull_node"][...]
        assert np.array_equal(dataset["node_x"][...][index], database.hulls.nodes[:, 0])
        assert np.array_equal(dataset["node_y"][...][index], database.hulls.nodes[:, 1])
        assert dataset["size"].units == "pixel"
        assert dataset.count_found == 7


@settings(max_examples=1, deadline=None)
@given(databases(smallest=1))
def test_a_hull_node_that_is_no_node_is_refused(tmp_path_factory, database):
    path = tmp_path_factory.mktemp("shapes") / "shapes.nc"
    write_shapes(path, database, **SOURCE)
    with netCDF4.Dataset(path, "a") as dataset:
        dataset["hull_node"][0] = 10**6
    seal(path)
    with pytest.raises(InputError, match="hull_node does not index"):
        read_shapes(path)


def test_the_contract_has_every_descriptor():
    assert set(DESCRIPTORS) <= set(SHAPES.variables)
