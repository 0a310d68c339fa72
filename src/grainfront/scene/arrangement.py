"""The arrangement of a scene: from YAML to regions, their zones and their laws."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from grainfront.arrangement import zones
from grainfront.arrangement.regions import (
    Arrangement,
    Grade,
    GradedAlong,
    GradedByDistance,
    LocalLaws,
    Region,
)
from grainfront.arrangement.zones import Zone
from grainfront.errors import InputError
from grainfront.laws import Law, Truncated, require_possible
from grainfront.scene.laws import law_of, matched_of

# Finds the file of a given name, told under a given key.
Find = Callable[[str, str], str]

OPERATIONS: dict[str, Callable[..., Zone]] = {
    "union": zones.Union,
    "intersection": zones.Intersection,
    "difference": zones.Difference,
}
PRIMITIVES: dict[str, Callable[..., Zone]] = {
    "circle": zones.Circle,
    "rectangle": zones.Box,
    "polygon": zones.Polygon,
    "half_plane": zones.HalfPlane,
    "bars": zones.Bars,
    "silhouette": zones.Silhouette,
    "file": zones.PolygonsFile,
}
MODIFIERS = ("scale", "rotate", "translate", "offset")
PARTS = ("finer_than", "coarser_than")


def arrangement_of(data: dict[str, Any], scene_laws: LocalLaws, find: Find) -> Arrangement:
    """The arrangement that a scene describes; `scene_laws` hold where no region does.

    Raises InputError, naming the key, where a region asks for the impossible.
    """
    keys = [f"arrangement.regions[{i}]" for i in range(len(data["regions"]))]
    regions = tuple(
        _region(one, key, scene_laws, find) for one, key in zip(data["regions"], keys, strict=True)
    )
    return Arrangement(regions, _critical_size(data["regions"], scene_laws.size))


def _region(data: dict[str, Any], key: str, scene_laws: LocalLaws, find: Find) -> Region:
    inside = zone_of(data["inside"], f"{key}.inside", find) if "inside" in data else None
    laws = _local_laws(data, key, scene_laws)
    size = data.get("size", {})
    finer = "finer_than" in size if any(part in size for part in PARTS) else None
    if "graded" not in data:
        if laws == LocalLaws() and finer is None:
            raise InputError(
                f"{key} gives no law, but must give one at least of size, aspect_ratio, "
                "circularity, regularity, orientation, graded"
            )
        return Region(inside, (laws,), None, finer)
    described = data["graded"]
    both = set(described["start"]) & set(data)
    if both:
        name = sorted(both)[0]
        raise InputError(f"{key}.{name} is given, but {key}.graded gives that law already")
    matched_of({**data, **described["start"]}, f"{key}.")
    grade = _grade(described, f"{key}.graded", inside)
    strata = _strata(described, f"{key}.graded", laws, scene_laws)
    return Region(inside, strata, grade, finer)


def zone_of(data: dict[str, Any], key: str, find: Find) -> Zone:
    """The zone that is described under `key`, with its modifiers."""
    given = [name for name in data if name not in MODIFIERS]
    if len(given) != 1:
        raise InputError(
            f"{key} has {'the keys ' + ', '.join(given) if given else 'no zone'}, but must have "
            f"exactly one of {', '.join([*PRIMITIVES, *OPERATIONS])}"
        )
    name, described = given[0], data[given[0]]
    if name in OPERATIONS:
        parts = (zone_of(one, f"{key}.{name}[{i}]", find) for i, one in enumerate(described))
        zone = OPERATIONS[name](tuple(parts))
    else:
        zone = _primitive(name, described, f"{key}.{name}", find)
    return _modified(zone, data)


def _primitive(name: str, data: dict[str, Any], key: str, find: Find) -> Zone:
    parameters = {parameter: _tuples(value) for parameter, value in data.items()}
    if "path" in parameters:
        parameters["path"] = find(data["path"], f"{key}.path")
    if name == "silhouette" and ("width" in data) == ("height" in data):
        found = "both width and height" if "width" in data else "neither width nor height"
        raise InputError(f"{key} gives {found}, but must give exactly one of them")
    if name == "bars" and data["spacing"] <= data["width"]:
        raise InputError(
            f"{key}.spacing is {data['spacing']:g}, but must be greater than the width, "
            f"{data['width']:g}"
        )
    if name == "half_plane" and not any(data["normal"]):
        raise InputError(f"{key}.normal is [0, 0], but must have a direction")
    return PRIMITIVES[name](**parameters)


def _modified(zone: Zone, data: dict[str, Any]) -> Zone:
    if "scale" in data:
        about = _tuples(data["scale"]["about"])
        zone = zones.Moved(zone, scale=float(data["scale"]["factor"]), about=about)
    if "rotate" in data:
        about = _tuples(data["rotate"]["about"])
        zone = zones.Moved(zone, angle=float(data["rotate"]["angle"]), about=about)
    if "translate" in data:
        zone = zones.Moved(zone, shift=_tuples(data["translate"]))
    if "offset" in data:
        zone = zones.Offset(zone, float(data["offset"]))
    return zone


def _tuples(value: Any) -> Any:
    """Lists as tuples at every depth, numbers in them as floats."""
    if isinstance(value, list):
        return tuple(_tuples(v) for v in value)
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _local_laws(data: dict[str, Any], key: str, scene_laws: LocalLaws) -> LocalLaws:
    """The laws that a region, or an end of its grade, gives."""
    name = matched_of(data, f"{key}.")
    own = scene_laws.matched
    if name and own and name != own[0]:
        raise InputError(
            f"{key}.{name} is given, but the scene has a law of {own[0]}, and a shape cannot "
            "follow two laws at once"
        )
    size, orientation = (
        _local_law(quantity, data, key, getattr(scene_laws, quantity))
        for quantity in ("size", "orientation")
    )
    if not name:
        return LocalLaws(size, None, orientation)
    matched = _local_law(name, data, key, own[1] if own else None)
    assert matched is not None, "only a size has a finer and a coarser part"
    return LocalLaws(size, (name, matched), orientation)


def _local_law(quantity: str, data: dict[str, Any], key: str, own: Law | None) -> Law | None:
    described, key = data.get(quantity, {}), f"{key}.{quantity}"
    if not described or any(part in described for part in PARTS):
        return None
    if "truncated" not in described:
        return law_of(quantity, described, key)
    if own is None:
        raise InputError(f"{key}.truncated is given, but the scene has no law of {quantity} to cut")
    if not described["truncated"]:
        raise InputError(f"{key}.truncated has no key, but must have minimum, maximum or both")
    try:
        law = Truncated(own, **described["truncated"])
        require_possible(law, quantity)
    except InputError as error:
        raise InputError(f"{key}.truncated: {error}") from None
    return law


def _critical_size(regions: list[dict[str, Any]], size: Law | None) -> float | None:
    """The size that parts the scene's law, the same one in all regions; None for auto."""
    given = [
        (f"arrangement.regions[{i}].size.{part}", region["size"][part])
        for i, region in enumerate(regions)
        for part in PARTS
        if part in region.get("size", {})
    ]
    for key, value in given:
        if value != given[0][1]:
            raise InputError(f"{key} is {value}, but must be {given[0][1]}, as in {given[0][0]}")
        if value != "auto":
            assert size is not None, "every scene has a law of size"
            low, high = size.support
            if not low < value < high:
                raise InputError(
                    f"{key} is {value:g}, but must lie within the scene's sizes, from {low:g} to "
                    f"{high:g}"
                )
    return None if not given or given[0][1] == "auto" else float(given[0][1])


