"""Packing hulls into a rectangle: prepares the arrays, runs the kernel, hands back a Packing."""

from __future__ import annotations

from dataclasses import dataclass
from collections.abc import Callable

import numpy as np

from grainfront.geometry.moments import radii_about_origin
from grainfront.packing.advance import N_COUNTERS, N_PLACED, N_WAITING, FINISHED, WAITING_PLACES, advance
from grainfront.packing.front import make_front
from grainfront.packing.grid import make_grid
from grainfront.packing.search import make_memory
from grainfront.packing.state import (
    CLEARANCE_ULPS, TOLERANCE_OF_CLEARANCE, Domain, OrientationLaw, Placed, Supply, Trials,
)
from grainfront.particles import Packing, Rectangle
from grainfront.polygons import Polygons

def make_domain(r):
    ulp = np.finfo(float).eps * max(abs(r.x_min), abs(r.y_min), abs(r.x_max), abs(r.y_max))
    c = CLEARANCE_ULPS * ulp
    return Domain(r.x_min, r.y_min, r.x_max, r.y_max, c, TOLERANCE_OF_CLEARANCE * c)

def make_supply(hulls, shape, size, uniform):
    R = np.empty(hulls.count); r = np.empty(hulls.count)
    radii_about_origin(hulls.nodes, hulls.offsets, R, r)
    return Supply(hulls.nodes, hulls.offsets, R, r, shape, size, uniform)

def pack_raw(hulls, shape, size, uniform, prob, table, rect, n_angle, n_loc, exhaustive=False):
    domain = make_domain(rect)
    supply = make_supply(hulls, shape, size, uniform)
    n = len(size)
    law = OrientationLaw(prob, np.r_[0, np.cumsum(prob)], table, np.zeros(len(prob), np.int64))
    R = supply.circumradius[shape] * size
    nodes_total = int(hulls.node_counts[shape].sum())
    placed = Placed(np.empty((nodes_total, 2)), np.zeros(n + 1, np.int64), np.empty((n, 4)), np.empty(n), np.empty(n, np.int64))
    grid = make_grid(domain, R.min(), R.max(), n)
    front = make_front(n)
    m = int(hulls.node_counts.max())
    trials = Trials(np.empty((n_angle * m, 2)), np.empty((n_angle, 4)), np.empty(n_angle), np.empty(n_angle, np.int64), np.empty(len(prob) + 1))
    waiting = np.empty(WAITING_PLACES, np.int64)
    counters = np.zeros(N_COUNTERS, np.int64)
    memory = make_memory(n_angle, n_loc) if n_angle*n_loc > 1 and not exhaustive else None
    args = (front, placed, grid, domain, supply, law, trials, waiting, counters, memory, n_angle, n_loc)
    return args
