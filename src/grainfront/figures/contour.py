"""The volume fraction over the effort of the packing (Du et al. 2023, Figs. 16 and 18)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from grainfront.figures.style import INK, MM, PLACED, PRESCRIBED, styled

N_LEVELS = 12
# Bright throughout, so that dark lines, labels and hatches are read everywhere.
COLOURS = LinearSegmentedColormap.from_list("bright", ["#fdfdf0", "#bfe3dc", "#62a8d0"])
N_ANGLE, N_LOC = r"$n_\mathrm{angle}$", r"$n_\mathrm{loc}$"
AXES_LABELS = f"trial orientations {N_ANGLE}", f"half-size of the local front {N_LOC}"


@styled
def contour(
    n_angle: np.ndarray,
    n_loc: np.ndarray,
    volume_fraction: np.ndarray,
    *,
    seeds: int,
    target: float | None,
) -> Figure:
    """A map of the volume fraction with its extremes and, hatched, what reaches the target.

    `n_angle` (n,) and `n_loc` (m,) ascend; `volume_fraction` (n, m) is the mean over so many
    seeds. Effort counts by its ratios, so that both axes are logarithmic. Where one of them has a
    single value, a curve over the other takes the place of the map.
    """
    figure = Figure(figsize=(120 * MM, 96 * MM))
    axes = figure.subplots()
    if n_angle.size > 1 and n_loc.size > 1:
        _draw_map(figure, axes, n_angle, n_loc, volume_fraction, target)
    else:
        _draw_curve(axes, n_angle, n_loc, volume_fraction, target)
    each = f"mean of {seeds} packings each" if seeds > 1 else "one packing each"
    axes.set_title(f"volume fraction, {each}")
    figure.legend(loc="outside lower left", ncols=1, markerscale=0.8)
    return figure


def _draw_map(
    figure: Figure,
    axes: Axes,
    n_angle: np.ndarray,
    n_loc: np.ndarray,
    volume_fraction: np.ndarray,
    target: float | None,
) -> None:
    x, y, fraction = np.log2(n_angle), np.log2(n_loc), volume_fraction.T
    levels = MaxNLocator(N_LEVELS).tick_values(fraction.min(), fraction.max())
    filled = axes.contourf(x, y, fraction, levels, cmap=COLOURS)
    lines = axes.contour(x, y, fraction, levels, colors=INK, linewidths=0.4)
    for label in axes.clabel(lines, fontsize=6):
        label.set_clip_on(False)
    figure.colorbar(filled, ax=axes, label="volume fraction")
    places = np.meshgrid(x, y, indexing="ij")
    axes.plot(*places, ".", color=INK, markersize=3, clip_on=False)
    _set_ticks(axes, n_angle, n_loc)
    if target is not None and fraction.max() >= target:
        axes.contourf(x, y, fraction, [target, np.inf], colors="none", hatches=["///"])
        axes.contour(x, y, fraction, [target], colors=PRESCRIBED, linewidths=1.6)
    _mark_extremes(axes, n_angle, n_loc, volume_fraction, *places)
    _mark_target(axes, volume_fraction, target)


def _draw_curve(
    axes: Axes,
    n_angle: np.ndarray,
    n_loc: np.ndarray,
    volume_fraction: np.ndarray,
    target: float | None,
) -> None:
    over_loc = n_loc.size > 1
    effort = n_loc if over_loc else n_angle
    x = np.log2(effort).reshape(volume_fraction.shape)
    axes.plot(x.ravel(), volume_fraction.ravel(), "o-", color=PLACED, markersize=4)
    _mark_extremes(axes, n_angle, n_loc, volume_fraction, x, volume_fraction)
    axes.set_xticks(np.log2(effort), [str(n) for n in effort])
    kept = f"{N_ANGLE} = {n_angle[0]}" if over_loc else f"{N_LOC} = {n_loc[0]}"
    axes.set_xlabel(f"{AXES_LABELS[over_loc]}; {kept}")
    axes.set_ylabel("volume fraction")
    if target is not None:
        axes.axhline(target, color=PRESCRIBED)
    _mark_target(axes, volume_fraction, target)


def _set_ticks(axes: Axes, n_angle: np.ndarray, n_loc: np.ndarray) -> None:
    axes.set_xticks(np.log2(n_angle), [str(n) for n in n_angle])
    axes.set_yticks(np.log2(n_loc), [str(n) for n in n_loc])
    axes.set_xlabel(AXES_LABELS[0])
    axes.set_ylabel(AXES_LABELS[1])


def _mark_extremes(
    axes: Axes,
    n_angle: np.ndarray,
    n_loc: np.ndarray,
    volume_fraction: np.ndarray,
    x: np.ndarray,
    y: np.ndarray,
) -> None:
    """Mark the least and the largest fraction at their places `x` and `y`, (n, m) each."""
    for name, marker, found in (("lower", "v", np.argmin), ("upper", "^", np.argmax)):
        i, j = np.unravel_index(found(volume_fraction), volume_fraction.shape)
        axes.plot(
            x[i, j], y[i, j], marker, color=PRESCRIBED, markeredgecolor="white", markersize=8,
            clip_on=False, linestyle="none",
            label=rf"$V_\mathrm{{{name}}}$ = {volume_fraction[i, j]:.4f} at {N_ANGLE} ="
            f" {n_angle[i]}, {N_LOC} = {n_loc[j]}",
        )  # fmt: skip


def _mark_target(axes: Axes, volume_fraction: np.ndarray, target: float | None) -> None:
    if target is not None:
        reached = "" if volume_fraction.max() >= target else " (not reached)"
        axes.plot([], [], color=PRESCRIBED, label=f"target = {target:g}{reached}")
