"""Sweeps: which packings they make, how these are dealt out, and what is measured of each."""

from __future__ import annotations

import dataclasses
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront import api
from grainfront.errors import InputError
from grainfront.laws import Constant, Uniform
from grainfront.particles import Rectangle
from grainfront.scene import PackingEffort, Scene, Sweep, Target
from grainfront.shapes.sources import Rectangles
from grainfront.studies import sweep


def scene(n_angle=(3, 1), n_loc=(2, 9), seeds=2, **changes) -> Scene:
    """About 100 rectangles."""
    small = Scene(
        name="small",
        text="",
        length_unit="mm",
        seeds=(5,),
        domain=Rectangle(0.0, 0.0, 14.0, 14.0),
        shapes=Rectangles(aspect_ratio=(1.5, 1.5), count=1),
        size=Uniform(0.8, 1.6),
        matched=("aspect_ratio", Constant(1.5)),
        orientation=Uniform(0.0, 180.0),
        packing=PackingEffort(n_angle=24, n_loc=20, n_bin=12),
        sweep=Sweep(tuple(n_angle), tuple(n_loc), seeds),
    )
    return dataclasses.replace(small, **changes)


@pytest.fixture(scope="module")
def database():
    return api.build_shapes(scene())


def without_times(results):
    """Numbers by point, but for the run times."""
    return {
        point: {name: value for name, value in numbers.items() if name != "kernel_s"}
        for point, numbers in results
    }


def test_all_pairs_with_the_same_seeds():
    assert sweep.points(scene(n_angle=(3, 1), n_loc=(2,), seeds=2)) == [
        (1, 2, 5), (1, 2, 6), (3, 2, 5), (3, 2, 6)
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("n_loc", "searches"),
    [((2,), ["exhaustive"]), ((8, 20), ["pruned"]), ((20, 2), ["exhaustive", "pruned"])],
)
def test_the_searches_that_the_pairs_need(n_loc, searches):
    assert sweep.searches(scene(n_loc=n_loc)) == searches


efforts = st.lists(st.integers(1, 200), min_size=1, max_size=8, unique=True)


@given(n_angle=efforts, n_loc=efforts, seeds=st.integers(1, 4), count=st.integers(1, 9))
@settings(max_examples=50, deadline=None)
def test_chunks_share_out_all_packings_at_about_equal_cost(n_angle, n_loc, seeds, count):
    at = scene(n_angle, n_loc, seeds)
    parts = sweep.chunks(at, count)
    assert len(parts) == count
    assert sorted(point for part in parts for point in part) == sorted(sweep.points(at))
    cost = [sum(sweep.estimated_seconds(at, point) for point in part) for part in parts]
    longest = max(sweep.estimated_seconds(at, point) for point in sweep.points(at))
    assert max(cost) - min(cost) <= longest * (1 + 1e-9)


@given(n_angle=efforts, n_loc=efforts, seconds=st.floats(1e-6, 1e3))
@settings(max_examples=50, deadline=None)
def test_chunks_take_as_long_as_is_asked_for_or_are_alone(n_angle, n_loc, seconds):
    at = scene(n_angle, n_loc)
    total = math.fsum(sweep.estimated_seconds(at, point) for point in sweep.points(at))
    count = sweep.chunk_count(at, seconds)
    assert 1 <= count <= len(sweep.points(at))
    assert count == 1 or total / count >= seconds * (1 - 1e-9)
    assert count == len(sweep.points(at)) or total / (count + 1) < seconds * (1 + 1e-9)


def test_more_effort_is_estimated_to_take_longer():
    at = scene()
    for less, more in [((1, 1), (2, 1)), ((6, 5), (6, 6)), ((24, 20), (48, 20))]:
        assert sweep.estimated_seconds(at, sweep.Point(*less, 1)) < sweep.estimated_seconds(
            at, sweep.Point(*more, 1)
        )


def test_a_point_is_the_packing_of_a_scene_with_that_effort_and_seed(database):
    numbers = sweep.measure_point(scene(), database, sweep.Point(3, 9, 6))
    alone = scene(packing=PackingEffort(n_angle=3, n_loc=9, n_bin=12), sweep=None)
    packing, _ = api.pack(alone, database, 6)
    measured = api.measure(alone, database, packing)
    assert numbers.pop("kernel_s") > 0
    for law in ("size", "aspect_ratio", "orientation"):
        placed = measured.distributions[law]
        assert numbers.pop(f"{law}_l2_error") == placed.l2_error
        assert numbers.pop(f"{law}_noise_level") == placed.noise_level
    assert numbers == {name: getattr(measured, name) for name in numbers}
    assert set(numbers) == {
        "volume_fraction", "volume_fraction_bulk", "coordination_number", "particles", "left_over"
    }  # fmt: skip


def test_the_map_does_not_depend_on_the_target(database):
    point = sweep.Point(3, 2, 5)
    targeted = scene(target=Target(0.7, 0.001))
    results = [(point, sweep.measure_point(at, database, point)) for at in (scene(), targeted)]
    assert without_times(results[:1]) == without_times(results[1:])


def test_threads_do_not_change_the_numbers(database):
    wanted = sweep.points(scene())
    one, two = (
        without_times(sweep.pack_points(scene(), database, wanted, threads)) for threads in (1, 2)
    )
    assert one == two
    assert set(one) == set(wanted)


def test_a_fault_ends_the_sweep(database):
    narrow = scene(domain=Rectangle(0.0, 0.0, 0.85, 14.0), size=Uniform(0.8, 16.0), seeds=1000)
    with pytest.raises(InputError, match="small"):
        list(sweep.pack_points(narrow, database, sweep.points(narrow), 2))
