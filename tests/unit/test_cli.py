"""The command line: what it writes and prints, and what it says of bad input."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from grainfront.cli import FAULTY_INPUT, main
from grainfront.files.netcdf import read_attributes, read_packing, read_shapes

SCENE = """
seeds: [3, 4]
domain: {width: 14, height: 14}
shapes: {family: {fourier_grain: {count: 30, d2: 0.15}}}
size: {uniform: {minimum: 1, maximum: 2}}
orientation: {uniform: {minimum: 0, maximum: 180}}
packing: {n_angle: 1, n_loc: 1}
"""
GEOJSON = '{"type": "Polygon", "coordinates": [[[0, 0], [3, 0], [3, 1], [0, 2], [0, 0]]]}'


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "s.yaml").write_text(SCENE)
    return tmp_path


def refused(capsys, *arguments: str) -> str:
    """The one sentence that is said of bad input."""
    assert main(arguments) == FAULTY_INPUT != 0
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.startswith("grainfront: ") and said.err.endswith(".\n")
    assert said.err.count("\n") == 1
    return said.err


def test_pack_prints_one_json_object_and_writes_the_packing(folder, capsys):
    assert main(["pack", "s.yaml", "-o", "p.nc", "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert list(result) == [
        "particles", "volume_fraction", "volume_fraction_bulk", "kernel_s", "compile_s", "left_over"
    ]  # fmt: skip
    packing = read_packing("p.nc")
    assert result["particles"] == packing.x.size > 50
    assert result["left_over"] == packing.left_over
    assert result["volume_fraction"] == pytest.approx(packing.area.sum() / 14**2)
    assert 0.5 < result["volume_fraction_bulk"] < 0.95
    attributes = read_attributes("p.nc")
    assert attributes["seed"] == 3 and attributes["scene"] == SCENE


def test_the_seed_may_be_given(folder, capsys):
    for name, options in {"a": ["--seed", "4"], "b": ["--seed", "4"], "c": []}.items():
        assert main(["pack", "s.yaml", "-o", f"{name}.nc", *options]) == 0
    assert Path("a.nc").read_bytes() == Path("b.nc").read_bytes() != Path("c.nc").read_bytes()
    assert "certified; written to c.nc" in capsys.readouterr().out


def test_a_bulk_too_small_to_have_a_volume_fraction_is_null(folder, capsys):
    Path("s.yaml").write_text(SCENE.replace("width: 14, height: 14", "width: 4, height: 4"))
    assert main(["pack", "s.yaml", "-o", "p.nc", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["volume_fraction_bulk"] is None


def test_shapes_of_an_outlines_file(folder, capsys):
    Path("one.geojson").write_text(GEOJSON)
    assert main(["shapes", "one.geojson", "-o", "shapes.nc"]) == 0
    assert "found: 1\n" in capsys.readouterr().out
    assert read_shapes("shapes.nc").count == 1


def test_shapes_of_a_scene_are_those_it_packs(folder, capsys):
    assert main(["shapes", "s.yaml", "-o", "shapes.nc"]) == 0
    assert main(["pack", "s.yaml", "-o", "p.nc"]) == 0
    aspect_ratio = read_shapes("shapes.nc").descriptors["aspect_ratio"]
    packing = read_packing("p.nc")
    assert np.array_equal(packing.aspect_ratio, aspect_ratio[packing.shape])


@pytest.mark.parametrize(("kind", "value"), [("binary_masks", 255), ("label_masks", 7)])
def test_shapes_of_a_mask(folder, capsys, kind, value):
    from skimage.io import imsave

    rows, columns = np.mgrid[:80, :80]
    disc = (rows - 40) ** 2 + (columns - 40) ** 2 < 25**2
    imsave("mask.png", (disc * value).astype(np.uint8), check_contrast=False)
    assert main(["shapes", "mask.png", "--kind", kind, "-o", "shapes.nc"]) == 0
    assert read_shapes("shapes.nc").descriptors["size"][0] == pytest.approx(50, rel=0.02)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("n_loc: 1", "n_lok: 1", ("packing.n_lok", "unknown key", "n_loc")),
        ("n_loc: 1", "n_loc: many", ("packing.n_loc", "'many'", "whole number")),
        ("minimum: 1,", "minimum: -1,", ("size.uniform", "-1")),
        ("minimum: 1,", "minimum: 5,", ("size.uniform", "5")),
        ("minimum: 1,", "minimum: .nan,", ("size.uniform.minimum", "nan", "finite")),
        ("size:", "aspect_ratio: {constant: 0.5}\nsize:", ("aspect_ratio", "0.5")),
        ("width: 14", "width: 0.5", ("domain", "0.5", "smallest grain")),
        ("width: 14", "width: 0", ("domain.width", "0", "greater than 0")),
        ("{fourier_grain: {count: 30, d2: 0.15}}", "{regular_polygon: {vertices: 2}}",
         ("vertices", "2", "at least 3")),
        ("{family: {fourier_grain: {count: 30, d2: 0.15}}}", "{photographs: {paths: [no.png]}}",
         ("shapes.photographs.paths[0]", "no.png")),
        ("seeds: [3, 4]", "seeds: [3, 4", ("not valid YAML",)),
    ],
)  # fmt: skip
def test_bad_scenes_are_told_in_one_sentence(folder, capsys, old, new, told):
    assert SCENE.count(old) == 1
    Path("s.yaml").write_text(SCENE.replace(old, new))
    Path("p.nc").write_text("earlier")
    sentence = refused(capsys, "pack", "s.yaml", "-o", "p.nc")
    for part in ("s.yaml", *told):
        assert part in sentence
    assert Path("p.nc").read_text() == "earlier"
    assert sorted(os.listdir()) == ["p.nc", "s.yaml"]


def images(kind: str) -> str:
    """Write an image at fault and give its name."""
    from skimage.io import imsave

    if kind == "grey":
        imsave("flat.png", np.full((60, 60), 90, np.uint8), check_contrast=False)
        return "flat.png"
    if kind == "speck":
        pixels = np.zeros((60, 60), np.uint8)
        pixels[30:33, 30:33] = 255
        imsave("speck.png", pixels, check_contrast=False)
        return "speck.png"
    if kind == "cut":
        imsave("whole.png", np.arange(3600, dtype=np.uint8).reshape(60, 60))
        Path("cut.png").write_bytes(Path("whole.png").read_bytes()[:60])
        return "cut.png"
    return "absent.png"


@pytest.mark.parametrize(
    ("kind", "told"),
    [
        ("grey", "single grey value"),
        ("speck", "no grain to keep"),
        ("cut", "not a readable image"),
        ("absent", "no such image file"),
    ],
)
def test_bad_images_are_told_in_one_sentence(folder, capsys, kind, told):
    name = images(kind)
    Path("shapes.nc").write_text("earlier")
    options = ["--kind", "binary_masks"] if kind == "speck" else []
    sentence = refused(capsys, "shapes", name, "-o", "shapes.nc", *options)
    assert name in sentence and told in sentence
    assert Path("shapes.nc").read_text() == "earlier"


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("cut.geojson", GEOJSON[:50], "cut.geojson"),
        ("two.wkt", "POLYGON ((0 0, 1 1, 0 0))", "2 distinct vertices; 3 or more are needed"),
        ("nan.csv", "outline,x,y\n1,0,0\n1,1,0\n1,nan,1\n", "not a finite number"),
        ("none.csv", "outline,x,y\n", "no outline"),
    ],
)
def test_bad_outlines_are_told_in_one_sentence(folder, capsys, name, text, told):
    Path(name).write_text(text)
    assert told in refused(capsys, "shapes", name, "-o", "shapes.nc")
    assert not Path("shapes.nc").exists()


@pytest.mark.parametrize("output", ["nowhere/p.nc", "."])
def test_an_output_that_cannot_be_is_told_before_packing(folder, capsys, monkeypatch, output):
    monkeypatch.setattr("grainfront.api.pack", None)
    assert output.split("/")[0] in refused(capsys, "pack", "s.yaml", "-o", output)


def test_the_scene_is_never_overwritten(folder, capsys, monkeypatch):
    monkeypatch.setattr("grainfront.api.pack", None)
    assert "is the source itself" in refused(capsys, "pack", "s.yaml", "-o", "./s.yaml")
    assert Path("s.yaml").read_text() == SCENE


def test_a_full_disk_is_told_in_one_sentence(folder, capsys, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.replace", full)
    assert "No space left" in refused(capsys, "shapes", "s.yaml", "-o", "p.nc")
    assert os.listdir() == ["s.yaml"]


def test_a_disk_that_fills_up_while_writing_is_told_in_one_sentence(folder):
    Path("p.nc").write_text("earlier")
    code = (
        "import resource, signal, sys\n"
        "from grainfront.cli import main\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))\n"
        "sys.exit(main(['shapes', 's.yaml', '-o', 'p.nc']))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.returncode == FAULTY_INPUT
    assert run.stderr.startswith("grainfront: p.nc: cannot be written")
    assert run.stderr.count("\n") == 1
    assert Path("p.nc").read_text() == "earlier"
    assert sorted(os.listdir()) == ["p.nc", "s.yaml"]


@pytest.mark.parametrize("seed", ["-1", "x", "9223372036854775808"])
def test_a_seed_is_a_whole_number_from_zero(folder, capsys, seed):
    with pytest.raises(SystemExit) as end:
        main(["pack", "s.yaml", "-o", "p.nc", f"--seed={seed}"])
    assert end.value.code == 2
    assert "seed" in capsys.readouterr().err


def test_a_run_killed_while_writing_leaves_the_earlier_file(folder):
    Path("p.nc").write_text("earlier")
    code = (
        "import os, signal, sys\n"
        "os.replace = lambda *_: os.kill(os.getpid(), signal.SIGKILL)\n"
        "from grainfront.cli import main\n"
        "main(['pack', 's.yaml', '-o', 'p.nc'])"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == -signal.SIGKILL
    assert Path("p.nc").read_text() == "earlier"
    assert sorted(name for name in os.listdir() if name[0] != ".") == ["p.nc", "s.yaml"]


def test_the_command_is_installed(folder):
    command = [Path(sys.executable).with_name("grainfront"), "pack", "none.yaml", "-o", "p.nc"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == FAULTY_INPUT
    assert run.stderr == "grainfront: none.yaml: there is no such file.\n"
