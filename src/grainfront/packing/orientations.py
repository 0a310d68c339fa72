"""Trial orientations that steer towards the prescribed law (Du et al. 2023, Pseudocode 9)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from grainfront.jit import inlined
from grainfront.packing.state import OrientationLaw, OrientationLaws

# The quantile table of an orientation law holds this many steps a bin.
STEPS_A_BIN = 256


def orientation_law(probabilities: np.ndarray, quantile: np.ndarray) -> OrientationLaw:
    """The law of the orientations as a table.

    `probabilities`, (n_bin,), are those of equal bins of the law's support; `quantile`,
    (n_table,), the orientations in degrees at equally spaced probabilities over the support. A step
    of the table over more than a bin is a gap in the law.
    """
    probabilities = probabilities / probabilities.sum()
    cumulative = np.concatenate([[0.0], np.cumsum(probabilities)])
    bin_width = (quantile[-1] - quantile[0]) / probabilities.size
    return OrientationLaw(probabilities, cumulative, quantile, bin_width)


def orientation_laws(laws: Sequence[OrientationLaw]) -> OrientationLaws:
    """Laws as the kernel takes them, with nothing placed yet.

    A constant law has one bin; to stand beside others it gets empty ones.
    """
    n_bin = max(law.probability.size for law in laws)
    empty = [n_bin - law.probability.size for law in laws]
    probability = np.stack(
        [np.pad(law.probability, (0, n)) for law, n in zip(laws, empty, strict=True)]
    )
    return OrientationLaws(
        probability,
        np.stack(
            [np.pad(law.cumulative, (0, n), "edge") for law, n in zip(laws, empty, strict=True)]
        ),
        np.stack([law.quantile for law in laws]),
        np.array([law.largest_rise for law in laws]),
        np.zeros(probability.shape, dtype=np.int64),
    )


@inlined
def draw_orientations(laws, row, trials, n_angle, n_placed, uniform):
    """Draw `n_angle` orientations in [0, 180) by systematic sampling of the bins' deficits.

    The deficit of a bin is what it lacks once one more particle is placed; bins that have their
    share already offer nothing.
    """
    n_bin = laws.probability.shape[1]
    trials.weight[0] = 0.0
    for b in range(n_bin):
        deficit = laws.probability[row, b] * (n_placed + 1) - laws.placed[row, b]
        trials.weight[b + 1] = trials.weight[b] + max(deficit, 0.0)
    step = trials.weight[n_bin] / n_angle
    last = laws.quantile.shape[1] - 1
    b = 0
    for a in range(n_angle):
        target = (a + uniform) * step
        while b < n_bin - 1 and trials.weight[b + 1] <= target:
            b += 1
        while trials.weight[b + 1] == trials.weight[b]:
            b -= 1  # rounding has led past the last deficit
        within = (target - trials.weight[b]) / (trials.weight[b + 1] - trials.weight[b])
        within = min(max(within, 0.0), 1.0)
        below = laws.cumulative[row, b]
        u = below + within * (laws.cumulative[row, b + 1] - below)
        i = min(int(u * last), last - 1)
        low = laws.quantile[row, i]
        rise = laws.quantile[row, i + 1] - low
        part = u * last - i
        if rise > laws.largest_rise[row]:
            part = round(part)  # nothing between: a gap of the law
        orientation = low + part * rise
        orientation -= 180.0 * math.floor(orientation / 180.0)
        trials.orientation[a] = orientation if orientation < 180.0 else 0.0
        trials.bin[a] = b


@inlined
def turn_and_inflate(supply, particle, clearance, trials, n_angle):
    """Write the particle's hull in every trial orientation, inflated about its centre.

    Returns the node count, the circumradius and the inradius of the inflated hull.
    """
    shape = supply.shape[particle]
    size = supply.size[particle]
    first = supply.hull_offsets[shape]
    count = supply.hull_offsets[shape + 1] - first
    inradius = supply.inradius[shape] * size
    scale = size * (1.0 + clearance / inradius)
    for a in range(n_angle):
        angle = math.radians(trials.orientation[a])
        c = math.cos(angle) * scale
        s = math.sin(angle) * scale
        left = bottom = right = top = 0.0
        for i in range(count):
            x = c * supply.hull_nodes[first + i, 0] - s * supply.hull_nodes[first + i, 1]
            y = s * supply.hull_nodes[first + i, 0] + c * supply.hull_nodes[first + i, 1]
            trials.nodes[a * count + i, 0] = x
            trials.nodes[a * count + i, 1] = y
            left = min(left, x)
            right = max(right, x)
            bottom = min(bottom, y)
            top = max(top, y)
        trials.reach[a, 0] = -left
        trials.reach[a, 1] = -bottom
        trials.reach[a, 2] = right
        trials.reach[a, 3] = top
    return count, supply.circumradius[shape] * scale, supply.inradius[shape] * scale
