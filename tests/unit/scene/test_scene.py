"""Scene files: what is read, what is refused and how, and that schema and code agree."""

import dataclasses
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml
from jsonschema import Draft202012Validator

from grainfront import laws
from grainfront.draw import coverage, draw_particles
from grainfront.errors import InputError
from grainfront.scene import load_scene, scene_schema
from grainfront.scene.laws import LAWS
from grainfront.shapes import sources
from grainfront.shapes.database import build_database

CONFIG = Path(__file__).parents[3] / "config"
SHIPPED = sorted(CONFIG.glob("scenes/*.yaml"))

MINIMAL = """
seed: 3
domain: {width: 20, height: 10}
shapes: {family: {regular_polygon: {}}}
size: {constant: 1.0}
"""


def load(tmp_path, text):
    path = tmp_path / "s.yaml"
    path.write_text(text, encoding="utf-8")
    return load_scene(path)


def described_keys(node, path=""):
    """Every key that a scene may have, with its schema, by dotted path."""
    if isinstance(node, dict):
        for key, value in node.get("properties", {}).items():
            yield f"{path}.{key}", value
            yield from described_keys(value, f"{path}.{key}")


def every_key():
    schema = scene_schema()
    yield from described_keys(schema)
    for name, definition in schema["$defs"].items():
        yield name, definition
        yield from described_keys(definition, name)


def test_schema_is_valid_and_describes_and_closes_everything():
    schema = scene_schema()
    Draft202012Validator.check_schema(schema)
    assert schema["additionalProperties"] is False
    keys = dict(every_key())
    assert len(keys) > 80
    for path, described in keys.items():
        if "$ref" in described:
            assert described["$ref"].removeprefix("#/$defs/") in schema["$defs"], path
            continue
        assert described["title"] and described["description"], path
        if described["type"] == "object":
            assert described["additionalProperties"] is False, path


def test_editors_and_package_read_the_same_schema():
    assert json.loads((CONFIG / "scene.schema.json").read_text(encoding="utf-8")) == scene_schema()


def test_configuration_names_scenes_that_exist():
    schema = json.loads((CONFIG / "config.schema.json").read_text(encoding="utf-8"))
    config = yaml.safe_load((CONFIG / "config.yaml").read_text(encoding="utf-8"))
    Draft202012Validator(schema).validate(config)
    for name in config["scenes"]:
        assert (CONFIG / "scenes" / f"{name}.yaml").is_file()


@pytest.mark.parametrize(
    ("path", "cls"),
    [
        (("$defs", "segmentation"), sources.Segmentation),
        (("shapes", "photographs"), sources.Photographs),
        (("shapes", "binary_masks"), sources.BinaryMasks),
        (("shapes", "label_masks"), sources.LabelMasks),
        (("shapes", "outlines_file"), sources.OutlinesFile),
        (("family", "rectangle"), sources.Rectangles),
        (("family", "regular_polygon"), sources.RegularPolygon),
        (("family", "random_convex_polygon"), sources.RandomConvexPolygons),
        (("family", "fourier_grain"), sources.FourierGrains),
    ],
)
def test_schema_and_shape_sources_have_the_same_keys_and_defaults(path, cls):
    schema = scene_schema()
    shapes = schema["properties"]["shapes"]["properties"]
    group = {"$defs": schema["$defs"], "shapes": shapes, "family": shapes["family"]["properties"]}
    described = group[path[0]][path[1]]["properties"]
    fields = {field.name: field.default for field in dataclasses.fields(cls)}
    assert set(described) == set(fields)
    for name, entry in described.items():
        if "default" in entry:
            default = entry["default"]
            assert (tuple(default) if isinstance(default, list) else default) == fields[name], name


@pytest.mark.parametrize("kind", LAWS)
def test_schema_and_laws_have_the_same_keys(kind):
    described = scene_schema()["$defs"][kind]
    fields = dataclasses.fields(LAWS[kind])
    assert set(described["properties"]) == {field.name for field in fields}
    needed = {field.name for field in fields if field.default is dataclasses.MISSING}
    assert set(described["required"]) == needed


