"""Made-up packings and shapes that keep the contracts, from lattices of random polygons."""

from __future__ import annotations

import numpy as np

from grainfront.particles import Packing, Rectangle
from grainfront.polygons import Polygons


def polygons(count: int, rng: np.random.Generator, *, spikes: float = 0.0) -> Polygons:
    """Polygons round the origin, star-shaped, with 3 to 12 nodes; spikes make them nonconvex."""
    parts = []
    for _ in range(count):
        n = int(rng.integers(3, 13))
        angle = 2 * np.pi * (np.arange(n) + rng.uniform(0, 0.5, n)) / n
        radius = 0.5 * (1 - spikes * (np.arange(n) % 2))
        parts.append(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1))
    return Polygons.of(parts)


def packing(columns: int, rows: int, rng: np.random.Generator, *, spikes: float = 0.0) -> Packing:
    """Random polygons of size about 1 on a square lattice."""
    n = columns * rows
    base = polygons(n, rng, spikes=spikes)
    size = rng.uniform(0.4, 1.0, n)
    x, y = (np.arange(n) % columns + 0.5, np.arange(n) // columns + 0.5)
    owner = np.repeat(np.arange(n), base.node_counts)
    nodes = base.nodes * size[owner, None] + np.stack([x, y], axis=1)[owner]
    placed = Polygons(nodes, base.offsets)
    area = np.array([_area(placed.polygon(i)) for i in range(n)])
    return Packing(
        domain=Rectangle(0.0, 0.0, float(columns), float(rows)),
        polygons=placed,
        x=x,
        y=y,
        size=size,
        aspect_ratio=rng.uniform(1, 3, n),
        orientation=rng.uniform(0, 180, n),
        area=area,
        circumradius=0.5 * size,
        shape=rng.integers(0, 50, n),
        left_over=3,
    )


def _area(nodes: np.ndarray) -> float:
    x, y = nodes.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
