"""The laws of a scene: from YAML to `Law`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from grainfront import laws
from grainfront.errors import InputError
from grainfront.laws import Law

# Descriptors whose law the choice of the shapes may follow.
MATCHED = ("aspect_ratio", "circularity", "regularity")

LAWS: dict[str, Callable[..., Law]] = {
    "uniform": laws.Uniform,
    "normal": laws.Normal,
    "lognormal": laws.Lognormal,
    "weibull": laws.Weibull,
    "gamma": laws.Gamma,
    "exponential": laws.Exponential,
    "beta": laws.Beta,
    "histogram": laws.Histogram,
    "grading_curve": laws.GradingCurve,
}


def law_of(quantity: str, described: dict[str, Any], key: str) -> Law:
    """The law that is described under `key`, checked to be possible for the quantity."""
    ((kind, parameters),) = described.items()
    try:
        law = laws.Constant(parameters) if kind == "constant" else LAWS[kind](**parameters)
        laws.require_possible(law, quantity)
    except InputError as error:
        raise InputError(f"{key}.{kind}: {error}") from None
    return law


def matched_of(data: dict[str, Any], where: str = "") -> str | None:
    """The one descriptor whose law is given, if any; `where` begins the keys in errors."""
    given = [key for key in MATCHED if key in data]
    if len(given) > 1:
        raise InputError(
            f"{' and '.join(where + key for key in given)} are given, but at most one of "
            f"{', '.join(MATCHED)} may be, as a shape cannot follow two laws at once"
        )
    return given[0] if given else None
