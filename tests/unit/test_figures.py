"""Pictures: what is drawn is what was given, the bytes are the same every time."""

from __future__ import annotations

import struct
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection

from grainfront import figures
from grainfront.errors import InputError
from grainfront.particles import Cell, Region
from grainfront.polygons import Polygons
from grainfront.statistics import Contacts, Distribution, OrientationRose

sys.path.insert(0, str(Path(__file__).parent / "files"))
import synthetic

EDGES = np.linspace(0.0, 180.0, 25)
SHARES = np.arange(1, 25) / 300
UNIFORM = np.full(24, 1 / 24)
BINNED = Distribution(EDGES, UNIFORM, SHARES, 0.0123, 0.0071)
CONSTANT = Distribution(np.array([1.5, 1.5]), np.ones(1), np.ones(1), 0.0, 0.0)


def packing_figure(columns=12, rows=9, **changes):
    packing = synthetic.packing(columns, rows, np.random.default_rng(0), spikes=0.3)
    packing = replace(packing, **changes)
    return figures.packing(packing, None, length_unit="mm", volume_fractions=[0.5])


def contacts_figure():
    packing = synthetic.packing(12, 9, np.random.default_rng(0))
    left = np.array([i for i in range(12 * 9) if i % 12 < 11])
    pairs = np.stack([left, left + 1], axis=1)
    position = np.stack([packing.x[left] + 0.5, packing.y[left]], axis=1)
    none = np.empty(0, dtype=np.int64)
    contacts = Contacts(pairs, position, np.tile([1.0, 0.0], (len(left), 1)), none, none)
    shares = np.bincount(contacts.per_particle(108)) / 108
    return figures.contacts(packing, contacts, shares, 2 * len(pairs) / 108, length_unit="mm")


def photograph_figure():
    image = np.random.default_rng(0).integers(0, 255, (60, 80), dtype=np.uint8)
    outlines = Polygons.of([np.array([[10, 10], [30, 12], [20, 40.5]])])
    return figures.photograph(image, outlines, title="noise")


PICTURES = {
    "packing": packing_figure,
    "contacts": contacts_figure,
    "photograph": photograph_figure,
    "laws": lambda: figures.laws({"size": BINNED, "orientation": BINNED}, length_unit="mm"),
    "rose": lambda: figures.rose(OrientationRose(EDGES, SHARES, UNIFORM), None),
}


def chunk_names(png: bytes) -> set[bytes]:
    names, at = set(), 8
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        names.add(png[at + 4 : at + 8])
        at += 12 + length
    return names


@pytest.mark.parametrize("name", PICTURES)
def test_equal_data_give_equal_bytes_without_dates(tmp_path, name):
    for file in ("a.png", "b.png"):
        figures.save_png(PICTURES[name](), tmp_path / file)
    png = (tmp_path / "a.png").read_bytes()
    assert png == (tmp_path / "b.png").read_bytes()
    assert chunk_names(png) == {b"IHDR", b"pHYs", b"IDAT", b"IEND"}