def _grade(data: dict[str, Any], key: str, inside: Zone | None) -> Grade:
    if ("points" in data) == ("distances" in data):
        found = "both points and distances" if "points" in data else "neither points nor distances"
        raise InputError(f"{key} gives {found}, but must give exactly one of them")
    name = "points" if "points" in data else "distances"
    start, end = _tuples(data[name])
    if start == end:
        raise InputError(f"{key}.{name} are {data[name]}, but must differ")
    if name == "points":
        return GradedAlong(start, end)
    if inside is None:
        raise InputError(f"{key}.distances are given, but there is no inside to measure them from")
    return GradedByDistance(start, end)


def _strata(
    data: dict[str, Any], key: str, laws: LocalLaws, scene_laws: LocalLaws
) -> tuple[LocalLaws, ...]:
    """The laws of all strata: those between start and end, and those of the region for the rest."""
    start, end, levels = data["start"], data["end"], int(data["levels"])
    if {k: list(v) for k, v in start.items()} != {k: list(v) for k, v in end.items()}:
        raise InputError(
            f"{key}.start and {key}.end must give laws of the same quantities and kinds"
        )
    strata = []
    for i in range(levels):
        between = _between(start, end, (i + 0.5) / levels, key)
        own = _local_laws(between, key, scene_laws)
        strata.append(
            LocalLaws(
                own.size or laws.size, own.matched or laws.matched,
                own.orientation or laws.orientation,
            )
        )  # fmt: skip
    return tuple(strata)


def _between(start: Any, end: Any, share: float, key: str) -> Any:
    """Parameters the given share of the way from those at the start to those at the end."""
    if isinstance(start, dict) and isinstance(end, dict) and set(start) == set(end):
        return {k: _between(start[k], end[k], share, f"{key}.{k}") for k in start}
    if isinstance(start, list) and isinstance(end, list) and len(start) == len(end):
        pairs = zip(start, end, strict=True)
        return [_between(a, b, share, f"{key}[{i}]") for i, (a, b) in enumerate(pairs)]
    if isinstance(start, (int, float)) and isinstance(end, (int, float)):
        return start + (end - start) * share
    raise InputError(f"{key} must have the same parameters at the start and at the end")
