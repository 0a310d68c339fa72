"""Random scenes of some hundred grains: packed and all invariants true, or refused."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Any

from domains import Described, domains, floats
from hypothesis import strategies as st
from invariants import check_packing, require_one_sentence

from grainfront.errors import InputError


@st.composite
def sizes(draw: st.DrawFn, mean: float) -> dict[str, Any]:
    """A size law of about this mean."""
    a, b = draw(floats(0.3, 1.0)) * mean, draw(floats(1.0, 1.8)) * mean
    spread = draw(floats(0.01, 0.6))
    return draw(
        st.sampled_from(
            [
                {"constant": mean},
                {"uniform": {"minimum": a, "maximum": b}},
                {"normal": {"mean": mean, "standard_deviation": spread * mean,
                            "minimum": 0.2 * mean}},
                {"lognormal": {"median": mean, "log_standard_deviation": spread,
                               "minimum": a, "maximum": 1.01 * b}},
                {"lognormal": {"median": mean, "log_standard_deviation": spread}},
                {"weibull": {"scale": mean, "shape": 1 / spread, "minimum": 0.2 * mean}},
                {"gamma": {"scale": spread * mean, "shape": 1 / spread, "minimum": 0.2 * mean}},
                {"exponential": {"scale": 0.5 * mean, "minimum": 0.5 * mean, "maximum": 9 * mean}},
                {"beta": {"minimum": a, "maximum": 1.01 * b, "alpha": 0.5 + spread, "beta": 2.0}},
                {"histogram": {"edges": [a, mean * 1.001, 2 * b], "counts": [3, spread]}},
                {"grading_curve": {"sieve_sizes": [a, 1.01 * b], "percent_passing": [0, 100]}},
            ]
        )
    )  # fmt: skip


rectangles = st.builds(
    lambda a, b, n: {"rectangle": {"aspect_ratio": [a, a + b], "count": n}},
    floats(1, 5), st.sampled_from([0.0, 1.0, 30.0]), st.integers(1, 20),
)  # fmt: skip
round_families = st.one_of(
    st.builds(lambda n: {"regular_polygon": {"vertices": n}}, st.integers(3, 200)),
    st.builds(lambda n, k: {"random_convex_polygon": {"vertices": n, "count": k}},
              st.integers(3, 40), st.integers(1, 20)),
    st.builds(lambda n, k, d, e: {"fourier_grain": {"vertices": n, "count": k, "d2": d, "d3": e}},
              st.integers(8, 80), st.integers(1, 20), floats(0, 0.3), floats(0, 0.2)),
)  # fmt: skip
families = st.one_of(rectangles, round_families)
orientations = st.one_of(
    st.builds(lambda a: {"constant": a}, floats(-180, 180)),
    st.builds(lambda a, w: {"uniform": {"minimum": a, "maximum": a + w}},
              floats(-90, 90), floats(1e-6, 180)),
    st.builds(lambda a, s: {"normal": {"mean": a, "standard_deviation": s}},
              floats(0, 180), floats(1e-9, 25)),
)  # fmt: skip


@st.composite
def zones(draw: st.DrawFn, x: float, y: float, width: float, height: float) -> dict[str, Any]:
    """A zone that meets a domain, or does not."""
    at = [x + draw(floats(-0.2, 1.2)) * width, y + draw(floats(-0.2, 1.2)) * height]
    extent = draw(floats(0.05, 0.7))
    zone = draw(
        st.sampled_from(
            [
                {"circle": {"centre": at, "radius": extent * width}},
                {"rectangle": {"centre": at, "width": extent * width, "height": extent * height}},
                {"half_plane": {"point": at, "normal": [1, extent]}},
                {"polygon": {"nodes": [at, [at[0] + width, at[1]], [at[0], at[1] + height]]}},
            ]
        )
    )
    if draw(st.booleans()):
        zone = {**zone, "rotate": {"angle": draw(floats(-180, 180)), "about": at}}
    return zone


@st.composite
def scenes(draw: st.DrawFn) -> Described:
    """A scene as its file says it, and the files beside it."""
    unit = draw(st.sampled_from([1.0, 2.0**-30, 2.0**20, 1e-9, 1e9, 0.001]))
    size = unit * draw(floats(0.5, 2.0))
    described, files = draw(domains(size))
    domain = described["domain"]
    scene = {
        "seed": draw(st.integers(0, 2**63 - 1)),
        **described,
        "shapes": {"family": draw(round_families if "periodic" in domain else families)},
        "size": draw(sizes(size)),
        "orientation": draw(orientations),
        "packing": {
            "n_angle": draw(st.integers(1, 12)),
            "n_loc": draw(st.integers(1, 12)),
            "n_bin": draw(st.integers(1, 40)),
        },
        "replacement": draw(st.booleans()),
    }
    if draw(st.booleans()) and "periodic" not in domain:
        law = {"uniform": {"minimum": 1.0, "maximum": 1.0 + draw(floats(0.1, 5))}}
        scene["aspect_ratio"] = law
    if kind_of(described) == "rectangle" and draw(st.integers(0, 7)) == 0:
        scene["target_volume_fraction"] = draw(floats(0.55, 0.8))
        scene["target_tolerance"] = 0.1
    if "periodic" not in domain and draw(st.integers(0, 2)) == 0:
        x, y = domain.get("origin", [0, 0])
        scene["arrangement"] = {"regions": draw(regions(size, x, y, domain))}
    return scene, files


@st.composite
def regions(
    draw: st.DrawFn, size: float, x: float, y: float, domain: dict[str, Any]
) -> list[dict[str, Any]]:
    """One region or two, with laws of their own."""
    width, height = domain.get("width", 8 * size), domain.get("height", 8 * size)
    found = []
    for _ in range(draw(st.integers(1, 2))):
        law = draw(st.sampled_from([{"size": draw(sizes(0.6 * size))},
                                    {"orientation": draw(orientations)},
                                    {"size": {"finer_than": "auto"}}]))  # fmt: skip
        found.append({"inside": draw(zones(x, y, width, height)), **law})
    return found


def check_scene(data: dict[str, Any], files: dict[str, str] | None = None) -> str:
    """Pack a scene; "packed" where all invariants hold, "refused" with one sentence."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.yaml"
        path.write_text(json.dumps(data))
        for name, text in (files or {}).items():
            path.with_name(name).write_text(text)
        try:
            check_packing(path, Path(folder))
        except InputError as error:
            require_one_sentence(error)
            return "refused"
        return "packed"


def kind_of(data: dict[str, Any]) -> str:
    """Which kind of domain a scene has."""
    domain = data["domain"]
    kind = "cell" if "periodic" in domain else "inside" if "inside" in domain else "rectangle"
    return f"{kind} with obstacles" if "obstacles" in data else kind
