"""Outlines from files, good and bad."""

import json

import numpy as np
import pytest

from grainfront.errors import InputError
from grainfront.shapes.outlines_file import read_outlines

TRIANGLE = [[0, 0], [4, 0], [0, 3]]
CLOCKWISE_SQUARE = [[0, 0], [0, 2], [2, 2], [2, 0], [0, 0]]


def feature(ring):
    geometry = {"type": "Polygon", "coordinates": [ring]}
    return {"type": "Feature", "properties": {}, "geometry": geometry}


def collection(*rings):
    features = [feature(ring) for ring in rings]
    return json.dumps({"type": "FeatureCollection", "features": features})


GOOD = {
    "a.geojson": collection([*TRIANGLE, TRIANGLE[0]], CLOCKWISE_SQUARE),
    "a.wkt": "POLYGON ((0 0, 4 0, 0 3, 0 0))\n\nPOLYGON ((0 0, 0 2, 2 2, 2 0, 0 0))\n",
    "a.csv": "outline,x,y\nt,0,0\nt,4,0\nt,0,3\ns,0,0\ns,0,2\ns,2,2\ns,2,0\n",
}


@pytest.mark.parametrize("name", GOOD)
def test_every_format_gives_the_same_outlines(tmp_path, name):
    (tmp_path / name).write_text(GOOD[name])
    outlines, counts = read_outlines(str(tmp_path / name))
    np.testing.assert_array_equal(outlines.polygon(0), TRIANGLE)
    assert outlines.node_counts.tolist() == [3, 4]
    shapes = outlines.to_shapely()
    assert [g.area for g in shapes] == [6, 4]
    assert all(g.exterior.is_ccw for g in shapes)
    assert counts == {"found": 2, "kept": 2, "hole": 0}


@pytest.mark.parametrize(
    "text",
    [
        "\ufeffoutline,x,y\r\na,0,0\r\na,2,0\r\na,2,1\r\n",
        "outline, x, y\na, 0, 0\na, 2, 0\na, 2, 1\n",
    ],
    ids=["Windows", "spaces"],
)
def test_csv_files_as_spreadsheets_write_them(tmp_path, text):
    path = tmp_path / "a.csv"
    path.write_bytes(text.encode())
    assert read_outlines(str(path))[0].nodes.tolist() == [[0, 0], [2, 0], [2, 1]]


def test_holes_are_filled_and_counted(tmp_path):
    path = tmp_path / "a.wkt"
    path.write_text("POLYGON ((0 0, 9 0, 0 9, 0 0), (1 1, 2 1, 1 2, 1 1))")
    outlines, counts = read_outlines(str(path))
    assert counts["hole"] == 1
    assert outlines.to_shapely()[0].area == 40.5


BAD = [
    ("a.geojson", GOOD["a.geojson"][:90], "line 1: truncated or not JSON"),
    ("a.geojson", collection([[0, 0], [1, 1], [0, 0]]), "feature 1"),
    ("a.geojson", collection(TRIANGLE, [[0, 0], [2, 2], [2, 0], [0, 2]]), "feature 2.*simple"),
    ("a.geojson", collection([[0, 0], [1, float("nan")], [1, 1], [0, 1]]), "feature 1.*finite"),
    ("a.geojson", '{"type": "Point", "coordinates": [0, 0]}', "feature 1: a Point"),
    ("a.geojson", "[1, 2]", "GeoJSON is one object"),
    ("a.geojson", '{"type": "FeatureCollection", "features": []}', "no outline"),
    ("a.wkt", "POLYGON ((0 0, 1 0, 0 1, 0 0))\nPOLYGON ((0 0, 1", "line 2: not WKT"),
    ("a.wkt", "POLYGON ((0 0, 1e999 0, 1 1, 0 0))", "line 1.*finite"),
    ("a.wkt", "", "no outline"),
    ("a.csv", "outline,x\n1,2\n", "line 1: the columns"),
    ("a.csv", "outline,x,y\na,0,0\na,one,0\n", "line 3: x = 'one'"),
    ("a.csv", "outline,x,y\na,0,0\na,1,nan\na,1,1\n", "outline a: a coordinate"),
    ("a.csv", "outline,x,y\na,0,0\na,1,0\n", "outline a: 2 distinct vertices"),
    ("a.csv", "outline,x,y\na,0,0\na,1,0\na,2,0\n", "outline a.*simple"),
    ("a.txt", "", "files ending in"),
    ("a.geojson", '{"type": "FeatureCollection", "features": null}', "features are None"),
    ("a.geojson", '{"type": "Feature", "geometry": null}', "feature 1: no GeoJSON geometry"),
    ("a.geojson", "[" * 100_000, "nested too deeply"),
    ("a.geojson", collection([[0, 0], [2e200, 0], [2e200, 2e200]]), "feature 1.*2e\\+200 wide"),
    ("a.geojson", collection([[0, 0], [1, 0], [1, 1e-14]]), "feature 1.*too thin"),
    ("a.wkt", "CURVEPOLYGON (CIRCULARSTRING (0 0, 4 0, 4 4, 0 4, 0 0))", "line 1: not WKT"),
    ("a.csv", "", "line 1: the columns are missing"),
    ("a.csv", "outline;x;y\n", "the columns are outline;x;y; outline, x and y are needed"),
    ("a.csv", f"outline,x,y\n{'a' * 200_000},0,0\n", "field larger than field limit"),
]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(("name", "text", "message"), BAD)
def test_bad_files_are_told_by_file_and_place(tmp_path, name, text, message):
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(InputError, match=message) as caught:
        read_outlines(str(path))
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_missing_file_is_named():
    with pytest.raises(InputError, match=r"nowhere\.csv"):
        read_outlines("nowhere.csv")
