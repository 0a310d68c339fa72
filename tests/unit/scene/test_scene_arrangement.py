"""Arrangements in scenes: what is read, what is refused and how."""

import dataclasses
import subprocess
import sys

import pytest

from grainfront.arrangement.regions import (
    Arrangement,
    GradedAlong,
    GradedByDistance,
    LocalLaws,
    Region,
)
from grainfront.arrangement.zones import (
    Bars,
    Box,
    Circle,
    Difference,
    HalfPlane,
    Intersection,
    Moved,
    Offset,
    Polygon,
    PolygonsFile,
    Silhouette,
    Union,
)
from grainfront.errors import InputError
from grainfront.laws import Lognormal, Normal, Truncated, Uniform
from grainfront.scene import arrangement, load_scene, scene_schema

SCENE = """
seed: 3
domain: {width: 20, height: 10}
shapes: {family: {rectangle: {}}}
size: {uniform: {minimum: 0.2, maximum: 0.6}}
aspect_ratio: {uniform: {minimum: 1.5, maximum: 3}}
"""
CIRCLE = "circle: {centre: [5, 5], radius: 2}"


def load(tmp_path, regions):
    path = tmp_path / "s.yaml"
    path.write_text(f"{SCENE}arrangement:\n  regions:\n{regions}\n", encoding="utf-8")
    return load_scene(path).arrangement


def zone(tmp_path, inside):
    text = f"    - inside: {inside}\n      orientation: {{constant: 0}}"
    return load(tmp_path, text).regions[0].inside


def test_a_scene_without_arrangement_has_none(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(SCENE, encoding="utf-8")
    assert load_scene(path).arrangement is None


C = Circle((5.0, 5.0), 2.0)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("{circle: {centre: [5, 5], radius: 2}}", C),
        ("{rectangle: {centre: [1, 2], width: 3, height: 4}}", Box((1, 2), 3, 4)),
        ("{polygon: {nodes: [[0, 0], [1, 0], [0, 1]]}}", Polygon(((0, 0), (1, 0), (0, 1)))),
        (
            "{polygon: {nodes: [[0, 0], [9, 0], [0, 9]], holes: [[[1, 1], [2, 1], [1, 2]]]}}",
            Polygon(((0, 0), (9, 0), (0, 9)), (((1, 1), (2, 1), (1, 2)),)),
        ),
        ("{half_plane: {point: [1, 2], normal: [0, 1]}}", HalfPlane((1, 2), (0, 1))),
        ("{bars: {width: 1, spacing: 2}}", Bars(1, 2)),
        ("{bars: {width: 1, spacing: 2, direction: 30, point: [1, 1]}}", Bars(1, 2, 30, (1, 1))),
        (
            '{silhouette: {path: "skimage:horse", centre: [5, 5], width: 8}}',
            Silhouette("skimage:horse", (5, 5), 8),
        ),
        (
            '{silhouette: {path: "skimage:horse", centre: [5, 5], height: 8, dark: false}}',
            Silhouette("skimage:horse", (5, 5), None, 8, False),
        ),
        (f"{{union: [{{{CIRCLE}}}, {{{CIRCLE}}}]}}", Union((C, C))),
        (f"{{intersection: [{{{CIRCLE}}}, {{{CIRCLE}}}]}}", Intersection((C, C))),
        (
            f"{{difference: [{{{CIRCLE}}}, {{{CIRCLE}, offset: -1}}]}}",
            Difference((C, Offset(C, -1))),
        ),
        (
            f"{{offset: 1, translate: [1, 0], rotate: {{angle: 30, about: [1, 1]}}, {CIRCLE}, "
            "scale: {factor: 2, about: [2, 2]}}",
            Offset(
                Moved(Moved(Moved(C, scale=2, about=(2, 2)), angle=30, about=(1, 1)), shift=(1, 0)),
                1,
            ),
        ),
    ],
)
def test_zones_are_read(tmp_path, text, wanted):
    assert zone(tmp_path, text) == wanted


def test_files_are_found_beside_the_scene(tmp_path):
    (tmp_path / "a.wkt").touch()
    assert zone(tmp_path, "{file: {path: a.wkt}}") == PolygonsFile(str(tmp_path / "a.wkt"))


