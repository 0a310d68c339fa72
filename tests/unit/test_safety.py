"""Nothing that a file says is run, and nothing absurd is begun."""

from __future__ import annotations

import ast
import re
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest

from grainfront import api, image_files
from grainfront.checked_yaml import parse_checked
from grainfront.errors import InputError
from grainfront.files.atomic import require_writable
from grainfront.image_files import MOST_PIXELS, read_image
from grainfront.shapes.sources import FourierGrains, RandomConvexPolygons

ROOT = Path(__file__).parents[2]
PROGRAMS = sorted((*ROOT.glob("src/**/*.py"), *ROOT.glob("workflow/**/*.py")))
RULES = [ROOT / "Snakefile", *sorted(ROOT.glob("workflow/**/*.smk"))]

# They run what data say.
UNSAFE_MODULES = {"pickle", "marshal", "shelve", "dill", "cloudpickle", "joblib", "code"}
UNSAFE_CALLS = {
    "eval", "exec", "compile", "__import__", "os.system", "os.popen", "np.load", "numpy.load",
    "np.fromfile", "yaml.unsafe_load", "yaml.full_load", "yaml.load_all",
}  # fmt: skip
# A shell would read them; data are told apart from commands only where there is none.
SHELLS = {"subprocess", "pty", "pexpect"}


def unsafe(source: str) -> list[str]:
    """What a source text does that lets data be run."""
    tree = ast.parse(source)
    found = []
    safe_loaders = {
        node.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef) and "yaml.SafeLoader" in map(ast.unparse, node.bases)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found += [a.name for a in node.names if a.name.split(".")[0] in UNSAFE_MODULES | SHELLS]
        elif isinstance(node, ast.ImportFrom) and node.module:
            found += [node.module] * (node.module.split(".")[0] in UNSAFE_MODULES | SHELLS)
        elif isinstance(node, ast.Call):
            called = ast.unparse(node.func)
            found += [called] * (called in UNSAFE_CALLS)
            given = {k.arg: ast.unparse(k.value) for k in node.keywords}
            found += ["allow_pickle"] * (given.get("allow_pickle", "False") != "False")
            if called == "yaml.load":
                found += [called] * (given.get("Loader") not in safe_loaders)
    return found


def test_no_program_runs_what_data_say():
    assert len(PROGRAMS) > 100
    found = {path.name: unsafe(path.read_text(encoding="utf-8")) for path in PROGRAMS}
    assert {name: what for name, what in found.items() if what} == {}


@pytest.mark.parametrize(
    "source",
    ["import pickle", "from pickle import loads", "eval('1')", "np.load('a.npy')", "os.system('a')",
     "import subprocess", "yaml.load(text, Loader=yaml.FullLoader)", "yaml.load(text)",
     "class L(yaml.Loader): pass\nyaml.load(text, Loader=L)", "read(a, allow_pickle=True)"],
)  # fmt: skip
def test_what_runs_data_is_found(source):
    assert unsafe(source)


@pytest.mark.parametrize("path", RULES, ids=lambda path: path.name)
def test_no_rule_goes_through_a_shell_or_a_template(path):
    text = path.read_text(encoding="utf-8")
    assert not re.search(r"^\s+(shell|run|wrapper|notebook|container|conda)\s*:", text, re.M)
    assert not re.search(r"^\s*configfile\s*:", text, re.M), "it runs templates (yte)"
    assert not re.search(r"\b(eval|exec|shell|system|popen)\(", text)


@pytest.mark.parametrize("tag", ["!!python/object/apply:os.system [id]", "!!python/name:os.system"])
def test_yaml_makes_no_objects(tag):
    with pytest.raises(InputError, match=r"could not determine a constructor"):
        parse_checked(f"scenes: {tag}", {"required": []}, "config.yaml")