def test_the_users_matplotlib_settings_do_not_show(tmp_path):
    import matplotlib

    figures.save_png(packing_figure(), tmp_path / "a.png")
    with matplotlib.rc_context({"font.size": 30, "savefig.dpi": 20, "axes.grid": True}):
        figures.save_png(packing_figure(), tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_no_pyplot_and_no_backend_is_loaded():
    code = (
        "import sys, grainfront.figures\n"
        "heavy = {'matplotlib.pyplot', 'skimage', 'pyvista', 'netCDF4'} & sys.modules.keys()\n"
        "assert not heavy, heavy\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_every_particle_is_drawn_in_the_colour_of_its_size():
    packing = synthetic.packing(12, 9, np.random.default_rng(0), spikes=0.3)
    whole, zoom, bar = packing_figure().axes
    (artist,) = whole.collections
    assert np.array_equal(artist.get_array(), packing.size)
    for i, path in enumerate(artist.get_paths()):
        assert np.array_equal(path.vertices[:-1], packing.polygons.polygon(i))
    assert whole.get_xlim() == (0, 12)
    assert whole.get_ylim() == (0, 9)
    assert zoom.collections[0].norm is artist.norm
    assert "mm" in bar.get_xlabel()
    assert "108 particles" in whole.get_title(loc="left")


def test_the_zoom_shows_the_hulls_behind_the_outlines():
    hulls = synthetic.packing(12, 9, np.random.default_rng(0))
    outlines = synthetic.packing(12, 9, np.random.default_rng(0), spikes=0.3)
    figure = figures.packing(hulls, outlines, length_unit="mm", volume_fractions=[0.6, 0.5])
    behind, front = figure.axes[1].collections
    assert isinstance(behind, PolyCollection)
    assert behind.get_array() is None
    assert front.get_array() is not None
    assert len(behind.get_paths()) == len(front.get_paths())
    assert "0.5000" in figure.axes[0].get_title(loc="left")
    assert "0.6000" in figure.axes[1].get_title(loc="left")


@pytest.mark.parametrize("columns, rows", [(3, 30), (30, 3), (1, 1)])
def test_any_domain_is_drawn(tmp_path, columns, rows):
    figures.save_png(packing_figure(columns, rows), tmp_path / "packing.png")
    assert (tmp_path / "packing.png").stat().st_size > 10_000


def test_what_is_no_part_of_the_domain_is_shaded():
    """Outside the outer ring and in the hole, and nowhere else."""
    ring = shapely.box(0, 0, 12, 9).difference(shapely.box(3, 3, 5, 5))
    figure = packing_figure(domain=Region.of(ring))
    outside = figure.axes[0].patches[0]
    for artist in (*figure.axes[0].collections, *figure.axes[0].patches):
        artist.set_visible(artist is outside)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    pixels = np.asarray(canvas.buffer_rgba())[::-1]
    for point, shaded in (((-0.06, 4), True), ((1, 4), False), ((4, 4), True), ((8, 4), False)):
        column, row = figure.axes[0].transData.transform(point).astype(int)
        assert (pixels[row, column, :3] == 0xC8).all() == shaded
    x_min, x_max = figure.axes[0].get_xlim()
    assert x_min < 0.0 and x_max > 12.0


def test_a_cell_is_drawn_with_what_reaches_over_its_border():
    figure = packing_figure(domain=Cell(0.2, 0.0, 12.0, 9.0, True))
    nodes = synthetic.packing(12, 9, np.random.default_rng(0), spikes=0.3).polygons.nodes
    assert figure.axes[0].get_xlim()[0] == nodes[:, 0].min() < 0.2
    (border, _) = figure.axes[0].patches
    assert (border.get_x(), border.get_width()) == (0.2, 11.8)


def test_branches_of_a_cell_end_at_images():
    packing = synthetic.packing(3, 3, np.random.default_rng(0))
    packing = replace(packing, domain=Cell(0.0, 0.0, 3.0, 3.0, False))
    pairs, position = np.array([[0, 2]]), np.array([[packing.x[0] - 0.5, packing.y[0]]])
    none = np.empty(0, dtype=np.int64)
    contacts = Contacts(pairs, position, np.array([[-1.0, 0.0]]), none, none)
    figure = figures.contacts(packing, contacts, np.ones(1), 2 / 9, length_unit="mm")
    (lines,) = (c for c in figure.axes[1].collections if isinstance(c, LineCollection))
    ends = {tuple(segment[[0, 2], 0]) for segment in lines.get_segments()}
    assert ends == {(packing.x[0], packing.x[2] - 3.0)}


def test_particles_of_one_size_are_drawn(tmp_path):
    figure = packing_figure(size=np.full(108, 0.7))
    figures.save_png(figure, tmp_path / "packing.png")
    norm = figure.axes[0].collections[0].norm
    assert norm.vmin < 0.7 < norm.vmax


def test_laws_show_shares_probabilities_and_errors():
    figure = figures.laws({"aspect_ratio": BINNED, "size": CONSTANT}, length_unit="mm")
    top, constant, bottom, bottom_of_constant = figure.axes
    bars = [p for p in top.patches if hasattr(p, "get_height")]
    assert np.allclose([b.get_height() for b in bars], 100 * SHARES)
    steps = next(p for p in top.patches if hasattr(p, "get_data"))
    assert np.array_equal(steps.get_data().values, 100 * UNIFORM)
    assert np.allclose([b.get_height() for b in bottom.patches], 100 * (SHARES - UNIFORM))
    assert "1.23 %, noise level 0.710 %" in bottom.get_xlabel()
    assert bottom.get_xlabel().startswith("aspect ratio\n")
    assert bottom_of_constant.get_xlabel().startswith("size (mm)\n")
    assert [b.get_height() for b in constant.patches] == [100]
    assert constant.texts[0].get_text() == "constant: 1.5"


def test_contacts_show_the_shares_and_the_network():
    histogram, network = contacts_figure().axes
    shares = [0, 18 / 108, 90 / 108]
    assert np.allclose([b.get_height() for b in histogram.patches], np.multiply(100, shares))
    assert "Z = 1.833" in histogram.texts[0].get_text()
    branches = next(c for c in network.collections if isinstance(c, LineCollection))
    assert all(np.allclose(np.diff(s, axis=0), [0.5, 0]) for s in branches.get_segments())


def test_the_rose_is_isotropic_at_radius_one():
    normals = OrientationRose(EDGES, UNIFORM, None)
    placed, directions = figures.rose(OrientationRose(EDGES, SHARES, UNIFORM), normals).axes
    assert np.allclose([b.get_height() for b in directions.patches], 1)
    assert np.allclose([b.get_height() for b in placed.patches], np.tile(24 * SHARES, 2))
    assert np.allclose(placed.lines[0].get_ydata(), 1)
    assert np.allclose(directions.lines[0].get_ydata(), 1)


def test_the_photograph_shows_every_outline_and_a_closer_look_at_its_middle():
    whole, zoom = photograph_figure().axes
    for axes in (whole, zoom):
        (drawn,) = axes.collections
        assert np.allclose(drawn.get_paths()[0].vertices[:-1], [[10, 10], [30, 12], [20, 40.5]])
    assert np.isclose(np.ptp(zoom.get_xlim()), 80 / 3)
    assert np.isclose(np.mean(zoom.get_ylim()), 29.5)
    assert "1 outlines" in whole.get_title(loc="left")


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(InputError, match="nowhere does not exist"):
        figures.save_png(packing_figure(), tmp_path / "nowhere" / "packing.png")