def test_laws_are_replaced_truncated_or_parted(tmp_path):
    found = load(
        tmp_path,
        f"""
    - inside: {{{CIRCLE}}}
      size: {{truncated: {{maximum: 0.4}}}}
      aspect_ratio: {{truncated: {{minimum: 2, maximum: 2.5}}}}
      orientation: {{normal: {{mean: 30, standard_deviation: 5}}}}
    - inside: {{{CIRCLE}}}
      size: {{finer_than: 0.5}}
    - inside: {{{CIRCLE}}}
      size: {{coarser_than: 0.5}}
""",
    )
    size, aspect_ratio = Uniform(0.2, 0.6), Uniform(1.5, 3)
    local = LocalLaws(
        Truncated(size, None, 0.4),
        ("aspect_ratio", Truncated(aspect_ratio, 2, 2.5)),
        Normal(mean=30, standard_deviation=5),
    )
    rest = (LocalLaws(),)
    assert found == Arrangement(
        (Region(C, (local,)), Region(C, rest, None, True), Region(C, rest, None, False)), 0.5
    )


def test_the_critical_size_may_follow_from_the_areas(tmp_path):
    found = load(tmp_path, f"    - inside: {{{CIRCLE}}}\n      size: {{finer_than: auto}}")
    assert found == Arrangement((Region(C, (LocalLaws(),), None, True),), None)


def graded(key, start, end, levels=4):
    return f"""
      graded:
        {key}
        levels: {levels}
        start: {start}
        end: {end}
"""


def test_a_fining_upward_bed(tmp_path):
    bed = "{{size: {{lognormal: {{median: {}, log_standard_deviation: 0.3}}}}}}"
    ends = bed.format(0.4), bed.format(0.2)
    text = "    - orientation: {constant: 0}" + graded("points: [[0, 0], [0, 10]]", *ends)
    (region,) = load(tmp_path, text).regions
    assert region.inside is None and region.grade == GradedAlong((0, 0), (0, 10))
    medians = [stratum.size.median for stratum in region.strata]
    assert medians == pytest.approx([0.375, 0.325, 0.275, 0.225])
    assert all(isinstance(stratum.size, Lognormal) for stratum in region.strata)
    assert all(stratum.orientation.value == 0 for stratum in region.strata)


def test_a_shear_band_of_aligned_grains(tmp_path):
    law = "{{orientation: {{normal: {{mean: 30, standard_deviation: {}}}}}}}"
    text = f"    - inside: {{{CIRCLE}}}" + graded(
        "distances: [0, -2]", law.format(25), law.format(5), levels=2.0
    )
    (region,) = load(tmp_path, text).regions
    assert region.grade == GradedByDistance(0, -2)
    spread = [stratum.orientation.standard_deviation for stratum in region.strata]
    assert spread == pytest.approx([20, 10])


