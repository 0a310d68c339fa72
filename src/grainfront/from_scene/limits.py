"""What a scene may ask for: refused before it costs anything, with what is allowed."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from grainfront.errors import InputError
from grainfront.scene import Scene

if TYPE_CHECKING:
    from grainfront.particles import Rectangle
    from grainfront.shapes.database import ShapeDatabase

# Bytes that a packing takes up to its certificate and its statistics, at most: for each particle
# drawn and for each node of its hull (measured: 900 for rectangles, 1500 for hulls of 31 nodes).
BYTES_A_PARTICLE, BYTES_A_NODE = 1000, 40
# A grain is at least so many times as wide as the clearance, which is 64 roundings of a coordinate:
# beyond that, rounding would bend its outline.
CLEARANCES_A_GRAIN = 1e3


def _farthest(domain: Rectangle) -> float:
    """The largest coordinate of a domain."""
    return max(map(abs, (domain.x_min, domain.y_min, domain.x_max, domain.y_max)))


def _clearance(scene: Scene) -> float:
    """The clearance that rounding calls for in the domain of a scene."""
    from grainfront.packing.state import CLEARANCE_ULPS

    return CLEARANCE_ULPS * float(np.spacing(1.0)) * _farthest(scene.domain)


def require_resolved(scene: Scene) -> None:
    """Raise InputError where the rounding of coordinates would open the contacts of the grains."""
    from grainfront.particles import CONTACT_TOLERANCE

    # the clearance between placed particles may take up half of a contact's tolerance
    allowed = 0.5 * CONTACT_TOLERANCE * scene.size.moment(1)
    clearance = _clearance(scene)
    if clearance > allowed:
        farthest = _farthest(scene.domain)
        raise InputError(
            f"{scene.name}: domain reaches to a coordinate of {farthest:g}, but must stay within "
            f"{farthest * allowed / clearance:.3g}, beyond which rounding spoils the contacts of "
            "grains of these sizes"
        )


def require_outlined(scene: Scene, size: np.ndarray) -> None:
    """Raise InputError where the rounding of coordinates would bend the smallest outlines."""
    least = CLEARANCES_A_GRAIN * _clearance(scene)
    if size.min() < least:
        raise InputError(
            f"{scene.name}: size: the smallest grain drawn has a size of {size.min():.3g}, but it "
            f"must be at least {least:.3g} in this domain, below which rounding spoils its outline"
        )


def require_memory(scene: Scene, database: ShapeDatabase, n: int) -> None:
    """Raise InputError where `n` particles need more memory than there is, before any is drawn."""
    from grainfront.packing import search_of
    from grainfront.packing.memory import n_bytes

    effort = scene.packing
    needed = n * (BYTES_A_PARTICLE + BYTES_A_NODE * float(database.hulls.node_counts.mean()))
    if search_of(effort.n_angle, effort.n_loc) == "pruned":
        needed += n_bytes(effort.n_angle, effort.n_loc)
    there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if needed > there:
        raise InputError(
            f"{scene.name}: a domain of {scene.domain.width:g} × {scene.domain.height:g} takes "
            f"{n:,} particles of these sizes to fill and, with n_angle {effort.n_angle} and "
            f"n_loc {effort.n_loc}, some {needed / 1e9:,.0f} GB of memory, but this machine has "
            f"{there / 1e9:.3g} GB"
        )
