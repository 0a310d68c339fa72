"""Domains of scenes: what is read, what is refused, and that packings of them fit the rest."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import shapely

from grainfront import api
from grainfront.errors import InputError
from grainfront.particles import Cell, Rectangle, Region
from grainfront.scene import load_scene
from grainfront.studies import effort

MINIMAL = """
seed: 3
domain: {width: 20, height: 10}
shapes: {family: {random_convex_polygon: {vertices: 6, count: 40}}}
size: {uniform: {minimum: 0.8, maximum: 1.2}}
packing: {n_angle: 3, n_loc: 3}
"""
PLAIN = "domain: {width: 20, height: 10}"
L_SHAPE = "domain: {inside: {polygon: {nodes: [[0, 0], [9, 0], [9, 5], [5, 5], [5, 9], [0, 9]]}}}"
CELL = "domain: {width: 20, height: 16, periodic: [x, y]}"
LARGE_L = L_SHAPE.replace("]]}}}", "]]}, scale: {factor: 3, about: [0, 0]}}}")
ARRANGED = """
arrangement:
  regions: [{inside: {circle: {centre: [9, 9], radius: 6}}, size: {finer_than: auto}}]
"""


def load(tmp_path, *changes):
    text = MINIMAL
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "s.yaml"
    path.write_text(text, encoding="utf-8")
    return load_scene(path)


def test_a_zone_is_a_domain(tmp_path):
    read = load(tmp_path, (PLAIN, L_SHAPE))
    assert isinstance(read.domain, Region)
    assert read.domain.area == 65.0
    assert (read.domain.width, read.domain.height) == (9.0, 9.0)
    assert read.domain_files == () == read.zone_files
    assert read.domain == load(tmp_path, (PLAIN, L_SHAPE)).domain
    assert read.domain != load(tmp_path, (PLAIN, L_SHAPE.replace("[5, 5]", "[4, 5]"))).domain


def test_a_silhouette_is_a_domain(tmp_path):
    horse = 'domain: {inside: {silhouette: {path: "skimage:horse", centre: [0, 0], width: 60}}}'
    read = load(tmp_path, (PLAIN, horse))
    assert isinstance(read.domain, Region)
    assert read.domain.width == pytest.approx(60.0)
    assert 500 < read.domain.area < 2000
    assert read.domain_files == ()


def test_a_file_of_polygons_is_a_domain(tmp_path):
    (tmp_path / "pond.wkt").write_text("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (2 2, 2 4, 4 4, 2 2))")
    read = load(tmp_path, (PLAIN, "domain: {inside: {file: {path: pond.wkt}}}"))
    assert read.domain.area == 79.0
    assert read.zone_files == (str(tmp_path / "pond.wkt"),)


@pytest.mark.parametrize("axes", ["[x]", "[x, y]", "[y, x]"])
def test_a_cell_repeats_itself(tmp_path, axes):
    domain = f"domain: {{width: 20, height: 10, origin: [1, 2], periodic: {axes}}}"
    assert load(tmp_path, (PLAIN, domain)).domain == Cell(1.0, 2.0, 21.0, 12.0, "y" in axes)


def test_obstacles_are_no_part_of_the_domain(tmp_path):
    (tmp_path / "stones.wkt").write_text("POLYGON ((2 2, 4 2, 4 4, 2 4, 2 2))\n")
    for domain, area in ((PLAIN, 200.0), (L_SHAPE, 65.0)):
        read = load(tmp_path, (PLAIN, f"{domain}\nobstacles: {{path: stones.wkt}}"))
        assert isinstance(read.domain, Region)
        assert read.domain.area == area - 4.0
        assert read.zone_files == (str(tmp_path / "stones.wkt"),)


@pytest.mark.parametrize(
    ("domain", "says"),
    [
        ("domain: {}", ["domain.width is missing", "inside"]),
        ("domain: {height: 5}", ["domain.width is missing", "beside the height"]),
        ("domain: {width: 5}", ["domain.height is missing", "beside the width"]),
        ("domain: {width: 5, height: 5, inside: {circle: {centre: [0, 0], radius: 5}}}",
         ["both inside and width"]),
        ("domain: {origin: [0, 0], inside: {circle: {centre: [0, 0], radius: 5}}}",
         ["domain.origin is given", "come with width"]),
        ("domain: {width: 50, height: 50, periodic: [y]}", ["domain.periodic is ['y']", "[x, y]"]),
        ("domain: {width: 50, height: 50, periodic: [z]}", ["domain.periodic[0] is 'z'", "x, y"]),
        ("domain: {inside: {half_plane: {point: [0, 0], normal: [1, 0]}}}",
         ["domain.inside: the zone has no end"]),
        ("domain: {inside: {circle: {centre: [0, 0], radius: 1}, offset: -2}}",
         ["domain.inside: nothing is left"]),
        ("domain: {inside: {polygon: {nodes: [[0, 0], [9, 9], [9, 0], [0, 9]]}}}",
         ["domain.inside: a polygon is not simple"]),
        ("domain: {inside: {circle: {centre: [0, 0], radius: 0.3}}}",
         ["narrowest side of 0.6", "size 0.8"]),
        ("domain: {inside: {polygon: {nodes: [[0, 0], [9, 8.8], [9, 9]]}}}",
         ["nowhere wide enough", "size 0.8"]),
        (f"{CELL}\n{ARRANGED}", ["arrangement is given, but domain.periodic too"]),
        (f"{CELL}\ntarget_volume_fraction: 0.7", ["target_volume_fraction", "repeats itself"]),
        (f"{L_SHAPE}\ntarget_volume_fraction: 0.7", ["target_volume_fraction", "no plain"]),
        (f"{L_SHAPE}\nerror_vs_time: {{axes: [effort, domain]}}", ["names domain", "no plain"]),
        (f"{CELL}\nobstacles: {{path: stones.wkt}}", ["obstacles", "domain.periodic"]),
        (f"{L_SHAPE}\nobstacles: {{path: none.wkt}}", ["obstacles.path is 'none.wkt'", "none at"]),
        (f"{L_SHAPE}\nobstacles: {{path: stones.wkt}}", ["stones.wkt: Inclusion 0 crosses"]),
        (f"{PLAIN}\nobstacles: {{path: all.wkt}}", ["all.wkt: The inclusions cover the domain"]),
        (f"{L_SHAPE}\nobstacles: {{path: torn.wkt}}", ["obstacles.path:", "torn.wkt: not WKT"]),
    ],
)  # fmt: skip
def test_what_cannot_be_is_told_in_one_sentence(tmp_path, domain, says):
    (tmp_path / "stones.wkt").write_text("POLYGON ((8 4, 12 4, 12 8, 8 4))\n")
    (tmp_path / "all.wkt").write_text("POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0))\n")
    (tmp_path / "torn.wkt").write_text("POLYGON ((8 4, 12\n")
    with pytest.raises(InputError) as error:
        load(tmp_path, (PLAIN, domain))
    told = str(error.value)
    assert told.startswith(f"{tmp_path / 's.yaml'}: ") and told.endswith(".")
    assert told.count("\n") == 0 and ".." not in told
    for part in says:
        assert part in told


@pytest.mark.parametrize("domain", [LARGE_L, CELL, CELL.replace("[x, y]", "[x]")])
def test_packings_are_certified_and_fill_the_domain(tmp_path, domain):
    scene = load(tmp_path, (PLAIN, domain))
    database = api.build_shapes(scene)
    packing, _ = api.pack(scene, database, 3)
    assert api.certify(packing).holds
    again, _ = api.pack(scene, database, 3)
    assert packing.polygons.nodes.tobytes() == again.polygons.nodes.tobytes()
    fraction, _ = api.volume_fractions(packing)
    assert fraction == pytest.approx(packing.area.sum() / scene.domain.area)
    assert 0.6 < fraction < 0.9
    measured = api.measure(scene, database, packing)
    assert measured.empty_area == 0.0
    assert np.isnan(measured.size_correlation.centre) == isinstance(scene.domain, Cell)
    assert api.certify(api.replace(packing, database)).holds


def test_regions_of_a_domain_of_any_shape(tmp_path):
    """A circle of fine grains in an L; areas are those inside the domain."""
    scene = load(tmp_path, (PLAIN, f"{LARGE_L}\n{ARRANGED}"))
    scene = dataclasses.replace(scene, packing=dataclasses.replace(scene.packing, n_loc=8))
    database = api.build_shapes(scene)
    packing, _ = api.pack(scene, database, 1)
    assert api.certify(packing).holds
    regions = api.measure(scene, database, packing).regions
    assert regions.area.sum() == pytest.approx(585.0, rel=0.01)
    assert regions.area[0] == pytest.approx(36.0 * np.pi, rel=0.02)
    assert regions.misplaced == 0.0
    assert regions.mean_size[0] < 0.95 < regions.mean_size[1]
    assert packing.area.sum() / 585.0 > 0.6


def test_a_room_that_stays_empty_is_told(tmp_path, capsys):
    rooms = shapely.box(0, 0, 6, 6).union(shapely.box(8, 2, 14, 8))
    tube = shapely.box(6, 3, 8, 3.2)
    (tmp_path / "rooms.wkt").write_text(rooms.union(tube).wkt)
    scene = load(tmp_path, (PLAIN, "domain: {inside: {file: {path: rooms.wkt}}}"))
    database = api.build_shapes(scene)
    packing, _ = api.pack(scene, database, 1)
    api.warn_of_empty_rooms("packing.nc", packing)
    assert capsys.readouterr().err == ""
    in_one = packing.chosen(np.flatnonzero(packing.x < 7))
    api.warn_of_empty_rooms("packing.nc", in_one)
    told = capsys.readouterr().err
    assert "packing.nc: 1 of 2 rooms" in told and "49 % of its area" in told
    assert "about (11, 5" in told


def test_a_domain_that_few_grains_fit_is_told(tmp_path, capsys):
    cells = [shapely.box(x, y, x + 1.2, y + 1.2) for x in (0, 1.3, 2.6) for y in (0, 1.3, 2.6)]
    (tmp_path / "cells.wkt").write_text(shapely.union_all(cells).wkt)
    scene = load(tmp_path, (PLAIN, "domain: {inside: {file: {path: cells.wkt}}}"))
    packing, _ = api.pack(scene, api.build_shapes(scene), 1)
    api.warn_of_much_left_over("packing.nc", packing)
    drawn = packing.x.size + packing.left_over
    told = f"{packing.left_over} of {drawn} grains drawn found no place"
    assert packing.left_over > 8 and told in capsys.readouterr().err
    fraction, _ = api.volume_fractions(packing)
    half_full = dataclasses.replace(packing, area=packing.area * 0.51 / fraction)
    api.warn_of_much_left_over("packing.nc", half_full)
    assert capsys.readouterr().err == ""


def test_a_region_that_stays_empty_is_told(tmp_path, capsys):
    narrow = "{inside: {circle: {centre: [14, 0.4], radius: 0.5}}, size: {constant: 3}}"
    wide = "{inside: {circle: {centre: [5, 5], radius: 3}}, size: {constant: 0.7}}"
    regions = f"arrangement: {{regions: [{wide}, {narrow}]}}"
    scene = load(tmp_path, (PLAIN, f"{PLAIN}\n{regions}"))
    packing, _ = api.pack(scene, api.build_shapes(scene), 1)
    capsys.readouterr()  # kernels are told where they are compiled
    api.warn_of_empty_regions("packing.nc", scene, packing)
    told = capsys.readouterr().err
    assert told.startswith("grainfront: warning: packing.nc: no particle") and told.count("\n") == 1
    assert "arrangement.regions[1]:" in told


def test_each_domain_has_its_kernels(tmp_path):
    assert api.searches(load(tmp_path)) == ["exhaustive"]
    assert api.searches(load(tmp_path, (PLAIN, L_SHAPE))) == ["exhaustive_outlined"]
    assert api.searches(load(tmp_path, (PLAIN, CELL))) == ["exhaustive", "exhaustive_outlined"]
    arranged = load(tmp_path, (PLAIN, f"{L_SHAPE}\n{ARRANGED}"))
    assert api.searches(arranged) == ["arranged_exhaustive_outlined"]


def test_a_cell_too_narrow_is_refused(tmp_path):
    scene = load(tmp_path, (PLAIN, "domain: {width: 5, height: 20, periodic: [x]}"))
    with pytest.raises(InputError, match=r"s: a periodic cell must be more than .* but is 5"):
        api.pack(scene, api.build_shapes(scene), 1)


@pytest.mark.parametrize(("height", "some"), [(0.8001, False), (0.85, True)])
def test_a_cell_hardly_higher_than_its_grains(tmp_path, height, some):
    """A cell that few grains fit in, or none, is cut out of hardly anything."""
    low = f"domain: {{width: 20, height: {height}, periodic: [x]}}"
    scene = load(tmp_path, (PLAIN, low))
    database = api.build_shapes(scene)
    if some:
        packing, _ = api.pack(scene, database, 1)
        assert 0 < packing.x.size < 20 and api.certify(packing).holds
    else:
        with pytest.raises(
            InputError, match=r"s: no particle fits into the domain of 20 by 0.8001"
        ):
            api.pack(scene, database, 1)


@pytest.mark.parametrize(
    ("region", "told"),
    [
        ("inside: {circle: {centre: [8, 8], radius: 1}}, size: {truncated: {maximum: 1}}",
         r"s: arrangement\.regions\[0\]\.inside lies outside the domain"),
        ("aspect_ratio: {constant: 99}",
         r"s: arrangement\.regions\[0\]\.aspect_ratio: the law goes from 99 to 99"),
    ],
)  # fmt: skip
def test_what_a_region_cannot_have_is_told_with_scene_and_key(tmp_path, region, told):
    """The first lies in the domain's bounding rectangle, where the domain is not."""
    arranged = f"{L_SHAPE}\narrangement: {{regions: [{{{region}}}]}}"
    scene = load(tmp_path, (PLAIN, arranged))
    with pytest.raises(InputError, match=f"^{told}"):
        api.pack(scene, api.build_shapes(scene), 1)


def test_the_effort_of_other_domains_is_not_estimated(tmp_path):
    scene = load(tmp_path, (PLAIN, CELL))
    with pytest.raises(InputError, match="no plain rectangle"):
        effort.recommend(scene, api.build_shapes(scene), 0.7)


def test_a_plain_domain_is_a_plain_rectangle(tmp_path):
    assert type(load(tmp_path).domain) is Rectangle
