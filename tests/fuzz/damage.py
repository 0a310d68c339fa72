"""Files of every kind of input, damaged at random: an error of one sentence, or a valid result."""

from __future__ import annotations

import contextlib
import io
import json
import os
import tempfile
from functools import cache
from pathlib import Path

import numpy as np
from hypothesis import strategies as st
from invariants import check_packing, require_one_sentence

from grainfront import api
from grainfront.arrangement.polygons_file import read_polygons
from grainfront.cli import main
from grainfront.errors import InputError
from grainfront.files import netcdf
from grainfront.files.statistics import read_statistics
from grainfront.particles import Region

SCENE = """seeds: [3, 4]
length_unit: mm
domain: {width: 14, height: 14, origin: [0, 1]}
shapes: {family: {fourier_grain: {count: 5, d2: 0.15}}}
size: {lognormal: {median: 1, log_standard_deviation: 0.3, minimum: 0.3}}
aspect_ratio: {uniform: {minimum: 1, maximum: 2}}
orientation: {uniform: {minimum: 0, maximum: 180}}
packing: {n_angle: 2, n_loc: 1, n_bin: 12}
arrangement:
  regions:
    - inside: {circle: {centre: [5, 5], radius: 3}, offset: 0.5}
      graded: {distances: [0, -3], levels: 3,
               start: {size: {constant: 1}}, end: {size: {constant: 0.5}}}
sweep: {n_angle: [1, 2], n_loc: [1, 8], seeds: 2}
target_volume_fraction: 0.7
replacement: true
outputs: [vtk]
"""
REST_OF_SCENE = {
    "seed": 1,
    "shapes": {"family": {"fourier_grain": {"count": 3}}},
    "size": {"constant": 0.8},
    "packing": {"n_angle": 2, "n_loc": 2},
}
OUTLINES = {
    "a.geojson": '{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, '
    '"geometry": {"type": "Polygon", "coordinates": [[[0, 0], [3, 0], [3, 1.5], [0, 2], [0, 0]]]}},'
    '{"type": "MultiPolygon", "coordinates": [[[[0, 0], [1, 0], [0, 1e1], [0, 0]]]]}]}',
    "a.wkt": "POLYGON ((0 0, 4 0, 4 3, 0 3, 0 0), (1 1, 2 1, 2 2, 1 1))\n"
    "MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((5 5, 6 5, 5 6.5, 5 5)))\n",
    "a.csv": "outline,x,y\n1,0,0\n1,2,0\n1,1,2.5\nb,0,0\nb,3,0\nb,3,1\nb,0,1e0\n",
}
# A domain and obstacles in it, as files beside a scene.
DOMAINS = {
    "domain.geojson": '{"type": "Polygon", "coordinates": [[[0, 0], [6, 0], [6, 5], [3, 4], '
    "[0, 5e0], [0, 0]], [[2, 2], [2, 3], [3, 3], [2, 2]]]}",
    "domain.wkt": "MULTIPOLYGON (((0 0, 5 0, 5 5, 0 5, 0 0)), ((6 0, 9 0, 9 3, 6 0)))\n",
    "stones.geojson": '{"type": "Feature", "properties": null, "geometry": {"type": "MultiPolygon",'
    ' "coordinates": [[[[1, 1], [2, 1], [2, 2], [1, 1]]], [[[3, 0], [4, 1], [3, 1], [3, 0]]]]}}',
    "stones.wkt": "POLYGON ((1 1, 2 1, 2 2, 1 2, 1 1))\nPOLYGON ((3 3, 5 3, 5 4.5, 3 3))\n",
}
# Larger domains that damage leads to are loaded, and not packed.
MOST_AREA = 100.0
IMAGES = ("a.png", "a.tif", "a.jpg", "a.gif", "a.bmp", "a.pgm")
RESULTS = {
    "packing.nc": netcdf.read_packing,
    "shapes.nc": netcdf.read_shapes,
    "contacts.nc": netcdf.read_contacts,
    "statistics.nc": read_statistics,
}
KINDS = ("scene.yaml", *OUTLINES, *DOMAINS, *IMAGES, *RESULTS)

# What means something in one kind of file or another.
TOKENS = [
    b"", b" ", b"\n", b"\0", b"\xff", b"nan", b"inf", b"-1", b"0", b"1e308", b"-1e-320", b"9" * 400,
    b"EMPTY", b"null", b"true", b"[", b"]", b"{", b"}", b"[" * 300, b"(", b")", b",", b":", b"- ",
    b'"', b"'", b"&a ", b"*a", b"<<: ", b"!!python/name:os.system ", b"? ", b"\t", b"\r", b"#",
    b"POINT Z (1 2 3)", b"CURVEPOLYGON", b"{}", b"IDAT", b"IHDR", b"\x00\x00\x00\x0d", b"\x7f" * 4,
    b"skimage:horse", b"2024-01-01", b"0x1F", b"1_000", b"~", b"\xe2\x80\xa8", b"\xf0\x9f\x98\x80",
]  # fmt: skip


@cache
def whole(kind: str) -> bytes:
    """A good file of a kind."""
    if kind == "scene.yaml":
        return SCENE.encode()
    if kind in OUTLINES:
        return OUTLINES[kind].encode()
    if kind in DOMAINS:
        return DOMAINS[kind].encode()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / kind
        if kind in IMAGES:
            import imageio.v3

            rows, columns = np.mgrid[:48, :48]
            grains = [(rows - y) ** 2 + (columns - x) ** 2 < 90 for x, y in ((14, 14), (33, 32))]
            imageio.v3.imwrite(path, (np.any(grains, axis=0) * 255).astype(np.uint8))
        else:
            _write_result(path)
        return path.read_bytes()


