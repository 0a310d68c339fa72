"""All cases of the stability matrix, in groups."""

from __future__ import annotations

from dataclasses import replace

from grainfront.studies.stability.case import MODERATE, Case
from grainfront.studies.stability.cases import domains, efforts, orientations, shapes, sizes, walls

GROUPS = {
    "shapes": shapes.CASES,
    "sizes": sizes.CASES,
    "orientations": orientations.CASES,
    "domains": domains.CASES,
    "walls": walls.CASES,
    "efforts": efforts.CASES,
}
CASES: dict[str, Case] = {MODERATE.name: MODERATE} | {
    case.name: replace(case, group=group) for group, cases in GROUPS.items() for case in cases
}
"""The cases by name, the moderate one, with which they are compared, first."""