ONE = "{size: {constant: 0.3}}"
FAULTS = [
    ("    - inside: {}\n      size: {constant: 1}", ["regions[0].inside has no zone", "circle"]),
    (f"    - inside: {{{CIRCLE}}}", ["regions[0] gives no law", "orientation"]),
    (
        f"    - inside: {{{CIRCLE}, bars: {{width: 1, spacing: 2}}}}\n      size: {{constant: 1}}",
        ["regions[0].inside has the keys circle, bars", "exactly one"],
    ),
    (
        "    - inside: {circel: {}}\n      size: {constant: 1}",
        ["regions[0].inside.circel is an unknown key", "did you mean circle"],
    ),
    (
        f"    - inside: {{union: [{{{CIRCLE}}}, {{circle: {{centre: [1, 2]}}}}]}}\n"
        "      size: {constant: 1}",
        ["regions[0].inside.union[1].circle.radius is missing"],
    ),
    (f"    - inside: {{union: [{{{CIRCLE}}}]}}", ["inside.union is", "at least 2 long"]),
    (
        "    - inside: {silhouette: {path: a.png, centre: [1, 1], width: 2}}",
        ["regions[0].inside.silhouette.path is 'a.png'", "there is none"],
    ),
    (
        '    - inside: {silhouette: {path: "skimage:horse", centre: [1, 1]}}',
        ["inside.silhouette gives neither width nor height"],
    ),
    ("    - inside: {bars: {width: 2, spacing: 2}}", ["bars.spacing is 2", "greater than the"]),
    ("    - inside: {half_plane: {point: [0, 0], normal: [0, 0]}}", ["normal is [0, 0]"]),
    ("    - size: {truncated: {}}", ["size.truncated has no key", "minimum, maximum"]),
    ("    - size: {truncated: {minimum: 5}}", ["size.truncated: the range", "holds 0 of"]),
    ("    - size: {finer_than: 5}", ["size.finer_than is 5", "from 0.2 to 0.6"]),
    ("    - size: {finer_than: [5]}", ["size.finer_than is [5]", "a number or auto"]),
    ("    - size: {finer_than: automatic}", ["size.finer_than is 'automatic'", "a number or auto"]),
    (
        "    - size: {finer_than: auto}\n    - size: {coarser_than: 0.3}",
        ["regions[1].size.coarser_than is 0.3, but must be auto, as in arrangement.regions[0]"],
    ),
    ("    - size: {constant: 0.3, uniform: {minimum: 1, maximum: 2}}", ["exactly one of"]),
    ("    - circularity: {constant: 0.3}", ["circularity is given", "a law of aspect_ratio"]),
    (
        "    - aspect_ratio: {constant: 2}\n      circularity: {constant: 0.3}",
        ["regions[0].aspect_ratio and arrangement.regions[0].circularity are given"],
    ),
    ("    - aspect_ratio: {constant: 0.3}", ["regions[0].aspect_ratio.constant", "at least 1"]),
    (
        "    - size: {constant: 1}" + graded("points: [[0, 0], [0, 1]]", ONE, ONE),
        ["regions[0].size is given", "graded gives that law already"],
    ),
    ("    -" + graded("points: [[0, 0], [0, 0]]", ONE, ONE), ["graded.points are", "differ"]),
    ("    -" + graded("distances: [0, 1]", ONE, ONE), ["no inside to measure them from"]),
    ("    -" + graded("", ONE, ONE), ["gives neither points nor distances"]),
    (
        "    -" + graded("points: [[0, 0], [0, 1]]", ONE, "{size: {exponential: {scale: 1}}}"),
        ["graded.start and", "same quantities and kinds"],
    ),
    (
        "    -"
        + graded(
            "points: [[0, 0], [0, 1]]",
            "{size: {exponential: {scale: 1}}}",
            "{size: {exponential: {scale: 1, maximum: 2}}}",
        ),
        ["graded.size.exponential must have the same parameters"],
    ),
]


@pytest.mark.parametrize(("regions", "told"), FAULTS, ids=[str(t[0])[:40] for _, t in FAULTS])
def test_faults_are_told_in_one_sentence(tmp_path, regions, told):
    with pytest.raises(InputError) as caught:
        load(tmp_path, regions)
    message = str(caught.value)
    assert message.startswith(str(tmp_path / "s.yaml"))
    assert "\n" not in message and message.endswith(".") and not message.endswith("..")
    for fragment in told:
        assert fragment in message


@pytest.mark.parametrize("name", arrangement.PRIMITIVES)
def test_schema_and_zones_have_the_same_keys_and_defaults(name):
    described = scene_schema()["$defs"]["zone"]["properties"][name]
    fields = dataclasses.fields(arrangement.PRIMITIVES[name])
    assert set(described["properties"]) == {field.name for field in fields}
    needed = {field.name for field in fields if field.default is dataclasses.MISSING}
    assert set(described["required"]) == needed
    defaults = {field.name: field.default for field in fields}
    for key, entry in described["properties"].items():
        if "default" in entry:
            default = entry["default"]
            assert (tuple(default) if isinstance(default, list) else default) == defaults[key]


def test_schema_and_reader_have_the_same_zones():
    described = set(scene_schema()["$defs"]["zone"]["properties"])
    known = {*arrangement.PRIMITIVES, *arrangement.OPERATIONS}
    assert described == known | set(arrangement.MODIFIERS)


def test_reading_an_arrangement_imports_nothing_heavy(tmp_path):
    load(tmp_path, f"    - inside: {{{CIRCLE}}}\n      orientation: {{constant: 0}}")
    code = (
        "import sys; from grainfront.scene import load_scene; load_scene(sys.argv[1]); "
        "print([m for m in ('numba', 'skimage', 'matplotlib', 'scipy.special', 'shapely') "
        "if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "s.yaml")],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.strip() == "[]"
