"""The choice of exhaustive search at a fraction of its cost."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainfront.geometry.contact import contact_with_polygons
from grainfront.geometry.tangent import common_tangent
from grainfront.jit import inlined
from grainfront.packing.exhaustive import lower
from grainfront.packing.front import front_length, member_at
from grainfront.packing.state import Trial
from grainfront.packing.trials import (
    BLOCKED,
    BYPASSED,
    NOTHING,
    RESOLVED,
    TOO_HIGH,
    contact_of_pair,
    overlapped,
)

# Pairs wider than this are rare; they are computed afresh.
WIDTHS = 12


class Memory(NamedTuple):
    """What one step has found out about the pairs around the gap; entries of older steps are void.

    Pairs are indexed by the position of their first member from the window's start and by width.
    """

    step: np.ndarray  # (1,) number of the current step
    known: np.ndarray  # (n_window, WIDTHS) step in which the tangent was found
    tangent: np.ndarray  # (n_window, WIDTHS, 3) its vertices on A and B, and N's support vertex
    seen: np.ndarray  # (n_window, WIDTHS, n_angle) step in which the trial was looked at


def make_memory(n_angle: int, n_loc: int) -> Memory:
    """Memory for the local front of 2 n_loc members and the pairs that reach beyond it."""
    n_window = 2 * n_loc + 2 * WIDTHS
    return Memory(
        np.zeros(1, dtype=np.int64),
        np.zeros((n_window, WIDTHS), dtype=np.int64),
        np.empty((n_window, WIDTHS, 3), dtype=np.int64),
        np.zeros((n_window, WIDTHS, n_angle), dtype=np.int64),
    )


@inlined
def remembered_contact(front, placed, domain, trials, trial, memory, base, i, k):
    """As `contact_of_pair`, with the tangent and the last support vertex kept in memory."""
    a = member_at(front, i)
    b = member_at(front, k)
    row = i - base
    width = k - i - 1
    if a < 0 or b < 0 or row < 0 or width >= WIDTHS:
        return contact_of_pair(placed, domain, trials, trial, a, b)
    a0, b0 = placed.offsets[a], placed.offsets[b]
    na, nb = placed.offsets[a + 1] - a0, placed.offsets[b + 1] - b0
    tangent = memory.tangent
    if memory.known[row, width] != memory.step[0]:
        memory.known[row, width] = memory.step[0]
        disc = placed.disc
        va, vb = common_tangent(
            placed.nodes, a0, na, disc[a, 0], disc[a, 1], b0, nb, disc[b, 0], disc[b, 1]
        )
        tangent[row, width, 0] = va
        tangent[row, width, 1] = vb
        tangent[row, width, 2] = 0
    found, x, y, support = contact_with_polygons(
        placed.nodes, a0, na, tangent[row, width, 0], b0, nb, tangent[row, width, 1],
        trials.nodes, trial.start, trial.count, tangent[row, width, 2],
    )  # fmt: skip
    tangent[row, width, 2] = support
    return found, x, y


@inlined
def resolve_below(front, placed, grid, domain, trials, trial, memory, base, i, k, ceiling):
    """As `resolve`, but gives up above `ceiling` and where another trial has been before.

    A trial only rises while its pair widens, and whatever reaches the same pair with the same
    orientation ends at the same place.
    """
    while True:
        row = i - base
        width = k - i - 1
        if row >= 0 and width < WIDTHS:
            if memory.seen[row, width, trial.angle] == memory.step[0]:
                return BLOCKED, 0.0, 0.0, i, k
            memory.seen[row, width, trial.angle] = memory.step[0]
        found, x, y = remembered_contact(front, placed, domain, trials, trial, memory, base, i, k)
        if not found or y > ceiling:
            return BLOCKED, 0.0, 0.0, i, k
        if y + trials.reach[trial.angle, 3] > domain.y_max + domain.tolerance:
            return TOO_HIGH, x, y, i, k
        position = overlapped(front, placed, grid, domain, trials, trial, i, k, x, y)
        if position == NOTHING:
            return RESOLVED, x, y, i, k
        if position == BYPASSED:
            return BLOCKED, 0.0, 0.0, i, k
        if position < i:
            i = position
        else:
            k = position


@inlined
def choose_lowest(front, placed, grid, domain, trials, memory, particle, n_angle, n_loc):
    """The resolved trial of least potential energy: (status, x, y, i, k, angle)."""
    count, circumradius, inradius = particle
    memory.step[0] += 1
    first = max(front.ends[0] - n_loc, 0)
    last = min(front.ends[0] + n_loc - 2, front_length(front) - 2)
    base = first - WIDTHS
    status = BLOCKED
    best_x = best_y = np.inf
    best_i = best_k = best_angle = -1
    for i in range(first, last + 1):
        for angle in range(n_angle):
            trial = Trial(angle * count, count, angle, circumradius, inradius)
            outcome, x, y, at_i, at_k = resolve_below(
                front, placed, grid, domain, trials, trial, memory, base, i, i + 1, best_y
            )
            if outcome == RESOLVED:
                if status != RESOLVED or lower(
                    y, at_i, at_k, angle, best_y, best_i, best_k, best_angle
                ):
                    status = RESOLVED
                    best_x, best_y, best_i, best_k, best_angle = x, y, at_i, at_k, angle
            elif outcome == TOO_HIGH and status == BLOCKED:
                status = TOO_HIGH
    return status, best_x, best_y, best_i, best_k, best_angle
