"""Work-precision diagrams: errors against the run time they cost, a picture for each axis."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from matplotlib.figure import Figure

from grainfront.figures.error_vs_time.checks import draw_checks
from grainfront.figures.error_vs_time.domain import draw_domain
from grainfront.figures.error_vs_time.drawing import draw_drawing
from grainfront.figures.error_vs_time.effort import draw_effort
from grainfront.figures.error_vs_time.outlines import draw_outlines
from grainfront.figures.error_vs_time.target import draw_target
from grainfront.figures.style import styled

Quantities = Mapping[str, np.ndarray]

AXES: dict[str, Callable[[Figure, Quantities], None]] = {
    "effort": draw_effort,
    "outlines": draw_outlines,
    "drawing": draw_drawing,
    "domain": draw_domain,
    "target": draw_target,
    "checks": draw_checks,
}


@styled
def error_vs_time(axis: str, quantities: Quantities) -> Figure:
    """The picture of one axis, from its quantities as `files.error_vs_time` names them.

    Marks stand at medians over seeds and repeats, bars span least to largest.
    """
    figure = Figure()
    AXES[axis](figure, quantities)
    return figure
