"""The library: what it offers, that stages fit together, and that seeds decide and units do not."""

from __future__ import annotations

import dataclasses
import subprocess
import sys

import numpy as np
import pytest

import grainfront
from grainfront import api
from grainfront.errors import InputError
from grainfront.from_scene.packing import _draw_enough
from grainfront.laws import Constant, Lognormal, Uniform
from grainfront.particles import Rectangle
from grainfront.scene import PackingEffort, Scene
from grainfront.shapes.sources import FourierGrains, RandomConvexPolygons


def scene(**changes) -> Scene:
    """About 100 grains, packed by the plain advancing front method."""
    small = Scene(
        name="small",
        text="",
        length_unit="mm",
        seeds=(1,),
        domain=Rectangle(0.0, 0.0, 16.0, 16.0),
        shapes=FourierGrains(count=40, d2=0.15, d3=0.1),
        size=Uniform(1.0, 2.0),
        matched=("aspect_ratio", Uniform(1.2, 1.4)),
        orientation=Uniform(0.0, 180.0),
        packing=PackingEffort(n_angle=1, n_loc=1, n_bin=12),
        replacement=True,
    )
    return dataclasses.replace(small, **changes)


@pytest.fixture(scope="module")
def database():
    return grainfront.build_shapes(scene())


def test_importing_the_package_costs_nothing():
    code = (
        "import sys, grainfront\n"
        "assert 'numpy' not in sys.modules\n"
        "grainfront.load_scene\n"
        "assert not {'numba', 'shapely', 'skimage', 'matplotlib'} & set(sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_what_is_offered_is_there():
    for name in grainfront.__all__:
        assert getattr(grainfront, name) is getattr(api, name)
    with pytest.raises(AttributeError, match="no attribute 'packs'"):
        grainfront.packs  # noqa: B018


def test_stages_fit_together(database):
    told = []
    packing, run_time = grainfront.pack(scene(), database, 1, lambda *so_far: told.append(so_far))
    assert packing.x.size > 50 and run_time.kernel_s > 0
    assert told[-1] == (packing.x.size, pytest.approx(packing.area.sum() / packing.domain.area))
    assert grainfront.certify(packing).holds
    replaced = grainfront.replace(packing, database)
    assert grainfront.certify(replaced).holds
    assert replaced.area.sum() < packing.area.sum()
    measured = grainfront.measure(scene(), database, packing)
    assert set(measured.distributions) == {"size", "aspect_ratio", "orientation"}
    assert measured.volume_fraction == api.volume_fractions(packing)[0]


def test_a_matched_descriptor_other_than_the_aspect_ratio_is_measured(database):
    values = database.descriptors["circularity"]
    law = Uniform(float(values.min()), float(values.max()))
    matched = scene(matched=("circularity", law))
    packing, _ = grainfront.pack(matched, database, 1)
    measured = grainfront.measure(matched, database, packing)
    edges, _ = law.bins(24)
    expected = np.histogram(values[packing.shape], edges)[0] / packing.x.size
    assert np.array_equal(measured.distributions["circularity"].shares, expected)


def test_the_seed_decides_the_packing_and_not_the_shapes(database):
    again = grainfront.build_shapes(scene(seeds=(7, 8)))
    assert np.array_equal(again.outlines.nodes, database.outlines.nodes)
    first, same, other = (grainfront.pack(scene(), database, seed)[0] for seed in (1, 1, 2))
    assert np.array_equal(first.polygons.nodes, same.polygons.nodes)
    assert not np.array_equal(first.size[:20], other.size[:20])


def test_twice_the_lengths_give_twice_the_packing(database):
    packing, _ = grainfront.pack(scene(), database, 1)
    double = scene(domain=Rectangle(0.0, 0.0, 32.0, 32.0), size=Uniform(2.0, 4.0))
    doubled, _ = grainfront.pack(double, database, 1)
    assert np.array_equal(doubled.polygons.nodes, 2.0 * packing.polygons.nodes)


@pytest.mark.parametrize(
    "size",
    [Constant(3.0), Lognormal(median=0.4, log_standard_deviation=1.2, maximum=8.0)],
    ids=["few", "broad"],
)
def test_enough_is_drawn_that_not_all_can_be_placed(database, size):
    some = scene(size=size)
    shape, drawn = _draw_enough(some, database, some, some.domain.area, (1, 1))
    area = database.descriptors["hull_area"][shape] * drawn**2
    assert np.sort(area)[:-8].sum() >= some.domain.area


def test_shapes_that_cannot_follow_a_law_are_told(database, capsys):
    beyond = scene(matched=("aspect_ratio", Uniform(1.2, 9.0)))
    found = grainfront.shape_coverage(beyond, database)
    assert found.empty_bins > 10
    api.warn_of_uncovered(beyond, database)
    assert f"{found.empty_bins} of 24 bins of the aspect_ratio law" in capsys.readouterr().err
    assert grainfront.shape_coverage(scene(matched=None), database) is None
    api.warn_of_uncovered(scene(matched=None), database)
    assert capsys.readouterr().err == ""


def test_convex_shapes_have_no_regularity_to_follow():
    convex = scene(shapes=RandomConvexPolygons(count=10), matched=("regularity", Uniform(1.0, 2.0)))
    with pytest.raises(InputError, match="regularity of a convex outline is infinite"):
        grainfront.pack(convex, grainfront.build_shapes(convex), 1)


def test_a_domain_without_room_for_any_grain_is_refused(database):
    narrow = scene(domain=Rectangle(0.0, 0.0, 1.0, 0.5), size=Constant(2.0))
    with pytest.raises(InputError, match=r"no particle fits into the domain of 1 by 0\.5 mm"):
        grainfront.pack(narrow, database, 1)


def test_a_law_that_no_shape_meets_is_told_with_its_key(database):
    beyond = scene(matched=("aspect_ratio", Constant(50.0)))
    with pytest.raises(InputError, match="aspect_ratio: the law goes from 50 to 50, but must meet"):
        grainfront.pack(beyond, database, 1)


def test_a_domain_too_far_from_the_origin_is_refused(database):
    far = scene(domain=Rectangle(1e12, 0.0, 1e12 + 20.0, 20.0), size=Constant(2.0))
    with pytest.raises(InputError, match=r"coordinate of 1e\+12, but must stay within 7\.04e\+07"):
        grainfront.pack(far, database, 1)


def test_want_of_memory_is_told_in_one_sentence():
    assert api.sentence(MemoryError()) == (
        "grainfront: the memory of this machine does not suffice (MemoryError)."
    )


def test_a_certificate_that_does_not_hold_is_told(database):
    packing, _ = grainfront.pack(scene(), database, 1)
    nodes = packing.polygons.nodes.copy()
    nodes[: packing.polygons.offsets[1]] -= 0.25
    moved = dataclasses.replace(
        packing, polygons=dataclasses.replace(packing.polygons, nodes=nodes)
    )
    with pytest.raises(InputError, match=r"x\.nc: the certificate does not hold: .* 1 particles"):
        api.require_certificate("x.nc", moved)