def test_a_minimal_scene_gets_its_defaults(tmp_path):
    read = load(tmp_path, MINIMAL)
    assert read.name == "s" and read.text == MINIMAL and read.length_unit == "mm"
    assert read.seeds == (3,)
    assert (read.domain.x_min, read.domain.y_min) == (0, 0)
    assert (read.domain.width, read.domain.height) == (20, 10)
    assert read.shapes == sources.RegularPolygon()
    assert read.size == laws.Constant(1.0)
    assert read.matched is None
    assert read.orientation == laws.Uniform(0, 180)
    assert dataclasses.astuple(read.packing) == (24, 20, 24)
    assert read.replacement is False and read.outputs == ()


FULL = """
length_unit: m
seeds: [4, 5]
domain: {width: 1e1, height: 20, origin: [-5, 2.5]}
shapes:
  photographs: {paths: [a.png, "skimage:coins"], segmentation: {block_size: 31.0}}
size:
  grading_curve: {sieve_sizes: [0.1, 0.2, 0.4], percent_passing: [0, 50, 100]}
circularity: {beta: {minimum: 0.2, maximum: 0.9, alpha: 2, beta: 3}}
orientation: {normal: {mean: 90, standard_deviation: 10}}
packing: {n_angle: 1, n_loc: 2, n_bin: 12}
replacement: on
outputs: [vtk, figures]
"""


def test_every_part_of_a_scene_is_read(tmp_path):
    (tmp_path / "a.png").touch()
    read = load(tmp_path, FULL)
    assert read.seeds == (4, 5) and read.length_unit == "m"
    assert dataclasses.astuple(read.domain) == (-5, 2.5, 5, 22.5)
    assert read.shapes == sources.Photographs(
        (str(tmp_path / "a.png"), "skimage:coins"), sources.Segmentation(block_size=31)
    )
    assert isinstance(read.shapes.segmentation.block_size, int)
    assert read.size == laws.GradingCurve((0.1, 0.2, 0.4), (0, 50, 100))
    assert read.matched == ("circularity", laws.Beta(0.2, 0.9, 2, 3))
    assert read.orientation == laws.Normal(90, 10)
    assert dataclasses.astuple(read.packing) == (1, 2, 12)
    assert read.replacement is True and read.outputs == ("vtk", "figures")


@pytest.mark.parametrize("path", SHIPPED, ids=lambda p: p.stem)
def test_shipped_scenes_can_be_read_and_every_number_has_a_reason(path):
    read = load_scene(path)
    assert read.name == path.stem
    lines = path.read_text(encoding="utf-8").splitlines()
    for line in lines:
        value = line.split("#")[0]
        if any(c.isdigit() for c in value):
            assert "#" in line, f"{path.name}: {line}"


def test_the_scenes_that_are_promised_are_there():
    names = {path.stem for path in SHIPPED}
    assert {"river_gravel", "afm_rectangles", "oafm_rectangles", "own_images", "tiny"} <= names


