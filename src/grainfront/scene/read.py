"""Reading scene files, the only configuration there is: from YAML to a `Scene`."""

from __future__ import annotations

import json
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from grainfront.checked_yaml import parse_checked, read_text
from grainfront.errors import InputError
from grainfront.image_files import SHIPPED
from grainfront.laws import Law
from grainfront.scene.domain import domain_of, require_room
from grainfront.scene.laws import law_of, matched_of
from grainfront.scene.scene import ErrorVsTime, PackingEffort, Scene, Sweep, Target
from grainfront.shapes import sources
from grainfront.shapes.sources import ShapeSource

if TYPE_CHECKING:
    from grainfront.arrangement.regions import Arrangement
    from grainfront.scene.arrangement import Find

T = TypeVar("T")

IMAGES: dict[str, Callable[..., ShapeSource]] = {
    "photographs": sources.Photographs,
    "binary_masks": sources.BinaryMasks,
    "label_masks": sources.LabelMasks,
}
FAMILIES: dict[str, Callable[..., ShapeSource]] = {
    "rectangle": sources.Rectangles,
    "regular_polygon": sources.RegularPolygon,
    "random_convex_polygon": sources.RandomConvexPolygons,
    "fourier_grain": sources.FourierGrains,
}


def scene_schema() -> dict[str, Any]:
    """The JSON Schema of scene files, as installed with the package."""
    return json.loads((files("grainfront.scene") / "scene.schema.json").read_text(encoding="utf-8"))


def load_scene(path: str | Path) -> Scene:
    """Read and check a scene file; image and outline paths in it are relative to it.

    Raises InputError, one sentence naming file, key, value and what is allowed, where the file
    cannot be read, breaks the schema, names a file that does not exist, or asks for the impossible.
    """
    path = Path(path)
    text = read_text(path)
    data = parse_checked(text, scene_schema(), str(path))
    try:
        return _scene(path, text, data)
    except InputError as error:
        raise InputError(f"{path}: {error}.") from None


def _scene(path: Path, text: str, data: dict[str, Any]) -> Scene:
    def find(name: str, key: str) -> str:
        return _found(name, path.parent, key)

    domain, domain_files = domain_of(data, find)
    size = law_of("size", data["size"], "size")
    require_room(domain, size)
    orientation = law_of("orientation", data["orientation"], "orientation")
    matched = _matched(data)
    seeds = _seeds(data)
    _require_seeds(seeds[0], data)
    return Scene(
        name=path.stem,
        text=text,
        length_unit=data["length_unit"],
        seeds=seeds,
        domain=domain,
        shapes=_shapes(data["shapes"], path.parent),
        size=size,
        matched=matched,
        orientation=orientation,
        packing=PackingEffort(**data["packing"]),
        target=_target(data),
        sweep=_part(Sweep, "sweep", data),
        error_vs_time=_part(ErrorVsTime, "error_vs_time", data),
        replacement=data["replacement"],
        outputs=tuple(data["outputs"]),
        arrangement=_arrangement(data, size, matched, orientation, find),
        domain_files=domain_files,
    )


def _seeds(data: dict[str, Any]) -> tuple[int, ...]:
    if ("seed" in data) == ("seeds" in data):
        found = "both seed and seeds are" if "seed" in data else "neither seed nor seeds is"
        raise InputError(f"{found} given, but there must be exactly one of them")
    return tuple(int(seed) for seed in data.get("seeds", [data.get("seed")]))


def _require_seeds(first: int, data: dict[str, Any]) -> None:
    """Raise InputError where seeds that count up from the first leave the range of seeds."""
    largest = scene_schema()["properties"]["seed"]["maximum"]
    for key in ("sweep", "error_vs_time"):
        number = data[key]["seeds"] if key in data else 1
        if first + number - 1 > largest:
            raise InputError(
                f"{key}.seeds is {number:g}, but they count up from the scene's first, {first}, "
                f"and seeds must be at most {largest}"
            )


def _matched(data: dict[str, Any]) -> tuple[str, Law] | None:
    name = matched_of(data)
    return (name, law_of(name, data[name], name)) if name else None


def _arrangement(
    data: dict[str, Any], size: Law, matched: tuple[str, Law] | None, orientation: Law, find: Find
) -> Arrangement | None:
    if "arrangement" not in data:
        return None
    from grainfront.arrangement.regions import LocalLaws
    from grainfront.scene.arrangement import arrangement_of

    return arrangement_of(data["arrangement"], LocalLaws(size, matched, orientation), find)


def _target(data: dict[str, Any]) -> Target | None:
    if "target_volume_fraction" not in data:
        return None
    return Target(float(data["target_volume_fraction"]), float(data["target_tolerance"]))


def _part(kind: Callable[..., T], key: str, data: dict[str, Any]) -> T | None:
    """An optional part of the scene; JSON Schema lets 24.0 pass for a whole number in a list."""
    if key not in data:
        return None
    return kind(**{name: _whole(value) for name, value in _frozen(data[key]).items()})


def _whole(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(map(_whole, value))
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _shapes(data: dict[str, Any], folder: Path) -> ShapeSource:
    ((kind, parameters),) = data.items()
    if kind == "family":
        ((family, descriptors),) = parameters.items()
        if family == "rectangle":
            _require_ordered(descriptors["aspect_ratio"])
        return FAMILIES[family](**_frozen(descriptors))
    if kind == "outlines_file":
        return sources.OutlinesFile(_found(parameters["path"], folder, f"shapes.{kind}.path"))
    parameters = dict(parameters)
    parameters["paths"] = [
        _found(name, folder, f"shapes.{kind}.paths[{i}]")
        for i, name in enumerate(parameters["paths"])
    ]
    if "segmentation" in parameters:
        parameters["segmentation"] = _segmentation(parameters["segmentation"])
    return IMAGES[kind](**_frozen(parameters))


def _require_ordered(aspect_ratio: list[float]) -> None:
    least, largest = aspect_ratio
    if least > largest:
        raise InputError(
            f"shapes.family.rectangle.aspect_ratio is {aspect_ratio}, but must go from the least "
            "to the largest"
        )


def _segmentation(data: dict[str, Any]) -> sources.Segmentation:
    if data["block_size"] % 2 == 0:
        raise InputError(
            f"shapes.photographs.segmentation.block_size is {data['block_size']}, "
            "but must be an odd number"
        )
    return sources.Segmentation(**data)


def _found(name: str, folder: Path, key: str) -> str:
    """The path of a file named in the scene, checked to be there."""
    if name.startswith(SHIPPED):
        return name
    path = folder / name
    if not path.is_file():
        raise InputError(f"{key} is '{name}', but must be a file, and there is none at {path}")
    return str(path)


def _frozen(parameters: dict[str, Any]) -> dict[str, Any]:
    """Parameters with tuples for lists, as frozen dataclasses hold them."""
    return {key: tuple(v) if isinstance(v, list) else v for key, v in parameters.items()}
