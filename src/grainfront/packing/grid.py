"""Cell lists that find every placed particle near a point."""

from __future__ import annotations

import math

import numpy as np

from grainfront.jit import inlined
from grainfront.packing.state import Domain, Grid

# Each level holds circumradii within this ratio: a larger one makes the scans of a small particle
# meet too many cells' worth of neighbours, a smaller one makes every scan visit more levels.
LEVEL_RATIO = 4.0


def make_grid(domain: Domain, smallest: float, largest: float, capacity: int) -> Grid:
    """An empty grid for particles with circumradii between `smallest` and `largest`."""
    n_levels = max(1, math.ceil(math.log(largest / smallest, LEVEL_RATIO) - 1e-9))
    width, height = domain.x_max - domain.x_min, domain.y_max - domain.y_min
    level = np.empty((n_levels, 5))
    first = 0
    # cells of fewer than one particle each would cost memory and time for nothing
    smallest_cell = math.sqrt(width * height / capacity)
    for i in range(n_levels):
        radius = largest / LEVEL_RATIO**i
        cell = max(2.0 * radius, smallest_cell)
        columns, rows = math.floor(width / cell) + 1, math.floor(height / cell) + 1
        level[i] = cell, radius, columns, rows, first
        first += columns * rows
    return Grid(
        head=np.full(first, -1, dtype=np.int32),
        next=np.empty(capacity, dtype=np.int32),
        level=level,
        occupied=np.zeros(n_levels, dtype=np.int64),
    )


@inlined
def insert(grid, domain, particle, x, y, circumradius):
    """Enter a placed particle into the level of its circumradius."""
    n = grid.level.shape[0] - 1
    while n > 0 and grid.level[n, 1] < circumradius:
        n -= 1
    cell = grid.level[n, 0]
    columns = int(grid.level[n, 2])
    rows = int(grid.level[n, 3])
    column = min(max(int((x - domain.x_min) / cell), 0), columns - 1)
    row = min(max(int((y - domain.y_min) / cell), 0), rows - 1)
    index = int(grid.level[n, 4]) + row * columns + column
    grid.next[particle] = grid.head[index]
    grid.head[index] = particle
    grid.occupied[n] += 1
