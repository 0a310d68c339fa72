"""Particles before they are placed: which shape of the database, and of which size.

Source: Du, Liu, Han, Deng (2023), doi 10.1016/j.jrmge.2022.03.009, Pseudocode 1: draw the size and
the descriptor, then pick at random among the shapes of the database closest in the descriptor.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from grainfront.errors import InputError
from grainfront.laws import Law, bin_of, stratified

# Shapes among which one is picked at random: enough for variety, few enough to stay close.
CLOSEST_SHAPES = 5


class Coverage(NamedTuple):
    """How far a shape database can follow the law of a descriptor.

    `shapes_per_bin` int64 (n_bin,); `empty_bins` counts the bins without any shape, and
    `empty_probability` adds up their prescribed probabilities: that share of the particles gets
    the closest shapes from other bins instead, and the distribution departs from the law by it.
    """

    shapes_per_bin: np.ndarray
    empty_bins: int
    empty_probability: float


def coverage(descriptor: np.ndarray, law: Law, n_bin: int = 24) -> Coverage:
    """Compare the `descriptor` (n_shapes,) of a database with the bins of the law it is to follow.

    Report it wherever `draw_particles` matches that law: a shortfall is never silent. Raises
    InputError where all shapes lie beyond the same end of the law.
    """
    edges, probabilities = law.bins(n_bin)
    _require_reached(np.asarray(descriptor), edges)
    index = bin_of(edges, descriptor)
    inside = (index >= 0) & (index < probabilities.size)
    shapes_per_bin = np.bincount(index[inside], minlength=probabilities.size)
    # a bin that the law itself leaves empty needs no shape
    empty = (shapes_per_bin == 0) & (probabilities > 0)
    return Coverage(shapes_per_bin, int(empty.sum()), float(probabilities[empty].sum()))


def draw_particles(
    shape_count: int,
    size_law: Law,
    n: int,
    rng: np.random.Generator,
    matched: tuple[np.ndarray, Law] | None = None,
    n_bin: int = 24,
) -> tuple[np.ndarray, np.ndarray]:
    """Draw `n` particles: shapes, int64 (n,), and sizes in the law's unit, float64 (n,).

    `matched` is a descriptor of the database's shapes, (shape_count,), and the law it is to follow;
    without it every shape is drawn equally often, in random order. Raises InputError where no
    shape has a finite descriptor (the regularity of a convex outline is infinite), and where all
    shapes lie beyond the same end of the law.
    """
    size_rng, descriptor_rng, shape_rng = rng.spawn(3)
    size = stratified(size_law, n, size_rng)
    if matched is None:
        return _every_shape_equally_often(shape_count, n, shape_rng), size
    descriptor, law = matched
    wanted = stratified(law, n, descriptor_rng)
    edges, _ = law.bins(n_bin)
    return closest_shapes(np.asarray(descriptor), wanted, edges, shape_rng), size


def closest_shapes(
    descriptor: np.ndarray, wanted: np.ndarray, edges: np.ndarray, rng: np.random.Generator
) -> np.ndarray:
    """Pick for each wanted value, (n,), one of the closest shapes at random: int64 (n,).

    The choice is among the CLOSEST_SHAPES closest in the bin of the wanted value, so that the bins
    (`edges`, n_bin + 1) fill as wanted; where that bin has no shape, among the closest of all.
    """
    _require_reached(descriptor, edges)
    usable = np.flatnonzero(np.isfinite(descriptor))
    shape = usable[np.argsort(descriptor[usable], kind="stable")]
    value = descriptor[shape]
    first, last = _range_to_choose_from(bin_of(edges, value), bin_of(edges, wanted), shape.size)
    start, stop = _grow_to_closest(value, wanted, first, last)
    return shape[rng.integers(start, stop)]


def _require_reached(descriptor: np.ndarray, edges: np.ndarray) -> None:
    """Raise InputError where the law of these bins lies apart from all shapes."""
    value = descriptor[np.isfinite(descriptor)]
    if value.size == 0:
        raise InputError(
            "none of the shapes has a finite value of the descriptor that is to follow the law "
            "(the regularity of a convex outline is infinite)"
        )
    index = bin_of(edges, value)
    if (index < 0).all() or (index >= edges.size - 1).all():
        raise InputError(
            f"the law goes from {edges[0]:.6g} to {edges[-1]:.6g}, but must meet the values of the "
            f"shapes, which go from {value.min():.6g} to {value.max():.6g}"
        )


def _range_to_choose_from(
    bin_of_shape: np.ndarray, bin_wanted: np.ndarray, n_shapes: int
) -> tuple[np.ndarray, np.ndarray]:
    """First and one past the last sorted shape of the wanted bin; of all where the bin is empty."""
    first = np.searchsorted(bin_of_shape, bin_wanted, side="left")
    last = np.searchsorted(bin_of_shape, bin_wanted, side="right")
    empty = first == last
    return np.where(empty, 0, first), np.where(empty, n_shapes, last)


def _grow_to_closest(
    value: np.ndarray, wanted: np.ndarray, first: np.ndarray, last: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Ends of the run of CLOSEST_SHAPES sorted values (or all there are) closest to each wanted."""
    padded = np.concatenate([value, [np.inf]])
    start = np.clip(np.searchsorted(value, wanted), first, last)
    stop = start.copy()
    for _ in range(CLOSEST_SHAPES):
        below = np.where(start > first, np.abs(wanted - padded[start - 1]), np.inf)
        above = np.where(stop < last, np.abs(padded[stop] - wanted), np.inf)
        take_below = (below <= above) & (start > first)
        start = start - take_below
        stop = stop + (~take_below & (stop < last))
    return start, stop


def _every_shape_equally_often(shape_count: int, n: int, rng: np.random.Generator) -> np.ndarray:
    rounds = np.tile(np.arange(shape_count), (-(-n // shape_count), 1))
    return rng.permuted(rounds, axis=1).ravel()[:n]