def _write_result(path: Path) -> None:
    from grainfront import stages

    scene = path.with_name("s.yaml")
    scene.write_text(
        "seed: 1\ndomain: {width: 5, height: 5}\nshapes: {family: {fourier_grain: {count: 3}}}\n"
        "size: {constant: 1}\npacking: {n_angle: 1, n_loc: 1}\n"
    )
    here = {name: str(path.with_name(name)) for name in RESULTS}
    loaded = api.load_scene(scene)
    database = api.build_shapes(loaded)
    api.write_shapes(here["shapes.nc"], database, loaded.shapes)
    api.write_packing(here["packing.nc"], api.pack(loaded, database, 1)[0], loaded, 1)
    stages.contacts(
        scene=str(scene), seed=1, packing=here["packing.nc"], contacts=here["contacts.nc"]
    )
    stages.statistics(
        scene=str(scene), database=here["shapes.nc"], seeds=[1], packings=[here["packing.nc"]],
        statistics=here["statistics.nc"],
    )  # fmt: skip


@st.composite
def damaged_files(draw: st.DrawFn, kinds: tuple[str, ...] = KINDS) -> tuple[str, bytes]:
    """A kind of file, and the bytes of one that was cut, edited, shuffled or made up."""
    kind = draw(st.sampled_from(kinds))
    if draw(st.integers(0, 9)) == 0:
        return kind, draw(st.binary(max_size=300))
    content = bytearray(whole(kind))
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(content)))
        stop = min(len(content), start + draw(st.sampled_from([0, 1, 1, 2, 4, 9, 30, 10**6])))
        how = draw(st.sampled_from(["cut", "token", "flip", "copy", "bytes"]))
        if how == "cut":
            del content[start:stop]
        elif how == "token":
            content[start:stop] = draw(st.sampled_from(TOKENS))
        elif how == "flip" and start < len(content):
            content[start] ^= 1 << draw(st.integers(0, 7))
        elif how == "copy":
            place = draw(st.integers(0, len(content)))
            content[place:place] = content[start : min(stop, start + 40)]
        else:
            content[start:stop] = draw(st.binary(max_size=8))
    return kind, bytes(content)


def check_file(kind: str, content: bytes) -> str:
    """Use a file as its kind is used; "refused" with one sentence, or "valid"."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / kind
        path.write_bytes(content)
        if kind in RESULTS:
            return _check_result(kind, path, content)
        if kind in DOMAINS:
            return _check_domain(path)
        if kind in ("a.geojson", "a.wkt"):
            _check_zone(path)
        if kind == "scene.yaml":
            return _check_scene(path)
        return _check_shapes(path, content)


def _check_result(kind: str, path: Path, content: bytes) -> str:
    try:
        RESULTS[kind](path)
    except InputError as error:
        require_one_sentence(error)
        return "refused"
    assert content == whole(kind), "damage went unnoticed"
    return "valid"


def _check_zone(path: Path) -> None:
    try:
        area = read_polygons(str(path)).area
    except InputError as error:
        require_one_sentence(error)
    else:
        assert np.isfinite(area) and area > 0


def _check_domain(path: Path) -> str:
    """Load a scene in such a domain, or with such obstacles, and pack it where it is small."""
    scene = path.with_name("scene.yaml")
    around = {"domain": {"width": 6, "height": 5}, "obstacles": {"path": path.name}}
    inside = {"domain": {"inside": {"file": {"path": path.name}}}}
    described = inside if path.stem == "domain" else around
    scene.write_text(json.dumps(described | REST_OF_SCENE))
    try:
        loaded = api.load_scene(scene)
        assert isinstance(loaded.domain, Region)
        assert 0 < loaded.domain.area < np.inf
        if path.stem == "stones":
            assert loaded.domain.area < 30
        if loaded.domain.area > MOST_AREA or "NUMBA_DISABLE_JIT" in os.environ:
            return "valid"
        check_packing(scene, path.parent)
    except InputError as error:
        require_one_sentence(error)
        return "refused"
    return "valid"


def _check_scene(path: Path) -> str:
    try:
        scene = api.load_scene(path)
    except InputError as error:
        require_one_sentence(error)
        assert str(path) in str(error)
        return "refused"
    assert scene.domain.area > 0 and scene.size.support[0] > 0
    return "valid"


def _check_shapes(path: Path, content: bytes) -> str:
    output = path.with_name("shapes.nc")
    kinds = ("photographs", "binary_masks", "label_masks") if path.name in IMAGES else ("",)
    kind = kinds[len(content) % len(kinds)]
    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
        code = main(["shapes", str(path), "-o", str(output), *(["--kind", kind] if kind else [])])
    if code:
        assert code == 2 and said.getvalue().count("\n") == 1, said.getvalue()
        assert said.getvalue().startswith("grainfront: ") and path.name in said.getvalue()
        assert not output.exists()
        return "refused"
    database = netcdf.read_shapes(output)
    assert database.count >= 1 and np.isfinite(database.hulls.nodes).all()
    assert (database.descriptors["aspect_ratio"] >= 1 - 1e-12).all()
    return "valid"
