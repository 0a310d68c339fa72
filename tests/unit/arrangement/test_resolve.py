"""Zones to polygons: motions, offsets, images, files, and what is refused."""

import json
import os
from pathlib import Path

import numpy as np
import pytest
import shapely
import skimage.data
import skimage.io
from shapely import affinity

from grainfront.arrangement.resolve import resolve, resolve_bounded
from grainfront.arrangement.zones import (
    Bars,
    Box,
    Difference,
    HalfPlane,
    Moved,
    Offset,
    Polygon,
    PolygonsFile,
    Silhouette,
    Union,
)
from grainfront.errors import InputError
from grainfront.particles import Rectangle

DOMAIN = Rectangle(0.0, 0.0, 20.0, 10.0)
DATA = Path(__file__).parents[4] / "shared" / "data" / "silhouettes"


def same(found, wanted, tolerance=1e-9):
    return shapely.symmetric_difference(found, wanted).area <= tolerance


def test_motions_are_those_of_shapely():
    nodes = ((1.0, 1.0), (6.0, 2.0), (4.0, 3.0), (5.0, 7.0))
    inner = Moved(Polygon(nodes), scale=1.5, about=(2.0, 2.0))
    zone = Moved(Moved(inner, angle=33.0, about=(1.0, 5.0)), shift=(0.5, -2.0))
    wanted = affinity.scale(shapely.Polygon(nodes), 1.5, 1.5, origin=(2.0, 2.0))
    wanted = affinity.rotate(wanted, 33.0, origin=(1.0, 5.0))
    wanted = affinity.translate(wanted, 0.5, -2.0)
    assert same(resolve(zone, DOMAIN).polygon, wanted)


@pytest.mark.parametrize("angle", [90.0, -90.0, 180.0, 450.0])
def test_quarter_turns_are_exact(angle):
    polygon = resolve(Moved(Box((0.0, 0.0), 4.0, 2.0), angle=angle), DOMAIN).polygon
    assert np.array_equal(np.unique(np.abs(shapely.get_coordinates(polygon))), [1.0, 2.0])


def test_what_is_moved_without_end_stays_without_end():
    """Bars and half-planes are cut off only after they were moved."""
    bars = Moved(Bars(1.0, 4.0), scale=0.5, angle=90.0, about=(2.0, 0.0))
    part = resolve(bars, DOMAIN).within(DOMAIN)
    wanted = [shapely.box(x - 0.25, 0.0, x + 0.25, 10.0) for x in np.arange(0.0, 21.0, 2.0)]
    assert same(part, shapely.union_all(wanted).intersection(shapely.box(0.0, 0.0, 20.0, 10.0)))
    half = Moved(HalfPlane((0.0, 0.0), (0.0, 1.0)), scale=0.01, shift=(500.0, 5.0))
    assert same(resolve(half, DOMAIN).within(DOMAIN), shapely.box(0.0, 0.0, 20.0, 5.0))


def test_offsets_scale_and_do_not_move_the_cut_of_half_planes():
    half = Moved(Offset(HalfPlane((0.0, 4.0), (0.0, 1.0)), -1.0), scale=2.0)
    assert same(resolve(half, DOMAIN).within(DOMAIN), shapely.box(0.0, 0.0, 20.0, 6.0))
    complement = Difference((HalfPlane((0.0, 9.0), (0.0, 1.0)), Box((10.0, 5.0), 4.0, 2.0)))
    ring = resolve(Offset(complement, -0.5), DOMAIN)
    assert not ring.polygon.contains(shapely.Point(10.0, 6.4))
    assert ring.polygon.contains(shapely.Point(10.0, 6.6))
    assert not ring.polygon.contains(shapely.Point(10.0, 8.6))


def test_a_polygon_with_a_hole():
    hole = ((2.0, 2.0), (4.0, 2.0), (4.0, 4.0))
    zone = Polygon(((1.0, 1.0), (1.0, 9.0), (9.0, 9.0), (9.0, 1.0)), (hole,))
    assert resolve(zone, DOMAIN).polygon.area == pytest.approx(62.0)


