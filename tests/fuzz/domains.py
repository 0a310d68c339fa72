"""Random domains: rectangles, shapes with holes and islands, obstacles, cells that repeat."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from hypothesis import strategies as st

# Parts of a scene, and the files beside it that they name.
Described = tuple[dict[str, Any], dict[str, str]]

KINDS = ("rectangle", "rectangle", "inside", "obstacles", "obstacles inside", "cell")


def floats(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers without the tiny ones, which scenes refuse one and all."""
    return st.floats(low, high).map(lambda value: max(low, round(value, 12)))


@st.composite
def domains(draw: st.DrawFn, size: float) -> Described:
    """A domain of some hundred grains of about this size, at most."""
    kind = draw(st.sampled_from(KINDS))
    narrowest, widest = {"rectangle": (0.8, 18), "cell": (7.5, 14)}.get(kind, (1, 12))
    width, height = (size * draw(floats(narrowest, widest)) for _ in range(2))
    origin = [draw(st.sampled_from([0, 1, -10, 1e3, 1e5])) * size for _ in range(2)]
    domain: dict[str, Any] = {"width": width, "height": height, "origin": origin}
    files = {}
    if kind == "cell":
        domain["periodic"] = draw(st.sampled_from([["x"], ["x", "y"]]))
        if domain["periodic"] == ["x"]:
            domain["height"] = size * draw(floats(0.8, 12))
    if kind.endswith("inside"):
        domain = {"inside": draw(bounded_zones(*origin, width, height))}
    if kind.startswith("obstacles"):
        stones = draw(obstacles(*origin, width, height))
        if "inside" in domain:  # the stones lie within it all the same
            centre = [origin[0] + 0.5 * width, origin[1] + 0.5 * height]
            whole = {"rectangle": {"centre": centre, "width": width, "height": height}}
            about = {"scale": {"factor": 1.5, "about": centre}}
            domain = {"inside": {"union": [whole, domain["inside"] | about]}}
        name = draw(st.sampled_from(list(stones)))
        files = {name: stones[name]}
        return {"domain": domain, "obstacles": {"path": name}}, files
    return {"domain": domain}, files


@st.composite
def rings(draw: st.DrawFn, x: float, y: float, rx: float, ry: float) -> list[list[float]]:
    """A ring about a point that every one of its nodes sees, in a box of these half sides."""
    n = draw(st.integers(3, 12))
    least = draw(st.sampled_from([1e-6, 0.1, 0.5, 1.0]))
    radius = np.array([draw(floats(least, 1.0)) for _ in range(n)])
    angle = draw(floats(0, 2 * np.pi)) + 2 * np.pi * np.arange(n) / n
    return np.column_stack(
        [x + rx * radius * np.cos(angle), y + ry * radius * np.sin(angle)]
    ).tolist()


@st.composite
def bounded_zones(
    draw: st.DrawFn, x: float, y: float, width: float, height: float
) -> dict[str, Any]:
    """A zone with an end: some have holes, islands, necks, corners of any angle."""
    cx, cy = x + 0.5 * width, y + 0.5 * height
    share = draw(floats(0.05, 1.0))
    disc = {"circle": {"centre": [cx, cy], "radius": 0.5 * width}}
    box = {"rectangle": {"centre": [cx, cy], "width": width, "height": height}}
    ring = draw(rings(cx, cy, 0.5 * width, 0.5 * height))
    hole = [[cx + 0.8 * share * (a - cx), cy + 0.8 * share * (b - cy)] for a, b in ring]
    holed = {"nodes": ring, "holes": [hole]}
    corner = {"rectangle": {"centre": [x, y], "width": share * width, "height": share * height}}
    moved = {"circle": {"centre": [x + share * width, y], "radius": 0.4 * width}}
    zone = draw(
        st.sampled_from(
            [
                disc,
                box,
                {"polygon": {"nodes": ring}},
                {"polygon": holed},
                {"union": [box, moved]},
                {"union": [moved, {"circle": {"centre": [x, y + height], "radius": 0.4 * width}}]},
                {"union": [{"polygon": {"nodes": ring}}, corner]},
                {"difference": [box, corner]},
                {"difference": [disc, {"circle": {"centre": [cx, cy], "radius": 0.4 * width}}]},
                {"difference": [box, {"polygon": {"nodes": ring}}]},
                {"intersection": [box, {"half_plane": {"point": [cx, cy], "normal": [1, share]}}]},
                {"intersection": [disc, {"bars": {"width": 0.3 * width, "spacing": 0.5 * width,
                                                  "point": [x, y]}}]},
            ]
        )
    )  # fmt: skip
    if draw(st.booleans()):
        zone = {**zone, "rotate": {"angle": draw(floats(-180, 180)), "about": [cx, cy]}}
    if draw(st.integers(0, 3)) == 0:
        zone = {**zone, "offset": draw(floats(-0.1, 0.2)) * width}
    return zone


@st.composite
def obstacles(draw: st.DrawFn, x: float, y: float, width: float, height: float) -> dict[str, str]:
    """Stones in a lattice of boxes, some of which touch each other or the walls, by file name."""
    columns, rows = draw(st.integers(1, 4)), draw(st.integers(1, 4))
    polygons = []
    for _ in range(draw(st.integers(1, 5))):
        i, j = draw(st.integers(0, columns - 1)), draw(st.integers(0, rows - 1))
        cx, cy = x + (i + 0.5) * width / columns, y + (j + 0.5) * height / rows
        share = draw(st.sampled_from([0.01, 0.3, 0.7, 0.999999, 1.0]))
        rx, ry = share * 0.5 * width / columns, share * 0.5 * height / rows
        if draw(st.booleans()):
            ring = draw(rings(cx, cy, rx, ry))
        else:
            ring = [[cx - rx, cy - ry], [cx + rx, cy - ry], [cx + rx, cy + ry], [cx - rx, cy + ry]]
        polygon = [[*ring, ring[0]]]
        if draw(st.integers(0, 3)) == 0:  # a hole is a room of its own
            hole = [[cx + 0.5 * (a - cx), cy + 0.5 * (b - cy)] for a, b in ring]
            polygon.append([*hole, hole[0]])
        polygons.append(polygon)
    texts = [
        ", ".join("(" + ", ".join(f"{a!r} {b!r}" for a, b in ring) + ")" for ring in polygon)
        for polygon in polygons
    ]
    return {
        "stones.geojson": json.dumps({"type": "MultiPolygon", "coordinates": polygons}),
        "stones.wkt": "".join(f"POLYGON ({text})\n" for text in texts),
    }
