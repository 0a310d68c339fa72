"""Packings made by hand, for the tests of what comes after packing."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pytest
import shapely

from grainfront.particles import Packing, Rectangle
from grainfront.polygons import Polygons


@pytest.fixture(scope="session")
def packing_of() -> Callable[..., Packing]:
    """Make a packing of given polygons; fields that are not given are measured or made up."""

    def make(
        parts: Iterable[np.ndarray], domain: Rectangle | None = None, **fields: Any
    ) -> Packing:
        polygons = Polygons.of(parts)
        low, high = polygons.nodes.min(axis=0), polygons.nodes.max(axis=0)
        n = polygons.count
        whole = polygons.node_counts.min() > 2 and np.isfinite(polygons.nodes).all()
        shapes = polygons.to_shapely() if whole else np.full(n, shapely.Point(0, 0))
        measured: dict[str, Any] = {
            "domain": domain or Rectangle(*map(float, low), *map(float, high)),
            "polygons": polygons,
            "x": shapely.get_x(shapely.centroid(shapes)),
            "y": shapely.get_y(shapely.centroid(shapes)),
            "size": np.ones(n),
            "aspect_ratio": np.ones(n),
            "orientation": np.zeros(n),
            "area": shapely.area(shapes),
            "circumradius": np.ones(n),
            "shape": np.zeros(n, dtype=np.int64),
            "left_over": 0,
        }
        return Packing(**(measured | fields))

    return make