def png(width: int, height: int) -> bytes:
    """A whole grey PNG of a single value, which is small however many pixels it has."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        checksum = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + checksum

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    rows = zlib.compress(b"")  # it is never decoded
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        chunk(*one) for one in ((b"IHDR", header), (b"IDAT", rows), (b"IEND", b""))
    )


@pytest.mark.parametrize("width", [MOST_PIXELS // 1000 + 1, 2 * 10**6])
def test_an_image_of_too_many_pixels_is_refused_before_it_is_decoded(tmp_path, monkeypatch, width):
    monkeypatch.setattr(image_files, "_decoded", None)
    path = tmp_path / "large.png"
    path.write_bytes(png(width, 1000))
    with pytest.raises(InputError, match=r"large\.png: has more than 100,000,000 pixels"):
        read_image(str(path))


@pytest.mark.parametrize(
    ("shape", "options"),
    [
        ((40, 50), {}),
        ((40, 50, 3), {"photometric": "rgb"}),
        ((3, 40, 50), {"photometric": "rgb", "planarconfig": "separate"}),
    ],
)
def test_the_pixels_of_a_tiff_are_counted(tmp_path, monkeypatch, shape, options):
    import tifffile

    path = tmp_path / "large.tif"
    tifffile.imwrite(path, np.zeros(shape, np.uint8), **options)
    assert image_files._count(str(path)) == 2000
    monkeypatch.setattr(image_files, "_decoded", None)
    monkeypatch.setattr(image_files, "MOST_PIXELS", 1999)
    with pytest.raises(InputError, match=r"large\.tif: has more than"):
        read_image(str(path))


def test_a_picture_of_many_frames_counts_them_all(tmp_path, monkeypatch):
    from PIL import Image

    monkeypatch.setattr(image_files, "MOST_PIXELS", 20 * 20 * 3 - 1)
    path = tmp_path / "frames.gif"
    frames = [Image.fromarray(np.full((20, 20), i * 50, np.uint8)) for i in range(3)]
    frames[0].save(path, save_all=True, append_images=frames[1:])
    with pytest.raises(InputError, match=r"more than 1,199 pixels"):
        read_image(str(path))


def test_what_is_no_image_is_not_given_to_other_readers(tmp_path):
    path = tmp_path / "a.npz"
    np.savez(path, image=np.zeros((40, 40), np.uint8))
    with pytest.raises(InputError, match=r"a\.npz: not a readable image"):
        read_image(str(path))


SCENE = """
seed: 3
domain: {{width: {width}, height: {width}}}
shapes: {{family: {{rectangle: {{}}}}}}
size: {size}
packing: {{n_angle: {n_angle}, n_loc: {n_loc}}}
"""


def packed(tmp_path: Path, **changes: object) -> None:
    """Pack a scene of some squares with these changes."""
    given = {"width": 10, "size": "{constant: 1}", "n_angle": 1, "n_loc": 1} | changes
    (tmp_path / "absurd.yaml").write_text(SCENE.format(**given))
    scene = api.load_scene(tmp_path / "absurd.yaml")
    api.pack(scene, api.build_shapes(scene), 1)


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        (
            {"width": 1e5},
            r"takes 4,2\S+ particles .* some 4,\d+ GB of memory, but this machine has 16 GB",
        ),
        ({"width": 3e7}, r"takes 378,\S+ particles .* some 438,\d+,\d+ GB"),
        ({"n_angle": 10_000, "n_loc": 10_000}, r"n_loc 10000, some 19 GB of memory"),
    ],
    ids=["particles", "many more", "trials"],
)
def test_a_scene_that_needs_absurd_memory_is_refused_with_its_estimate(
    tmp_path, changes, told, monkeypatch
):
    there = {"SC_PAGE_SIZE": 4000, "SC_PHYS_PAGES": 4_000_000}
    monkeypatch.setattr("grainfront.from_scene.limits.os.sysconf", there.__getitem__)
    with pytest.raises(InputError, match=f"absurd: a domain of .*{told}"):
        packed(tmp_path, **changes)


def test_the_estimate_is_not_exceeded(tmp_path):
    """Memory of all arrays of a packing under way, for the certificate takes no more than that."""
    from grainfront.from_scene import limits

    (tmp_path / "s.yaml").write_text(
        SCENE.format(width=100, size="{constant: 1}", n_angle=24, n_loc=20)
    )
    scene = api.load_scene(tmp_path / "s.yaml")
    database = api.build_shapes(scene)
    state = api.empty_packing(scene, database, 1)
    held = sum(
        array.nbytes
        for part in state
        if isinstance(part, tuple)
        for array in part
        if isinstance(array, np.ndarray)
    )
    n = state.supply.size.size
    assert held < n * (limits.BYTES_A_PARTICLE + 4 * limits.BYTES_A_NODE)


@pytest.mark.parametrize(
    "family",
    [FourierGrains(vertices=10_000, count=100_000), RandomConvexPolygons(10_000, count=100_000)],
    ids=["Fourier grains", "random convex polygons"],
)
def test_a_database_of_absurd_size_is_refused(family):
    with pytest.raises(
        InputError, match=r"have 1,000,000,000 nodes in all; allowed are 20,000,000"
    ):
        api.build_shapes_of(family)


def test_grains_too_small_for_their_coordinates_are_refused_with_scene_and_key(tmp_path):
    law = "{lognormal: {median: 1, log_standard_deviation: 20}}"
    told = r"absurd: size: the smallest grain drawn has a size of .*e-\d+, but it must be at least"
    with pytest.raises(InputError, match=told):
        packed(tmp_path, width=14, size=law)


@pytest.mark.parametrize("length", [255, 5000])
def test_a_name_too_long_is_refused_before_anything_is_written(tmp_path, length):
    with pytest.raises(InputError, match=r"is not a name for a file \(File name too long\)"):
        require_writable(tmp_path / f"{'a' * (length - 3)}.nc")
    require_writable(tmp_path / f"{'a' * 200}.nc")


STRANGE = ["a b.yaml", "it's.yaml", 'a"b".yaml', "a;touch hurt;.yaml", "$(touch hurt).yaml",
           "..yaml", "ü\N{GRINNING FACE}.yaml", "a\nb.yaml", "-rf.yaml", "{a}.yaml", "%s.yaml",
           "a#mode=zarr.yaml"]  # fmt: skip


@pytest.mark.parametrize("name", STRANGE)
def test_strange_names_are_names(tmp_path, monkeypatch, capsys, name):
    from grainfront.cli import main

    monkeypatch.chdir(tmp_path)
    folder = tmp_path / f"in {name}"
    folder.mkdir()
    text = SCENE.format(width=8, size="{constant: 1}", n_angle=1, n_loc=1)
    (folder / name).write_text(text)
    output = str(folder / name.replace(".yaml", ".nc"))
    assert main(["pack", str(folder / name), "-o", output]) == 0, capsys.readouterr().err
    capsys.readouterr()
    assert main(["pack", str(folder / f"no{name}"), "-o", output]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not list(tmp_path.rglob("hurt"))
    assert len(list(folder.iterdir())) == 2
