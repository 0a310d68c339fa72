"""The stages of the workflow, from files to files; each is one rule, called with keywords.

Every result is written under a temporary name and renamed at the end. Faults of the input, and a
certificate that does not hold, end the job with one sentence.
"""

from grainfront.stages.error_vs_time import error_vs_time, error_vs_time_picture
from grainfront.stages.packing import kernels, packing, packing_to_target, replacement, shapes, vtk
from grainfront.stages.results import (
    arrangement_picture,
    contacts,
    figures,
    photograph,
    statistics,
)
from grainfront.stages.sources import SOURCES, sources_digest
from grainfront.stages.stability import stability, stability_report
from grainfront.stages.sweep import contour, contour_picture, sweep

__all__ = [
    "SOURCES",
    "arrangement_picture",
    "contacts",
    "contour",
    "contour_picture",
    "error_vs_time",
    "error_vs_time_picture",
    "figures",
    "kernels",
    "packing",
    "packing_to_target",
    "photograph",
    "replacement",
    "shapes",
    "sources_digest",
    "stability",
    "stability_report",
    "statistics",
    "sweep",
    "vtk",
]
