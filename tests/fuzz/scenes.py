"""Random scenes of some hundred grains, and what must be true of whatever is packed."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import strategies as st

import grainfront
from grainfront import api
from grainfront.errors import InputError
from grainfront.files.netcdf import read_packing, read_shapes

# Rounding of an area that is summed from hundreds of others.
ROUNDING = 1e-9


def floats(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_subnormal=False)


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


families = st.one_of(
    st.builds(lambda a, b, n: {"rectangle": {"aspect_ratio": [a, a + b], "count": n}},
              floats(1, 5), st.sampled_from([0.0, 1.0, 30.0]), st.integers(1, 20)),
    st.builds(lambda n: {"regular_polygon": {"vertices": n}}, st.integers(3, 200)),
    st.builds(lambda n, k: {"random_convex_polygon": {"vertices": n, "count": k}},
              st.integers(3, 40), st.integers(1, 20)),
    st.builds(lambda n, k, d, e: {"fourier_grain": {"vertices": n, "count": k, "d2": d, "d3": e}},
              st.integers(3, 80), st.integers(1, 20), floats(0, 0.3), floats(0, 0.2)),
)  # fmt: skip
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
def scenes(draw: st.DrawFn) -> dict[str, Any]:
    """A scene as its file says it."""
    unit = draw(st.sampled_from([1.0, 2.0**-30, 2.0**20, 1e-9, 1e9, 0.001]))
    size = unit * draw(floats(0.5, 2.0))
    width, height = (size * draw(floats(0.8, 18)) for _ in range(2))
    origin = [draw(st.sampled_from([0, 1, -10, 1e3, 1e5])) * size for _ in range(2)]
    scene = {
        "seed": draw(st.integers(0, 2**63 - 1)),
        "domain": {"width": width, "height": height, "origin": origin},
        "shapes": {"family": draw(families)},
        "size": draw(sizes(size)),
        "orientation": draw(orientations),
        "packing": {
            "n_angle": draw(st.integers(1, 12)),
            "n_loc": draw(st.integers(1, 12)),
            "n_bin": draw(st.integers(1, 40)),
        },
        "replacement": draw(st.booleans()),
    }
    if draw(st.booleans()):
        law = {"uniform": {"minimum": 1.0, "maximum": 1.0 + draw(floats(0.1, 5))}}
        scene["aspect_ratio"] = law
    if draw(st.integers(0, 7)) == 0:
        scene["target_volume_fraction"] = draw(floats(0.55, 0.8))
        scene["target_tolerance"] = 0.1
    if draw(st.integers(0, 2)) == 0:
        regions = []
        for _ in range(draw(st.integers(1, 2))):
            law = draw(st.sampled_from([{"size": draw(sizes(0.6 * size))},
                                        {"orientation": draw(orientations)},
                                        {"size": {"finer_than": "auto"}}]))  # fmt: skip
            regions.append({"inside": draw(zones(*origin, width, height)), **law})
        scene["arrangement"] = {"regions": regions}
    return scene


def check_scene(data: dict[str, Any]) -> str:
    """Pack a scene twice; "packed" where all invariants hold, "refused" with one sentence."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.yaml"
        path.write_text(json.dumps(data))
        try:
            return _check(path, Path(folder))
        except InputError as error:
            sentence = api.sentence(error)
            assert sentence.count("\n") == 0 and len(sentence) < 1000
            return "refused"


def _check(path: Path, folder: Path) -> str:
    scene = api.load_scene(path)
    database = api.build_shapes(scene)
    packing, _ = api.pack(scene, database, scene.seeds[0])
    again, _ = api.pack(scene, database, scene.seeds[0])
    assert packing.polygons.nodes.tobytes() == again.polygons.nodes.tobytes(), "not the same again"

    certificate = api.certify(packing)
    assert certificate.holds, certificate
    hull_area = database.descriptors["hull_area"][packing.shape] * packing.size**2
    assert np.allclose(packing.area, hull_area, rtol=ROUNDING, atol=0)
    assert 0 < packing.area.sum() / packing.domain.area < 1 + ROUNDING
    assert packing.left_over >= 0
    low, high = scene.size.quantile([0.0, 1.0])
    if scene.arrangement is None:
        assert (packing.size >= low * (1 - ROUNDING)).all()
        assert (packing.size <= high * (1 + ROUNDING)).all()
    if scene.target is not None:
        area = database.descriptors["area" if scene.replacement else "hull_area"]
        reached = np.sum(area[packing.shape] * packing.size**2) / packing.domain.area
        assert abs(reached - scene.target.volume_fraction) <= scene.target.tolerance * (1 + 1e-6)

    api.write_packing(folder / "packing.nc", packing, scene, scene.seeds[0])
    read = read_packing(folder / "packing.nc")
    assert read.polygons.nodes.tobytes() == packing.polygons.nodes.tobytes()
    api.write_shapes(folder / "shapes.nc", database, scene.shapes)
    shapes = read_shapes(folder / "shapes.nc")
    assert shapes.outlines.nodes.tobytes() == database.outlines.nodes.tobytes()
    if scene.replacement:
        outlines = grainfront.replace(read, shapes)
        assert api.certify(outlines).holds
        assert (outlines.area <= packing.area * (1 + ROUNDING)).all()
    measured = api.measure(scene, database, packing)
    assert 0 <= measured.coordination_number < 100
    return "packed"