@pytest.mark.parametrize(
    ("zone", "told"),
    [
        (Polygon(((0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0))), "not simple"),
        (Polygon(((0.0, 0.0), (2.0, 2.0), (4.0, 4.0))), "not simple"),
        (Bars(1e-6, 2e-6), "apart, which makes"),
        (Silhouette("none.png", (1.0, 1.0), 2.0), "none.png: there is no such image"),
        (Silhouette("skimage:cat", (1.0, 1.0), 2.0), "allowed are skimage:gravel"),
        (PolygonsFile("none.wkt"), "none.wkt: not readable"),
        (PolygonsFile("none.shp"), "files ending in .geojson, .json, .wkt"),
    ],
)
def test_what_cannot_be_had_is_refused(zone, told):
    with pytest.raises(InputError, match=told):
        resolve(Union((Box((1.0, 1.0), 1.0, 1.0), zone)), DOMAIN)


def test_a_zone_may_be_a_domain_where_it_ends():
    hopper = Difference((Box((0.0, 5.0), 10.0, 10.0), HalfPlane((5.0, 5.0), (-1.0, 1.0))))
    assert resolve_bounded(hopper).area == pytest.approx(100.0 - 12.5)
    with pytest.raises(InputError, match="must be bounded"):
        resolve_bounded(HalfPlane((0.0, 0.0), (0.0, 1.0)))
    with pytest.raises(InputError, match="must be bounded"):
        resolve_bounded(Union((Box((0.0, 5.0), 10.0, 10.0), Bars(1.0, 3.0))))
    with pytest.raises(InputError, match="nothing is left"):
        resolve_bounded(Difference((Box((0.0, 0.0), 1.0, 1.0), Box((0.0, 0.0), 2.0, 2.0))))


def draw_disc(path, *, dark, hole=0.0, shift=0):
    """A disc of radius 40 in the middle of 101 × 121 pixels, or nearer to the left border."""
    y, x = np.mgrid[-50:51, -60:61]
    r = np.hypot(x + shift, y)
    figure = (r <= 40.0) & (r >= hole)
    skimage.io.imsave(path, (255 * (figure != dark)).astype(np.uint8), check_contrast=False)
    return str(path)


@pytest.mark.parametrize("dark", [True, False])
def test_a_disc_in_an_image_is_a_disc(tmp_path, dark):
    path = draw_disc(tmp_path / "disc.png", dark=dark)
    polygon = resolve(Silhouette(path, (10.0, 5.0), width=8.0, dark=dark), DOMAIN).polygon
    assert polygon.bounds == pytest.approx((6.0, 1.0, 14.0, 9.0), abs=0.05)
    radius = np.hypot(*(shapely.get_coordinates(polygon) - (10.0, 5.0)).T)
    assert np.abs(radius - 4.0).max() < 0.1  # a pixel
    assert polygon.area == pytest.approx(16 * np.pi, rel=0.02)


def test_figures_may_have_holes_and_touch_the_border(tmp_path):
    ring = draw_disc(tmp_path / "ring.png", dark=True, hole=20.0)
    polygon = resolve(Silhouette(ring, (10.0, 5.0), height=8.0), DOMAIN).polygon
    assert polygon.area == pytest.approx(12 * np.pi, rel=0.03)
    assert not polygon.contains(shapely.Point(10.0, 5.0))
    cut = draw_disc(tmp_path / "cut.png", dark=True, shift=60)
    polygon = resolve(Silhouette(cut, (10.0, 5.0), height=8.0), DOMAIN).polygon
    # the border runs half a pixel left of the centre, and 81 pixels are 8 high
    assert polygon.area == pytest.approx(8 * np.pi + 8.0 * 8.0 / 81 / 2, rel=0.03)


