"""Families of shapes that need no image."""

from __future__ import annotations

import numpy as np
import shapely

from grainfront.errors import InputError
from grainfront.polygons import Polygons
from grainfront.shapes.sources import (
    FourierGrains,
    RandomConvexPolygons,
    Rectangles,
    RegularPolygon,
)

# A spectrum that crosses itself more often than this, on average, is not one of grains.
TRIALS_PER_GRAIN = 100
# Mollon & Zhao (2012) keep 64 modes; more than half the nodes cannot carry a mode.
FOURIER_MODES = 64
# A database of more nodes is refused: each takes up to 220 bytes while it is built, 4.4 GB in all.
MOST_NODES = 2 * 10**7


def rectangles(family: Rectangles) -> Polygons:
    """Rectangles of width 1, aspect ratios evenly spaced over the range; one if it is a point."""
    low, high = family.aspect_ratio
    if not (1.0 <= low <= high < np.inf):
        raise InputError(
            f"rectangles: aspect_ratio is [{low}, {high}]; allowed is 1 ≤ lowest ≤ highest."
        )
    _at_least(1, family.count, "rectangles: count")
    ratios = [low] if low == high else np.linspace(low, high, family.count)
    return Polygons.of(
        [0.5 * np.array([[-r, -1.0], [r, -1.0], [r, 1.0], [-r, 1.0]]) for r in ratios]
    )


def regular_polygon(family: RegularPolygon) -> Polygons:
    """The regular polygon of circumradius 1, one edge at the bottom."""
    _at_least(3, family.vertices, "regular polygon: vertices")
    angle = 2.0 * np.pi * (np.arange(family.vertices) - 0.5) / family.vertices - np.pi / 2.0
    return Polygons.of([np.column_stack([np.cos(angle), np.sin(angle)])])


def random_convex_polygons(family: RandomConvexPolygons, rng: np.random.Generator) -> Polygons:
    """Random convex polygons of exactly so many vertices, uniform in the square (Valtr 1995).

    Valtr, P. (1995), Probability that n random points are in convex position, Discrete &
    Computational Geometry 13: sorted random abscissae and ordinates, each split at random into two
    chains, give the components of edges that sum to zero; paired at random and sorted by direction
    they close.
    """
    _at_least(3, family.vertices, "random convex polygons: vertices")
    _at_least(1, family.count, "random convex polygons: count")
    _require_memory(family, "random convex polygons")
    return Polygons.of([_valtr(family.vertices, rng) for _ in range(family.count)])


def _valtr(n: int, rng: np.random.Generator) -> np.ndarray:
    edges = np.column_stack([_closed_steps(n, rng), rng.permutation(_closed_steps(n, rng))])
    order = np.argsort(np.arctan2(edges[:, 1], edges[:, 0]))
    return np.cumsum(edges[order], axis=0)


def _closed_steps(n: int, rng: np.random.Generator) -> np.ndarray:
    """n steps that sum to zero: from the least of n random numbers to the largest, and back."""
    values = np.sort(rng.random(n))
    forward = rng.random(n - 2) < 0.5
    up = np.concatenate([values[:1], values[1:-1][forward], values[-1:]])
    down = np.concatenate([values[:1], values[1:-1][~forward], values[-1:]])
    return np.concatenate([np.diff(up), -np.diff(down)])


def fourier_grains(family: FourierGrains, rng: np.random.Generator) -> tuple[Polygons, int]:
    """Outlines from a Fourier spectrum of the radius, random phases; and how many were rejected.

    After Mollon & Zhao (2012, doi 10.1007/s10035-012-0356-x): r(θ) = 1 + Σ A_n cos(nθ + δ_n) with
    A_1 = 0, A_2 = d2, A_n = d3·(n/3)^−decay_3_8 for 3 ≤ n < 8, A_n = d8·(n/8)^−decay_8_up from 8
    on, and uniform phases δ_n. Outlines that cross themselves (radius not positive) are drawn
    again. Raises InputError where nearly all do.
    """
    _at_least(3, family.vertices, "Fourier grains: vertices")
    _at_least(1, family.count, "Fourier grains: count")
    _require_memory(family, "Fourier grains")
    spectrum = _spectrum(family)
    angle = 2.0 * np.pi * np.arange(family.vertices) / family.vertices
    kept: list[np.ndarray] = []
    rejected = 0
    while len(kept) < family.count:
        phase = rng.uniform(0.0, 2.0 * np.pi, spectrum.size)
        modes = np.arange(spectrum.size)[:, None] * angle + phase[:, None]
        radius = 1.0 + spectrum @ np.cos(modes)
        outline = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
        if radius.min() > 0.0 and shapely.Polygon(outline).is_valid:
            kept.append(outline)
            continue
        rejected += 1
        if rejected > TRIALS_PER_GRAIN * family.count:
            raise InputError(
                f"Fourier grains: d2 = {family.d2}, d3 = {family.d3}, d8 = {family.d8} make nearly "
                "every outline cross itself; smaller amplitudes are allowed."
            )
    return Polygons.of(kept), rejected


def _spectrum(family: FourierGrains) -> np.ndarray:
    amplitudes = (family.d2, family.d3, family.d8)
    if not (np.isfinite(amplitudes).all() and min(amplitudes) >= 0.0):
        raise InputError(f"Fourier grains: d2, d3, d8 are {amplitudes}; allowed are numbers ≥ 0.")
    mode = np.arange(min(FOURIER_MODES, family.vertices // 2) + 1, dtype=np.float64)
    spectrum = np.zeros(mode.size)
    low, high = (mode >= 3) & (mode < 8), mode >= 8
    spectrum[mode == 2] = family.d2
    spectrum[low] = family.d3 * (mode[low] / 3.0) ** -family.decay_3_8
    spectrum[high] = family.d8 * (mode[high] / 8.0) ** -family.decay_8_up
    return spectrum


def _at_least(least: int, found: int, what: str) -> None:
    if found < least:
        raise InputError(f"{what} is {found}; allowed are whole numbers from {least} on.")


def _require_memory(family: RandomConvexPolygons | FourierGrains, what: str) -> None:
    nodes = family.vertices * family.count
    if nodes > MOST_NODES:
        raise InputError(
            f"{what}: {family.count:,} shapes of {family.vertices:,} vertices have {nodes:,} nodes "
            f"in all; allowed are {MOST_NODES:,} at most."
        )
