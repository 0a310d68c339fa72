"""The shape database from every kind of source."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
from skimage import io

from grainfront.errors import InputError
from grainfront.shapes.database import build_database
from grainfront.shapes.descriptors import feret
from grainfront.shapes.images import find_outlines
from grainfront.shapes.sources import (
    BinaryMasks,
    FourierGrains,
    LabelMasks,
    OutlinesFile,
    Photographs,
    RandomConvexPolygons,
    Rectangles,
    RegularPolygon,
    Segmentation,
)

SHARED_MASKS = sorted(
    (Path(__file__).parents[4] / "shared" / "data" / "imagegrains_fh").glob("*_labels.png")
)


def assert_standardised(database):
    assert database.count == database.hulls.count > 0
    assert database.hulls.nodes.tobytes() == database.outlines.nodes[database.hull_nodes].tobytes()
    hulls, outlines = database.hulls.to_shapely(), database.outlines.to_shapely()
    assert (
        shapely.is_valid(outlines).all()
        and shapely.is_ccw(shapely.get_exterior_ring(outlines)).all()
    )
    np.testing.assert_allclose(shapely.get_coordinates(shapely.centroid(hulls)), 0, atol=1e-12)
    for i in range(database.count):
        found = feret(database.hulls.polygon(i))
        assert found.size == pytest.approx(1, rel=1e-12)
        # The smallest of tied angles may be any angle before rounding; all others stay level.
        assert min(found.orientation, 180 - found.orientation) == pytest.approx(0, abs=1e-9)
        assert found.length == pytest.approx(database.descriptors["aspect_ratio"][i])
    assert shapely.covers(hulls, outlines).all()
    assert all(v.shape == (database.count,) for v in database.descriptors.values())


@pytest.mark.parametrize(
    "source",
    [
        Rectangles((1.0, 3.0), 5),
        RegularPolygon(3),
        RegularPolygon(7),
        RegularPolygon(8),
        RandomConvexPolygons(15, 30),
        FourierGrains(count=30),
        BinaryMasks(("skimage:horse",), dark_grains=True),
        Photographs(("skimage:coins",)),
    ],
)
def test_databases_are_standardised(source):
    assert_standardised(build_database(source, np.random.default_rng(1)))


def test_the_default_photograph():
    database = build_database(Photographs(), np.random.default_rng(1))
    assert_standardised(database)
    assert database.count > 300
    counts = database.counts
    assert counts["kept"] == database.count
    dropped = ("border", "speck", "clump", "self_crossing")
    assert counts["found"] == counts["kept"] + sum(counts[reason] for reason in dropped)
    # Crushed gravel: mostly compact, some elongated grains (not spherical, not needles).
    assert 1.3 < np.median(database.descriptors["aspect_ratio"]) < 1.8
    assert np.median(database.hulls.node_counts) <= 36


def test_outlines_of_the_default_photograph_lie_on_bright_grains():
    found = find_outlines(Photographs())[0]
    y, x = np.mgrid[: found.image.shape[0], : found.image.shape[1]]
    points = shapely.points(x.ravel(), y.ravel())
    union = shapely.union_all(shapely.buffer(found.outlines.to_shapely(), 0))
    shapely.prepare(union)
    inside = shapely.contains(union, points).reshape(found.image.shape)
    assert found.image[inside].mean() > found.image[~inside].mean() + 0.05
    assert len(found.outlines.to_shapely()) == found.counts["kept"]


def test_random_sources_repeat_with_the_same_generator():
    source = FourierGrains(count=5)
    one, two = (build_database(source, np.random.default_rng(7)) for _ in range(2))
    assert one.outlines.nodes.tobytes() == two.outlines.nodes.tobytes()


def test_size_and_orientation_are_those_of_the_source(tmp_path):
    path = tmp_path / "a.wkt"
    path.write_text("POLYGON ((10 10, 13 14, 11.4 15.2, 8.4 11.2, 10 10))")  # 5 × 2, turned
    found = build_database(OutlinesFile(str(path)), np.random.default_rng(1)).descriptors
    assert found["size"][0] == pytest.approx(2)
    assert found["aspect_ratio"][0] == pytest.approx(2.5)
    assert found["orientation"][0] == pytest.approx(np.degrees(np.arctan2(4, 3)))


def test_images_are_read_with_y_upwards(tmp_path):
    mask = np.zeros((80, 80), np.uint8)
    row, column = np.mgrid[:80, :80]
    # Rising to the right as one sees it: rows fall while columns grow.
    along, across = (column - 40) - (row - 40), (column - 40) + (row - 40)
    mask[(abs(along) < 40) & (abs(across) < 15)] = 255
    path = str(tmp_path / "rising.png")
    io.imsave(path, mask, check_contrast=False)
    database = build_database(BinaryMasks((path,)), np.random.default_rng(1))
    assert database.descriptors["orientation"][0] == pytest.approx(45, abs=1)


@pytest.mark.skipif(not SHARED_MASKS, reason="the shared label masks are absent")
def test_the_seven_label_masks_make_one_database():
    assert len(SHARED_MASKS) == 7
    source = LabelMasks(tuple(str(path) for path in SHARED_MASKS))
    database = build_database(source, np.random.default_rng(1))
    assert_standardised(database)
    assert database.counts["found"] == 948
    assert database.counts["border"] == 162
    # 449 have a raw contour of 60 pixels, which is 57 without its staircase.
    assert database.count == pytest.approx(449, abs=5)


def test_bad_images_are_named(tmp_path):
    text = tmp_path / "text.png"
    text.write_text("no image")
    truncated = tmp_path / "truncated.png"
    rng = np.random.default_rng(1)
    io.imsave(str(truncated), rng.integers(0, 255, (99, 99), dtype=np.uint8), check_contrast=False)
    truncated.write_bytes(truncated.read_bytes()[:3000])
    empty = tmp_path / "empty.png"
    io.imsave(str(empty), np.zeros((40, 40), np.uint8), check_contrast=False)
    dots = tmp_path / "dots.png"
    io.imsave(str(dots), np.eye(40, dtype=np.uint8) * 255, check_contrast=False)
    for path, message in [
        (tmp_path / "missing.png", "there is no such image"),
        (text, "not a readable image"),
        (truncated, "not a readable image"),
        (empty, "no grain|single grey value"),
        ("skimage:astronaut", "skimage:gravel"),
    ]:
        for source in (BinaryMasks((str(path),)), Photographs((str(path),))):
            with pytest.raises(InputError, match=message) as caught:
                build_database(source, rng)
            assert str(path) in str(caught.value)
    with pytest.raises(InputError, match=r"empty\.png.*no grain"):
        build_database(LabelMasks((str(empty),)), rng)
    for name, dtype, message in [
        ("complex.tif", np.complex64, "not finite real numbers"),
        ("huge.tif", np.float64, "too far apart"),
    ]:
        pixels = np.where(np.eye(40), 1.7e308, -1.7e308) if dtype == np.float64 else np.eye(40)
        io.imsave(str(tmp_path / name), pixels.astype(dtype), check_contrast=False)
        with pytest.raises(InputError, match=f"{name}: .*{message}"):
            build_database(Photographs((str(tmp_path / name),)), rng)
    with pytest.raises(InputError, match=r"dots\.png: no grain to keep.*speck"):
        build_database(BinaryMasks((str(dots),)), rng)


def test_an_even_block_is_bad_input():
    with pytest.raises(InputError, match="block_size is 50"):
        find_outlines(Photographs(segmentation=Segmentation(block_size=50)))


def test_a_family_imports_no_image_code():
    code = (
        "import sys, numpy as np\n"
        "from grainfront.shapes.database import build_database\n"
        "from grainfront.shapes.sources import Rectangles\n"
        "build_database(Rectangles(), np.random.default_rng(1))\n"
        "assert not [m for m in sys.modules if m.startswith(('skimage', 'matplotlib', 'xarray'))]"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