def test_images_without_a_figure_are_refused(tmp_path):
    path = tmp_path / "grey.png"
    skimage.io.imsave(path, np.full((20, 20), 77, dtype=np.uint8), check_contrast=False)
    with pytest.raises(InputError, match="single grey value shows nothing"):
        resolve(Silhouette(str(path), (1.0, 1.0), width=2.0), DOMAIN)
    path.write_bytes(b"not an image")
    with pytest.raises(InputError, match="not a readable image"):
        resolve(Silhouette(str(path), (1.0, 1.0), width=2.0), DOMAIN)


def test_the_shipped_horse_stands_on_its_feet():
    polygon = resolve(Silhouette("skimage:horse", (10.0, 5.0), width=8.0), DOMAIN).polygon
    assert polygon.bounds[0] == pytest.approx(6.0) and polygon.bounds[2] == pytest.approx(14.0)
    below = shapely.intersection(polygon, shapely.box(0.0, 0.0, 20.0, 3.0))
    assert len(shapely.get_parts(below)) >= 4  # legs, and the end of the tail
    rows, columns = np.nonzero(~skimage.data.horse())
    pixel = 8.0 / (np.ptp(columns) + 1)
    assert polygon.area == pytest.approx(rows.size * pixel**2, rel=0.01)
    height = polygon.bounds[3] - polygon.bounds[1]
    assert height == pytest.approx((np.ptp(rows) + 1) * pixel, abs=pixel)


@pytest.mark.skipif(not DATA.is_dir(), reason=f"{os.path.relpath(DATA)} is absent")
@pytest.mark.parametrize("name", ["fontawesome_cow", "noto_cow_body"])
def test_real_silhouettes_have_the_area_of_their_drawings(name):
    drawn = json.loads((DATA / f"{name}_polylines.json").read_text(encoding="utf-8"))
    wanted = shapely.Polygon()
    for ring in drawn["rings"]:
        wanted = shapely.symmetric_difference(wanted, shapely.Polygon(ring["xy"]))
    width = wanted.bounds[2] - wanted.bounds[0]
    zone = Silhouette(str(DATA / f"{name}.png"), (0.0, 0.0), width=width)
    assert resolve(zone, DOMAIN).polygon.area == pytest.approx(wanted.area, rel=0.01)


GEOJSON = {
    "type": "FeatureCollection",
    "features": [
        {
            "type": "Feature",
            "properties": {},
            "geometry": {
                "type": "Polygon",
                "coordinates": [
                    [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]],
                    [[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]],
                ],
            },
        },
    ],
}


@pytest.mark.parametrize(
    ("name", "text", "area"),
    [
        ("a.geojson", json.dumps(GEOJSON), 15.0),
        ("a.json", json.dumps(GEOJSON["features"][0]["geometry"]), 15.0),
        (
            "a.wkt",
            "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))\n\nPOLYGON ((1 1, 3 1, 3 3, 1 3, 1 1))",
            7.0,
        ),
        ("b.wkt", "MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((2 0, 3 0, 2 1, 2 0)))", 1.0),
    ],
)
def test_files_of_polygons(tmp_path, name, text, area):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    assert resolve(PolygonsFile(str(path)), DOMAIN).polygon.area == pytest.approx(area)


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("a.wkt", "POLYGON ((0 0, 1", "not WKT"),
        ("a.wkt", "", "no polygon in this file"),
        ("a.wkt", "POINT (1 1)", "holds a Point"),
        ("a.wkt", "POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))", "not simple"),
        ("a.geojson", "{", "not GEOJSON"),
        ("a.geojson", '{"type": "FeatureCollection", "features": []}', "no polygon"),
    ],
)
def test_faulty_files_are_told(tmp_path, name, text, told):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=told) as caught:
        resolve(PolygonsFile(str(path)), DOMAIN)
    assert str(path) in str(caught.value) and "\n" not in str(caught.value)