FAULTS = [
    ("seed: 3", "seeed: 3", ["seeed is an unknown key", "did you mean seed", "length_unit"]),
    ("{}", "{vertixes: 4}", ["shapes.family.regular_polygon.vertixes", "did you mean vertices"]),
    ("seed: 3", "seed: 3\narrangement: {}", ["arrangement.regions is missing"]),
    ("seed: 3", "seed: -1", ["seed is -1", "at least 0"]),
    ("seed: 3", "seed: 1.5", ["seed is 1.5", "whole number"]),
    ("seed: 3", "seed: yes", ["seed is True", "whole number"]),
    ("seed: 3", "", ["neither seed nor seeds"]),
    ("seed: 3", "seed: 3\nseeds: [1]", ["both seed and seeds"]),
    ("seed: 3", "seeds: []", ["seeds is []", "at least 1 long"]),
    ("seed: 3", "seeds: [1, 1]", ["seeds is [1, 1]", "without repetitions"]),
    ("seed: 3", "seed: 3\nseed: 4", ["line 3", "'seed' is given twice"]),
    ("seed: 3", "seed: [3", ["not valid YAML"]),
    ("seed: 3", "seed: 9223372036854775808", ["seed is 9", "at most 9223372036854775807"]),
    (
        "seed: 3",
        "seed: 9223372036854775807\nsweep: {n_angle: [1], n_loc: [1], seeds: 2}",
        ["sweep.seeds is 2", "count up", "at most 9223372036854775807"],
    ),
    (
        "seed: 3",
        "seed: 9223372036854775806\nerror_vs_time: {axes: [checks], seeds: 3}",
        ["error_vs_time.seeds is 3", "count up"],
    ),
    ("seed: 3", f"seed: 1{'0' * 400}", ["seed is 1000", "magnitude between"]),
    ("seed: 3", "seeds: &a [*a]", ["line 2", "aliases such as *a are not allowed"]),
    ("seed: 3", "seed: 3\npacking: {n_angle: 1e6}", ["packing.n_angle is 1000000", "at most"]),
    ("seed: 3", "seed: 3\npacking: {n_bin: 1e6}", ["packing.n_bin is 1000000", "at most"]),
    ("regular_polygon: {}", "regular_polygon: {vertices: 1e9}", ["vertices is 1000", "at most"]),
    ("regular_polygon: {}", "rectangle: {count: 1e9}", ["count is 1000000000", "at most"]),
    ("constant: 1.0", "constant: 1e-320", ["size.constant is 1e-320", "between 1e-50 and 1e+50"]),
    ("constant: 1.0", "uniform: {minimum: 1, maximum: 1e308}", ["size.uniform.maximum is 1e+308"]),
    ("seed: 3", "seed: 3\nreplacement: maybe", ["replacement is 'maybe'", "true or false"]),
    ("seed: 3", "seed: 3\noutputs: [vtp]", ["outputs[0] is 'vtp'", "one of vtk, figures"]),
    ("seed: 3", "seed: 3\nlength_unit: ''", ["length_unit is ''", "not empty"]),
    ("seed: 3", "seed: 3\npacking: {n_loc: 0}", ["packing.n_loc is 0", "at least 1"]),
    ("width: 20", "width: 0", ["domain.width is 0", "greater than 0"]),
    ("width: 20", "width: .nan", ["domain.width is nan", "finite"]),
    ("width: 20", "width: .inf", ["domain.width is inf", "finite"]),
    ("width: 20", "width: wide", ["domain.width is 'wide'", "a number"]),
    ("width: 20,", "", ["domain.width is missing"]),
    ("width: 20", "width: 0.5", ["domain", "0.5", "smallest grain, of size 1"]),
    ("{width: 20, height: 10}", "20", ["domain is 20", "mapping"]),
    ("constant: 1.0", "constant: 0", ["size.constant", "greater than 0"]),
    ("constant: 1.0", "constant: big", ["size.constant is 'big'", "a number"]),
    ("{constant: 1.0}", "{}", ["size has no key", "grading_curve"]),
    ("{constant: 1.0}", "{constant: 1, uniform: {minimum: 1, maximum: 2}}", ["exactly one of"]),
    ("{constant: 1.0}", "{gaussian: 1}", ["size.gaussian is an unknown key", "lognormal"]),
    ("constant: 1.0", "uniform: {minimum: 2, maximum: 1}", ["size.uniform: minimum is 2"]),
    ("constant: 1.0", "normal: {mean: 1}", ["size.normal.standard_deviation is missing"]),
    (
        "constant: 1.0",
        "normal: {mean: 1, standard_deviation: 0.1, minimum: 5}",
        ["size.normal", "of the law, but must hold at least"],
    ),
    (
        "constant: 1.0",
        "histogram: {edges: [1, 2, 2], counts: [1, 1]}",
        ["size.histogram: edges", "increase"],
    ),
    ("seed: 3", "seed: 3\naspect_ratio: {constant: 0.9}", ["aspect_ratio.constant", "at least 1"]),
    (
        "seed: 3",
        "seed: 3\naspect_ratio: {constant: 2}\ncircularity: {constant: 0.5}",
        ["aspect_ratio and circularity are given", "at most one"],
    ),
    (
        "seed: 3",
        "seed: 3\norientation: {uniform: {minimum: 0, maximum: 360}}",
        ["orientation.uniform", "180"],
    ),
    ("family: {regular_polygon: {}}", "", ["shapes has no key", "exactly one of photographs"]),
    ("{family: {regular_polygon: {}}}", "", ["shapes is empty", "mapping"]),
    ("regular_polygon: {}", "regular_polygon: {vertices: 2}", ["vertices is 2", "at least 3"]),
    (
        "family: {regular_polygon: {}}",
        "label_masks: {paths: [none.png]}",
        ["shapes.label_masks.paths[0] is 'none.png'", "there is none"],
    ),
    (
        "family: {regular_polygon: {}}",
        "outlines_file: {path: none.csv}",
        ["shapes.outlines_file.path is 'none.csv'"],
    ),
    (
        "family: {regular_polygon: {}}",
        "photographs: {paths: ['skimage:gravel'], segmentation: {block_size: 50}}",
        ["segmentation.block_size is 50", "odd"],
    ),
    (
        "regular_polygon: {}",
        "rectangle: {aspect_ratio: [4, 1]}",
        ["shapes.family.rectangle.aspect_ratio is [4, 1]", "least to the largest"],
    ),
]


