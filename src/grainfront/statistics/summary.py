"""All statistics of one packing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from grainfront.errors import InputError
from grainfront.particles import Packing
from grainfront.statistics.contacts import Contacts, find_contacts
from grainfront.statistics.distributions import (
    Distribution,
    OrientationRose,
    compare_with_law,
    orientation_rose,
    wrap_orientation,
)
from grainfront.statistics.fractions import (
    find_rooms,
    void_ratio,
    volume_fraction,
    volume_fraction_bulk,
)
from grainfront.statistics.regions import RegionStatistics
from grainfront.statistics.segregation import SizeCorrelation, size_correlation

Bins = tuple[str | np.ndarray, np.ndarray, np.ndarray]


@dataclass(frozen=True)
class PackingStatistics:
    """What `measure` finds.

    `coordination_number` is Z = 2 × contact pairs / particles, walls not counted.
    `contacts_per_particle` has shape (particles,); `contact_shares[k]` is the share of the
    particles that have k contacts. `wall_contacts` counts pairs of a particle and a wall.
    `distributions` maps the name of each prescribed law to its comparison with what was placed.
    `empty_area` is that of the rooms of the domain that stayed empty (see `find_rooms`).
    `regions` is None for scenes without an arrangement.
    """

    particles: int
    left_over: int
    volume_fraction: float
    volume_fraction_bulk: float
    empty_area: float
    void_ratio: float
    contact_pairs: int
    wall_contacts: int
    coordination_number: float
    contacts_per_particle: np.ndarray
    contact_shares: np.ndarray
    contacts: Contacts
    distributions: dict[str, Distribution]
    orientation_rose: OrientationRose
    size_correlation: SizeCorrelation
    regions: RegionStatistics | None = None


def measure(packing: Packing, laws: Mapping[str, Bins]) -> PackingStatistics:
    """Measure a packing and compare it with the laws it was to follow.

    `laws` maps a name to (values, edges, probabilities): the values to test, shape (n_particles,),
    or the name of a field of the packing that holds them; the edges of the law's bins, shape
    (n + 1,); their probabilities, shape (n,). Orientations, under the name "orientation", are
    compared modulo 180°. Raises InputError for a packing without particles.
    """
    particles = packing.x.size
    if particles == 0:
        raise InputError("A packing without particles has no statistics.")
    distributions = {}
    for name, (values, edges, probabilities) in laws.items():
        placed = getattr(packing, values) if isinstance(values, str) else values
        if name == "orientation":
            placed = wrap_orientation(placed, edges)
        distributions[name] = compare_with_law(placed, edges, probabilities)
    prescribed = laws["orientation"][1:] if "orientation" in laws else ()
    contacts = find_contacts(packing)
    per_particle = contacts.per_particle(particles)
    fraction = volume_fraction(packing)
    return PackingStatistics(
        particles=particles,
        left_over=packing.left_over,
        volume_fraction=fraction,
        volume_fraction_bulk=volume_fraction_bulk(packing),
        empty_area=find_rooms(packing).empty_area,
        void_ratio=void_ratio(fraction),
        contact_pairs=len(contacts.pairs),
        wall_contacts=contacts.wall.size,
        coordination_number=2.0 * len(contacts.pairs) / particles,
        contacts_per_particle=per_particle,
        contact_shares=np.bincount(per_particle) / particles,
        contacts=contacts,
        distributions=distributions,
        orientation_rose=orientation_rose(packing.orientation, *prescribed),
        size_correlation=size_correlation(packing),
    )
