"""The pruned search: the choice of exhaustive search at a fraction of its cost.

Three means: an incumbent (a trial hardly ever sinks far while its pair widens), a memory of what
the step has seen (trials that meet at the same pair in the same orientation end at the same place),
and the scout's bounds: pairs are taken lowest bound first until the bound passes the incumbent.
Neither the incumbent's margin nor the bounds are proven. In 900,000 steps of rectangles of λ = 1,
1.5, 4 and 10, triangles, pentagons and hulls of 30 nodes (24 orientations, local fronts of 20,
sizes 1 to 4) the choice was that of exhaustive search, without exception.
"""

from __future__ import annotations

import math

import numpy as np

from grainfront.geometry.contact import contact_from_guess
from grainfront.jit import inlined
from grainfront.packing.arranged import admitted
from grainfront.packing.exhaustive import lower, no_trial_below
from grainfront.packing.front import front_length, member_at
from grainfront.packing.memory import WIDTHS, contact_from_tangent, remember_tangent
from grainfront.packing.obstacles import near_obstacles
from grainfront.packing.scout import bound_pairs, shape_scout
from grainfront.packing.settle import OVERLAPPING, settle
from grainfront.packing.state import Trial
from grainfront.packing.trials import (
    BLOCKED,
    BYPASSED,
    NOTHING,
    RESOLVED,
    TOO_HIGH,
    contact_of_pair,
    overlapped_anywhere,
    overlapped_neighbour,
)

# A trial mostly rises while its pair widens, but may sink where it slides off a ridge; the longer
# the particle, the farther. It is given up this many circumradii above the incumbent, times the
# squared ratio of circumradius to inradius: 0.2 circumradii for rectangles of λ = 1.5, 1.2 for
# λ = 4, which of four million trials one in 50,000 exceeded, few of them the lowest of their step.
SINKING = 0.07
# Nodes from which on it is quicker to start from the contact of the trial before than from the
# tangent.
GUESS_FROM = 8


@inlined
def remembered_contact(placed, trials, trial, memory, a, b, entry):
    """As `contact_of_pair` for particles, guessing from the trial before at the same pair."""
    remember_tangent(placed, memory, a, b, entry)
    guess = memory.guess
    found = False
    x = y = 0.0
    if trial.n_nodes >= GUESS_FROM and guess[entry, 0] >= 0:
        a0, b0 = placed.offsets[a], placed.offsets[b]
        na, nb = placed.offsets[a + 1] - a0, placed.offsets[b + 1] - b0
        found, x, y, ia, ja, ib, jb = contact_from_guess(
            placed.nodes, a0, na, guess[entry, 0], guess[entry, 1],
            b0, nb, guess[entry, 2], guess[entry, 3],
            trials.nodes, trial.start, trial.n_nodes,
        )  # fmt: skip
    if not found:
        found, x, y, ia, ja, ib, jb = contact_from_tangent(
            placed, trials, trial, memory, a, b, entry
        )
    guess[entry, 0] = ia
    guess[entry, 1] = ja
    guess[entry, 2] = ib
    guess[entry, 3] = jb
    return found, x, y


@inlined
def resolve_below(front, placed, grid, domain, trials, trial, memory, base, i, k, ceiling):
    """As `resolve`, but gives up far above `ceiling` and where another trial has been before.

    Whatever reaches the same pair with the same orientation ends at the same place.
    """
    sinking = SINKING * trial.circumradius * (trial.circumradius / trial.inradius) ** 2
    while True:
        row = i - base
        width = k - i - 1
        entry = np.uint64(max(row, 0) * WIDTHS + width)
        a = member_at(front, i)
        b = member_at(front, k)
        in_memory = row >= 0 and width < WIDTHS
        if in_memory:
            if memory.seen[entry, np.uint64(trial.angle)] == memory.step[0]:
                return BLOCKED, 0.0, 0.0, i, k
            memory.seen[entry, np.uint64(trial.angle)] = memory.step[0]
        if near_obstacles(domain.obstacles, placed, domain, trial.circumradius, a, b):
            status, x, y, position, _ = settle(
                domain.obstacles,
                front,
                placed,
                grid,
                domain,
                trials,
                trial,
                i,
                k,
                ceiling + sinking,
            )
            if status != OVERLAPPING:
                return status, x, y, i, k
            if position < i:
                i = position
            else:
                k = position
            continue
        if in_memory and a >= 0 and b >= 0:
            found, x, y = remembered_contact(placed, trials, trial, memory, a, b, entry)
        else:
            found, x, y = contact_of_pair(placed, domain, trials, trial, a, b)
        if not found or y > ceiling + sinking:
            return BLOCKED, 0.0, 0.0, i, k
        if y + trials.reach[trial.angle, 3] > domain.y_max + domain.tolerance:
            return TOO_HIGH, x, y, i, k
        position = overlapped_neighbour(front, placed, domain, trials, trial, i, k, x, y)
        if position == NOTHING and y <= ceiling:
            position = overlapped_anywhere(front, placed, grid, domain, trials, trial, i, k, x, y)
            if position == NOTHING:
                return RESOLVED, x, y, i, k
        if position in (NOTHING, BYPASSED):
            return BLOCKED, 0.0, 0.0, i, k
        if position < i:
            i = position
        else:
            k = position


@inlined
def sort_pairs(memory, n_pairs):
    """Order the pairs by their bounds, lowest first (insertion sort: few and nearly in order)."""
    for p in range(n_pairs):
        m = p
        while m > 0 and memory.bound[memory.order[m - 1]] > memory.bound[p]:
            memory.order[m] = memory.order[m - 1]
            m -= 1
        memory.order[m] = p


@inlined
def choose_lowest(
    front, placed, grid, domain, trials, memory, arrangement, law, highest, particle, n_angle, n_loc
):
    """The resolved trial of least potential energy: (status, x, y, i, k, angle)."""
    count, circumradius, inradius = particle
    memory.step[0] += 1
    first = max(front.ends[0] - n_loc, 0)
    last = min(front.ends[0] + n_loc - 2, front_length(front) - 2)
    base = first - WIDTHS
    scout = shape_scout(trials, n_angle * count, n_angle, inradius)
    bound_pairs(
        front, placed, grid, domain, trials, circumradius, scout, memory, arrangement, law, base,
        first, last,
    )  # fmt: skip
    sort_pairs(memory, last + 1 - first)
    best = no_trial_below(highest)
    # whose centre is higher than this crosses the top
    below_top = domain.y_max + domain.tolerance - inradius
    for n in range(last + 1 - first):
        p = memory.order[n]
        if below_top < memory.bound[p] < math.inf:
            best = lower(best, (TOO_HIGH, math.inf, math.inf, -1, -1, -1))
            break
        if memory.bound[p] > best[2] or memory.bound[p] == math.inf:
            break
        i = first + p
        for angle in range(n_angle):
            trial = Trial(angle * count, count, angle, circumradius, inradius)
            outcome, x, y, at_i, at_k = resolve_below(
                front, placed, grid, domain, trials, trial, memory, base, i, i + 1, best[2]
            )
            if arrangement is not None:
                outcome = admitted(arrangement, law, highest, outcome, x, y)
            best = lower(best, (outcome, x, y, at_i, at_k, angle))
    return best
