"""Near nodes and edges are those that shapely's search tree finds."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront.geometry.boxes import bounding_boxes, close_pairs
from grainfront.geometry.nearness import near_nodes_and_edges
from grainfront.geometry.rings import neighbours
from grainfront.polygons import Polygons


def stars(rng: np.random.Generator, count: int, most_nodes: int) -> Polygons:
    """Star-shaped polygons, many of them across one another."""
    polygons = []
    for _ in range(count):
        angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, rng.integers(3, most_nodes + 1)))
        radius = rng.uniform(0.3, 1.0, angle.size)
        centre = rng.uniform(0.0, np.sqrt(count), 2)
        ring = centre + radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        polygons.append(ring)
    return Polygons.of(polygons)


def touching_squares(rows: int) -> Polygons:
    """Unit squares side by side: shared edges, shared corners, all gaps 0."""
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    return Polygons.of(square + [i, j] for j in range(rows) for i in range(rows))


def found(polygons: Polygons, distance: float) -> set[tuple[int, int]]:
    nodes, offsets = polygons.nodes, polygons.offsets
    boxes = bounding_boxes(nodes, offsets)
    pairs = close_pairs(boxes, distance)
    row, node, edge = near_nodes_and_edges(nodes, offsets, boxes, pairs, distance)
    assert (np.diff(row) >= 0).all()
    owner = np.repeat(np.arange(polygons.count), polygons.node_counts)
    owners = np.sort(np.column_stack([owner[node], owner[edge]]), axis=1)
    assert np.array_equal(owners, pairs[row])
    result = set(zip(node.tolist(), edge.tolist(), strict=True))
    assert len(result) == node.size, "each is found once"
    return result


def found_by_shapely(polygons: Polygons, distance: float) -> set[tuple[int, int]]:
    nodes = polygons.nodes
    owner = np.repeat(np.arange(polygons.count), polygons.node_counts)
    _, after = neighbours(polygons.offsets)
    edges = shapely.linestrings(np.stack([nodes, nodes[after]], axis=1))
    node, edge = shapely.STRtree(edges).query(
        shapely.points(nodes), predicate="dwithin", distance=distance
    )
    apart = owner[node] != owner[edge]
    return set(zip(node[apart].tolist(), edge[apart].tolist(), strict=True))


@given(
    seed=st.integers(0, 2**32 - 1),
    count=st.integers(1, 30),
    most_nodes=st.integers(3, 40),
    distance=st.sampled_from([1e-6, 0.01, 0.1, 0.5]),
)
@settings(max_examples=50, deadline=None)
def test_as_many_as_shapely_finds(seed, count, most_nodes, distance):
    polygons = stars(np.random.default_rng(seed), count, most_nodes)
    assert found(polygons, distance) == found_by_shapely(polygons, distance)


@pytest.mark.parametrize("distance", [0.0, 1e-6])
def test_edges_and_corners_that_touch(distance):
    polygons = touching_squares(4)
    expected = found_by_shapely(polygons, distance)
    assert found(polygons, distance) == expected
    assert len(expected) > 100


def test_no_pairs_no_nodes():
    assert found(touching_squares(1), 1.0) == set()