@pytest.mark.parametrize(("part", "fault", "told"), FAULTS, ids=[f[1] for f in FAULTS])
def test_faults_are_told_in_one_sentence(tmp_path, part, fault, told):
    assert part in MINIMAL
    with pytest.raises(InputError) as caught:
        load(tmp_path, MINIMAL.replace(part, fault, 1))
    message = str(caught.value)
    assert message.startswith(str(tmp_path / "s.yaml"))
    assert "\n" not in message and message.endswith(".") and not message.endswith("..")
    for fragment in told:
        assert fragment in message


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "is empty"),
        (b"# nothing\n", "is empty"),
        (b"- 1\n", "mapping of keys"),
        (b"\xff\xfe\x00", "UTF-8"),
        (b"seed: \x07", "not valid YAML"),
    ],
)
def test_files_that_are_no_scene_are_refused(tmp_path, content, told):
    path = tmp_path / "s.yaml"
    path.write_bytes(content)
    with pytest.raises(InputError, match=told):
        load_scene(path)


def test_files_that_cannot_be_read_are_refused(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        load_scene(tmp_path / "absent.yaml")
    with pytest.raises(InputError, match="cannot be read"):
        load_scene(tmp_path)


def test_reading_a_scene_imports_nothing_heavy():
    path = CONFIG / "scenes" / "oafm_rectangles.yaml"
    code = (
        "import sys; from grainfront.scene import load_scene; load_scene(sys.argv[1]); "
        "print([m for m in ('numba', 'skimage', 'xarray', 'pyvista', 'matplotlib', 'scipy.stats', "
        "'scipy.special', 'shapely') if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("name", ["river_gravel", "tiny"])
def test_shapes_of_a_shipped_scene_can_follow_its_laws(name):
    """Every bin of the aspect ratio has a shape, and 15,000 grains follow both laws to 0.10 %."""
    read = load_scene(CONFIG / "scenes" / f"{name}.yaml")
    database = build_database(read.shapes, np.random.default_rng(read.seeds[0]))
    descriptor, law = database.descriptors[read.matched[0]], read.matched[1]
    assert coverage(descriptor, law).empty_bins == 0
    shape, size = draw_particles(
        database.count, read.size, 15_000, np.random.default_rng(1), (descriptor, law)
    )
    for prescribed, values in ((law, descriptor[shape]), (read.size, size)):
        edges, p = prescribed.bins(24)
        share = np.histogram(values, edges)[0] / values.size
        assert np.sqrt(np.sum((share - p) ** 2)) <= 1e-3
    grains = 0.85 * read.domain.area / np.mean(database.descriptors["hull_area"][shape] * size**2)
    assert grains == pytest.approx({"river_gravel": 15_000, "tiny": 160}[name], rel=0.05)
