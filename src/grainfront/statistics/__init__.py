"""Statistics of a packing: fractions, contacts, prescribed against placed, segregation."""

from grainfront.particles import CONTACT_TOLERANCE
from grainfront.statistics.contacts import Contacts, find_contacts
from grainfront.statistics.distributions import (
    N_BIN,
    Distribution,
    OrientationRose,
    compare_with_law,
    l2_error,
    orientation_rose,
)
from grainfront.statistics.fractions import (
    Rooms,
    find_rooms,
    void_ratio,
    volume_fraction,
    volume_fraction_between,
    volume_fraction_bulk,
)
from grainfront.statistics.segregation import SizeCorrelation, size_correlation
from grainfront.statistics.summary import PackingStatistics, measure

__all__ = [
    "CONTACT_TOLERANCE",
    "N_BIN",
    "Contacts",
    "Distribution",
    "OrientationRose",
    "PackingStatistics",
    "Rooms",
    "SizeCorrelation",
    "compare_with_law",
    "find_contacts",
    "find_rooms",
    "l2_error",
    "measure",
    "orientation_rose",
    "size_correlation",
    "void_ratio",
    "volume_fraction",
    "volume_fraction_between",
    "volume_fraction_bulk",
]
