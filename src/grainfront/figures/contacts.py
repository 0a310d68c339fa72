"""Contacts: how many a particle has, and the network they form."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from grainfront.figures.packing import inside_window, zoom_window
from grainfront.figures.style import (
    BRANCH,
    GRAIN,
    GRAIN_EDGE,
    MM,
    PLACED,
    PRESCRIBED,
    WIDTH,
    map_axes,
    panel_letter,
    styled,
)
from grainfront.figures.walls import draw_walls, with_images
from grainfront.particles import Cell, Packing

if TYPE_CHECKING:
    from grainfront.statistics import Contacts


@styled
def contacts(
    packing: Packing,
    contacts: Contacts,
    contact_shares: np.ndarray,
    coordination_number: float,
    *,
    length_unit: str,
) -> Figure:
    """Shares of the particles by their contacts with the coordination number Z, and the network.

    `contact_shares[k]` is the share of the particles that have k contacts.
    """
    figure = Figure(figsize=(WIDTH, 84 * MM))
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.05))
    _draw_shares(left, contact_shares, coordination_number)
    panel_letter(left, "a", f"{len(contacts.pairs):,} contacts between hulls")
    _draw_network(right, packing, contacts, length_unit)
    panel_letter(right, "b", "closer: lines join centres through contacts")
    return figure


def _draw_shares(axes: Axes, contact_shares: np.ndarray, coordination_number: float) -> None:
    axes.bar(np.arange(contact_shares.size), 100 * contact_shares, width=0.82, color=PLACED)
    axes.axvline(coordination_number, color=PRESCRIBED, linewidth=1)
    axes.annotate(
        f"  Z = {coordination_number:.3f}", (coordination_number, 1.0),
        xycoords=("data", "axes fraction"), va="top", color=PRESCRIBED,
    )  # fmt: skip
    axes.set_ylim(0, 115 * float(contact_shares.max()))
    axes.set_xlabel("contacts of a particle")
    axes.set_ylabel("share of particles (%)")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))


def _draw_network(axes: Axes, packing: Packing, contacts: Contacts, length_unit: str) -> None:
    window = zoom_window(packing)
    whole = with_images(packing)
    grains = [whole.polygons.polygon(i) for i in inside_window(whole, window).tolist()]
    axes.add_collection(
        PolyCollection(grains, facecolors=GRAIN, edgecolors=GRAIN_EDGE, linewidths=0.3),
        autolim=False,
    )
    branches = _branches(packing, contacts)
    low, high = branches.min(axis=1), branches.max(axis=1)
    seen = (high >= [window.x_min, window.y_min]) & (low <= [window.x_max, window.y_max])
    branches = branches[seen.all(axis=1)]
    points = branches[:, 1]
    axes.add_collection(
        LineCollection(list(branches), colors=BRANCH, linewidths=0.6), autolim=False
    )
    axes.scatter(points[:, 0], points[:, 1], s=4, color=PRESCRIBED, linewidths=0, zorder=3)
    draw_walls(axes, packing.domain, window)
    map_axes(axes, window, length_unit)


def _branches(packing: Packing, contacts: Contacts) -> np.ndarray:
    """First centre, contact and second centre of each pair, (n, 3, 2), and those of its images."""
    centres = np.stack([packing.x, packing.y], axis=1)
    first, second = centres[contacts.pairs.T]
    points, domain = contacts.position, packing.domain
    if not isinstance(domain, Cell):
        return np.stack([first, points, second], axis=1)
    # the second particle may touch by an image: the one that is there
    period = np.array([domain.width, domain.height])
    second = second + period * np.rint((points - second) / period)
    own = np.stack([first, points, second], axis=1)
    return np.concatenate([own + shift for shift in domain.shifts])
