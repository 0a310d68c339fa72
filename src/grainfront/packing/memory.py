"""What one step of the optimised advancing front finds out about the pairs around the gap."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainfront.geometry.contact import contact_with_polygons
from grainfront.jit import inlined
from grainfront.packing.trials import tangent_of_pair

# Pairs wider than this are rare; they are computed afresh.
WIDTHS = 12


class Memory(NamedTuple):
    """What one step has found out about the pairs around the gap; entries of older steps are void.

    A pair has one entry: WIDTHS for each position of its first member from the window's start, by
    the number of members between. Entries are unsigned, which saves the test for negative indices.
    """

    step: np.ndarray  # (1,) number of the current step
    known: np.ndarray  # (n_entries,) step in which the tangent was found
    tangent: np.ndarray  # (n_entries, 2) its vertices on A and B
    guess: np.ndarray  # (n_entries, 4) vertices of A, N, B, N where the last trial touched
    seen: np.ndarray  # (n_entries, n_angle) step in which the trial was looked at
    scouted: np.ndarray  # (n_entries, 2) step in which a scout came by, and its pair
    height: np.ndarray  # (n_pairs,) of the scout, resolved from each pair
    covers: np.ndarray  # (n_pairs, 2) first and last pair under its place
    bound: np.ndarray  # (n_pairs,) below which no trial from the pair gets
    order: np.ndarray  # (n_pairs,) pairs, lowest bound first


def n_bytes(n_angle: int, n_loc: int) -> int:
    """Bytes of such a memory, to the thousand: those of `seen`."""
    return 8 * 2 * (n_loc + WIDTHS) * WIDTHS * n_angle


def make_memory(n_angle: int, n_loc: int) -> Memory:
    """Memory for the local front of 2 n_loc members and the pairs that reach beyond it."""
    n_pairs = 2 * (n_loc + WIDTHS)
    n_entries = n_pairs * WIDTHS
    return Memory(
        np.zeros(1, dtype=np.int64),
        np.zeros(n_entries, dtype=np.int64),
        np.empty((n_entries, 2), dtype=np.int64),
        np.empty((n_entries, 4), dtype=np.int64),
        np.zeros((n_entries, n_angle), dtype=np.int64),
        np.zeros((n_entries, 2), dtype=np.int64),
        np.empty(n_pairs),
        np.empty((n_pairs, 2), dtype=np.int64),
        np.empty(n_pairs),
        np.empty(n_pairs, dtype=np.int64),
    )


@inlined
def remember_tangent(placed, memory, a, b, entry):
    """Find the common tangent of the particles a and b, once a step."""
    if memory.known[entry] != memory.step[0]:
        memory.known[entry] = memory.step[0]
        memory.tangent[entry, 0], memory.tangent[entry, 1] = tangent_of_pair(placed, a, b)
        memory.guess[entry, 0] = -1


@inlined
def contact_from_tangent(placed, trials, trial, memory, a, b, entry):
    """`contact_with_polygons` of the particles a and b, from the tangent in memory."""
    remember_tangent(placed, memory, a, b, entry)
    a0, b0 = placed.offsets[a], placed.offsets[b]
    na, nb = placed.offsets[a + 1] - a0, placed.offsets[b + 1] - b0
    tangent = memory.tangent
    return contact_with_polygons(
        placed.nodes, a0, na, tangent[entry, 0], b0, nb, tangent[entry, 1],
        trials.nodes, trial.start, trial.n_nodes,
    )  # fmt: skip
