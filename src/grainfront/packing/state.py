"""The data a packing works on: named tuples of arrays, so that kernels take few arguments.

Indices: a *particle* counts in order of placement; a *member* of the advancing front is a particle
or a wall (negative); a *position* counts members along the front, from the left wall to the right.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

LEFT_WALL, BOTTOM_WALL, RIGHT_WALL = -1, -2, -3

# A new particle is placed and tested inflated by a clearance, and stored as it is, so that rounding
# cannot make stored neighbours overlap. Contacts and stored coordinates are wrong by a few units in
# the last place of the largest coordinate; 64 of them leave a wide margin.
CLEARANCE_ULPS = 64.0
# Exact ties (face on face) may come out as penetrations by rounding: a quarter of the clearance is
# accepted, which still leaves three quarters of it between the stored particles.
TOLERANCE_OF_CLEARANCE = 0.25


class Reached(NamedTuple):
    """Lists of the obstacles within reach of members of the front, kept while trials come by."""

    obstacle: np.ndarray  # (n_items,) lists of obstacles, one behind the other
    tangent: np.ndarray  # (n_items, 2, 2) of member and obstacle, and of obstacle and member
    filled: np.ndarray  # (1,) items in use
    member: np.ndarray  # (n_lists,) whose list it is, or -1
    reach: np.ndarray  # (n_lists,) from the member's centre
    start: np.ndarray  # (n_lists,) where the list begins
    end: np.ndarray  # (n_lists,) one past its last


class Obstacles(NamedTuple):
    """Convex pieces of what is outside a domain of any shape: particles that never move.

    They are stored behind the places of the particles, from index `first` on, and never join the
    front. Each cell of a lattice over the bounding rectangle lists the pieces that meet it.
    """

    first: int
    empty_about: float  # circumradii about the start of a front that are free of particles
    box: np.ndarray  # (n_obstacles, 4) bounding boxes
    cell: float
    columns: int
    rows: int
    start: np.ndarray  # (columns × rows + 1,) where the list of each cell begins, row by row
    item: np.ndarray  # (n_items,) index from 0 on
    beside_start: np.ndarray  # (n_obstacles + 1,) where the list of each obstacle begins
    beside: np.ndarray  # (n_beside,) others that a particle may touch together with it
    rejected: np.ndarray  # (n,) whether a particle of the supply found no place to begin a front
    crowded: np.ndarray  # (n_obstacles,) whether particles leave no place beside it for a new front
    met: np.ndarray  # (n_obstacles,) number of the search that came by last
    search: np.ndarray  # (1,) number of the current search
    overlapped: np.ndarray  # (1,) the latest that a trial overlapped, or -1
    reached: Reached
    closed_to: np.ndarray  # (n + 3,) of each member: the next one, if a scout found no place there
    closed_from: np.ndarray  # (n + 3,) and the least radius of such a scout
    splits: np.ndarray  # (n,) whether a piece lies between a particle of the front and the next one


class Domain(NamedTuple):
    """Walls of the rectangle and the tolerance of overlap tests, all in the scene's unit.

    Of a domain of any shape it is the bounding rectangle, and `obstacles` is what it is not.
    """

    x_min: float
    y_min: float
    x_max: float
    y_max: float
    clearance: float
    tolerance: float
    obstacles: Obstacles | None


class Supply(NamedTuple):
    """Particles waiting to be placed, and the standardised hulls they are copies of."""

    hull_nodes: np.ndarray  # (n_hull_nodes, 2), centroid at the origin, S = 1
    hull_offsets: np.ndarray  # (n_shapes + 1,)
    circumradius: np.ndarray  # (n_shapes,), of the hull about its centroid
    inradius: np.ndarray  # (n_shapes,)
    shape: np.ndarray  # (n,) index of the hull
    size: np.ndarray  # (n,) minimum Feret diameter
    uniform: np.ndarray  # (n,) in [0, 1): the random offset of the trial orientations


class OrientationLaw(NamedTuple):
    """The prescribed orientations as bin probabilities and a quantile table, in degrees."""

    probability: np.ndarray  # (n_bin,)
    cumulative: np.ndarray  # (n_bin + 1,)
    quantile: np.ndarray  # (n_table,) at equally spaced probabilities from 0 to 1
    largest_rise: float  # of the table between neighbours, in degrees; beyond it lies a gap


class OrientationLaws(NamedTuple):
    """Orientation laws in rows: see `OrientationLaw`; all have as many bins."""

    probability: np.ndarray  # (n_laws, n_bin)
    cumulative: np.ndarray  # (n_laws, n_bin + 1)
    quantile: np.ndarray  # (n_laws, n_table)
    largest_rise: np.ndarray  # (n_laws,)
    placed: np.ndarray  # (n_laws, n_bin) how many particles each bin has so far


class Queues(NamedTuple):
    """Particles of each law that are yet to be drawn from the supply, and those that wait.

    Of the waiting, the first `parked` found no place in a whole row, without the top being the
    reason: too wide for the domain, say. They are left for later rows.
    """

    drawn: np.ndarray  # (n_laws,) the next particle of the law in the supply
    last: np.ndarray  # (n_laws,) one past its last
    waiting: np.ndarray  # (n_laws, places)
    n_waiting: np.ndarray  # (n_laws,)
    parked: np.ndarray  # (n_laws,)
    n_placed: np.ndarray  # (n_laws,)
    passed: np.ndarray  # (n + 3,) of each member: the next one, if what was tried rested elsewhere
    least_height: np.ndarray  # (n + 3,) and how high that was
    rough_centre: np.ndarray  # (3,) about where the next particle goes: x, y, least height
    last_rows: np.ndarray  # (1,) rows without a place that end a packing which is not full


class Placed(NamedTuple):
    """Particles that have found their place; nodes, offsets and disc go on with the obstacles."""

    nodes: np.ndarray  # (n_nodes, 2)
    offsets: np.ndarray  # (n + 1,)
    disc: np.ndarray  # (n, 4): x, y, circumradius, inradius
    orientation: np.ndarray  # (n,) degrees
    source: np.ndarray  # (n,) index into the supply


class Grid(NamedTuple):
    """Cell lists of the placed particles, one level for each range of circumradii."""

    head: np.ndarray  # (n_cells,) latest particle of each cell, or -1
    next: np.ndarray  # (n,) the particle before it in the same cell, or -1
    level: np.ndarray  # (n_levels, 5): cell size, largest circumradius, columns, rows, first cell
    occupied: np.ndarray  # (n_levels,) particles in each level


class Front(NamedTuple):
    """The stacks Back and Front as one array with a gap between their tops (paper, Fig. 8)."""

    member: np.ndarray  # (capacity,)
    slot: np.ndarray  # (n,) index of a particle in `member`, or -1 once it is buried
    ends: np.ndarray  # (2,) one past Back's top; Front's top


class Trials(NamedTuple):
    """The particle to be placed in all its trial orientations, inflated by the clearance."""

    nodes: np.ndarray  # (n_angle × largest node count + scout, 2), relative to the centre
    reach: np.ndarray  # (n_angle, 4) from the centre to the left, bottom, right and top
    orientation: np.ndarray  # (n_angle,) degrees
    bin: np.ndarray  # (n_angle,)
    weight: np.ndarray  # (n_bin + 1,) work space: cumulative deficits


class Trial(NamedTuple):
    """One trial orientation of the particle to be placed."""

    start: int
    n_nodes: int
    angle: int
    circumradius: float
    inradius: float
