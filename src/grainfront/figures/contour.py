"""The volume fraction over the effort of the packing (Du et al. 2023, Figs. 16 and 18)."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from grainfront.figures.style import INK, MM, PLACED, PRESCRIBED, styled

N_LEVELS = 12
# The ends of the map of colours, left out, are too dark and too bright for labels to be read on.
COLOURS = "YlGnBu"
AXES_LABELS = "trial orientations $n_{angle}$", "half-size of the local front $n_{loc}$"


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
    figure.legend(loc="outside lower center", ncols=3)
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
    filled = axes.contourf(x, y, fraction, levels, cmap=COLOURS, alpha=0.9)
    lines = axes.contour(x, y, fraction, levels, colors=INK, linewidths=0.4)
    axes.clabel(lines, fontsize=6)
    figure.colorbar(filled, ax=axes, label="volume fraction")
    axes.plot(*(grid.ravel() for grid in np.meshgrid(x, y)), ".", color=INK, markersize=2.5)
    _set_ticks(axes, n_angle, n_loc)
    if target is not None and fraction.max() >= target:
        axes.contourf(x, y, fraction, [target, np.inf], colors="none", hatches=["////"])
        axes.contour(x, y, fraction, [target], colors=PRESCRIBED, linewidths=1.6)
    _mark_extremes(axes, n_angle, n_loc, volume_fraction, x, y)
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
    axes.plot(np.log2(effort), volume_fraction.ravel(), "o-", color=PLACED, label="packed")
    axes.set_xticks(np.log2(effort), [str(n) for n in effort])
    kept = f"$n_{{angle}}$ = {n_angle[0]}" if over_loc else f"$n_{{loc}}$ = {n_loc[0]}"
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
    extremes = (("lower", "v", np.argmin), ("upper", "^", np.argmax))
    for name, marker, found in extremes:
        i, j = np.unravel_index(found(volume_fraction), volume_fraction.shape)
        axes.plot(
            x[i], y[j], marker, color=PRESCRIBED, markeredgecolor="white", markersize=8,
            clip_on=False, linestyle="none",
            label=f"$V_{{{name}}}$ = {volume_fraction[i, j]:.4f} at {n_angle[i]}, {n_loc[j]}",
        )  # fmt: skip


def _mark_target(axes: Axes, volume_fraction: np.ndarray, target: float | None) -> None:
    if target is not None:
        reached = "" if volume_fraction.max() >= target else " (not reached)"
        axes.plot([], [], color=PRESCRIBED, label=f"target {target:g}{reached}")
