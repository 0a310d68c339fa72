"""The domain of a scene: a rectangle, a rectangle that repeats itself, or what a zone holds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from grainfront.errors import InputError
from grainfront.laws import Law
from grainfront.particles import Cell, Rectangle, Region

if TYPE_CHECKING:
    from grainfront.scene.arrangement import Find

# No particle of size 1 has a smaller inscribed circle than an equilateral triangle: of this radius.
LEAST_INRADIUS = 1.0 / 3.0
# Axes of `error_vs_time` that change the domain, or need a target.
AXES_OF_RECTANGLES = ("domain", "target")


def domain_of(data: dict[str, Any], find: Find) -> tuple[Rectangle, tuple[str, ...]]:
    """The domain that a scene describes, and the files of the user's own that it comes from.

    Raises InputError, naming the key, where it asks for the impossible, and where other parts of
    the scene do not go together with a domain of its kind.
    """
    described = data["domain"]
    domain: Rectangle
    files: set[str] = set()
    if "inside" in described:
        domain, files = _inside(described, find)
    else:
        domain = _rectangle(described)
    if "obstacles" in data:
        path = find(data["obstacles"]["path"], "obstacles.path")
        domain, files = _without(domain, path), files | {path}
    _require_possible_together(domain, data)
    return domain, tuple(sorted(files))


def require_room(domain: Rectangle, size: Law) -> None:
    """Raise InputError where not even the smallest particle has room in the domain."""
    smallest, narrowest = size.support[0], min(domain.width, domain.height)
    if smallest > narrowest:
        raise InputError(
            f"domain has a narrowest side of {narrowest:g}, but it must be at least as wide as the "
            f"smallest grain, of size {smallest:g} (lower end of the size law)"
        )
    if isinstance(domain, Region):
        import shapely

        if shapely.buffer(domain.to_shapely(), -LEAST_INRADIUS * smallest).is_empty:
            raise InputError(
                "domain is nowhere wide enough for the smallest grain, of size "
                f"{smallest:g} (lower end of the size law)"
            )


def _rectangle(data: dict[str, Any]) -> Rectangle:
    for key, other in (("width", "height"), ("height", "width")):
        if key not in data:
            beside = f"beside the {other}" if other in data else "or else what is inside the domain"
            raise InputError(f"domain.{key} is missing, but must be given, {beside}")
    x, y = map(float, data["origin"])
    sides = x, y, x + data["width"], y + data["height"]
    axes = data.get("periodic")
    if axes is None:
        return Rectangle(*sides)
    if "x" not in axes:
        raise InputError(
            f"domain.periodic is {axes}, but must be [x] or [x, y], as grains are placed from the "
            "bottom to the top"
        )
    return Cell(*sides, along_y="y" in axes)


def _inside(data: dict[str, Any], find: Find) -> tuple[Region, set[str]]:
    from grainfront.arrangement.resolve import resolve_bounded
    from grainfront.arrangement.zones import files_of
    from grainfront.scene.arrangement import zone_of

    given = [key for key in ("width", "height") if key in data]
    if given:
        raise InputError(
            f"domain gives both inside and {given[0]}, but must give either inside or width and "
            "height"
        )
    zone = zone_of(data["inside"], "domain.inside", find)
    try:
        return Region.of(resolve_bounded(zone)), files_of(zone)
    except InputError as error:
        raise InputError(f"domain.inside: {_open(error)}") from None


def _without(domain: Rectangle, path: str) -> Region:
    """The domain without the polygons of a file."""
    import shapely

    from grainfront.arrangement.polygons_file import read_polygons

    if isinstance(domain, Cell):
        raise InputError(
            "obstacles are given, but domain.periodic too: a domain that repeats itself has no "
            "obstacles"
        )
    whole = domain if isinstance(domain, Region) else Region.of(shapely.box(*_sides(domain)))
    try:
        obstacles = read_polygons(path)
    except InputError as error:
        raise InputError(f"obstacles.path: {_open(error)}") from None
    try:
        return whole.without(shapely.get_parts(obstacles))
    except InputError as error:
        raise InputError(f"obstacles.path: {path}: {_open(error)}") from None


def _sides(domain: Rectangle) -> tuple[float, float, float, float]:
    return domain.x_min, domain.y_min, domain.x_max, domain.y_max


def _open(error: InputError) -> str:
    """A sentence without its full stop, to become part of another one."""
    return str(error).rstrip(".")


def _require_possible_together(domain: Rectangle, data: dict[str, Any]) -> None:
    if not isinstance(domain, Region | Cell):
        return
    kind = "repeats itself" if isinstance(domain, Cell) else "is no plain rectangle"
    if isinstance(domain, Cell) and "arrangement" in data:
        raise InputError(
            "arrangement is given, but domain.periodic too: a domain that repeats itself follows "
            "the same laws everywhere"
        )
    if "target_volume_fraction" in data:
        raise InputError(
            f"target_volume_fraction is given, but the domain {kind}: a target is reached in plain "
            "rectangles only, where the volume fraction so far can be told from the front"
        )
    for axis in data.get("error_vs_time", {}).get("axes", ()):
        if axis in AXES_OF_RECTANGLES:
            raise InputError(
                f"error_vs_time.axes names {axis}, but the domain {kind}: that axis is measured in "
                "plain rectangles only"
            )
