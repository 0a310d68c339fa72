"""Domain and packing: the plain data types that the stages after `shapes` hand on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from grainfront.polygons import Polygons

CONTACT_TOLERANCE = 1e-6
"""Largest gap of a contact, in mean sizes.

Far above the gaps that packing leaves on purpose against rounding (about 1e-14 of the domain), far
below the distance of neighbours that do not touch.
"""


@dataclass(frozen=True)
class Rectangle:
    """A rectangular domain, [x_min, x_max] × [y_min, y_max], in the scene's length unit."""

    x_min: float
    y_min: float
    x_max: float
    y_max: float

    @property
    def width(self) -> float:
        return self.x_max - self.x_min

    @property
    def height(self) -> float:
        return self.y_max - self.y_min

    @property
    def area(self) -> float:
        return self.width * self.height


@dataclass(frozen=True)
class Packing:
    """Placed particles, in order of placement; arrays have shape (n_particles,).

    Lengths are in the scene's unit, `orientation` in degrees in [0, 180); (`x`, `y`) are centroids
    of the hulls. `polygons` are the hulls as packed or, after the replacement, the outlines; `area`
    and `circumradius` (about (x, y)) are theirs. `shape` indexes the shape database. `left_over`
    counts the particles that were drawn but found no place. `region` is the region of the scene's
    arrangement that a particle was drawn for, −1 for the rest of the domain; None without regions.
    """

    domain: Rectangle
    polygons: Polygons
    x: np.ndarray
    y: np.ndarray
    size: np.ndarray
    aspect_ratio: np.ndarray
    orientation: np.ndarray
    area: np.ndarray
    circumradius: np.ndarray
    shape: np.ndarray
    left_over: int
    region: np.ndarray | None = None
