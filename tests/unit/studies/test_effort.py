"""The least effort for a volume fraction: what pilots say of the whole, and what is chosen."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront import api
from grainfront.errors import InputError
from grainfront.laws import Uniform
from grainfront.packing import search_of
from grainfront.particles import Rectangle
from grainfront.scene import PackingEffort, Scene
from grainfront.shapes.sources import FourierGrains, RegularPolygon
from grainfront.studies import effort, pilots
from grainfront.studies.effort import Surface, recommend
from grainfront.studies.pilots import (
    Pilot,
    PilotScale,
    fraction_with_walls_of,
    seconds_in,
)


def scene(**changes) -> Scene:
    """Squares, some hundred of them: pilots are as large as the scene."""
    small = Scene(
        name="small",
        text="",
        length_unit="mm",
        seeds=(1,),
        domain=Rectangle(0.0, 0.0, 15.0, 15.0),
        shapes=RegularPolygon(4),
        size=Uniform(0.5, 1.5),
        matched=None,
        orientation=Uniform(0.0, 180.0),
        packing=PackingEffort(n_angle=2, n_loc=2, n_bin=12),
        target=None,
        sweep=None,
        error_vs_time=None,
        replacement=False,
        outputs=(),
    )
    return dataclasses.replace(small, **changes)


@pytest.fixture(scope="module")
def packed():
    return api.pack(scene(), api.build_shapes(scene()), seed=5)[0]


def test_walls_of_the_whole_take_in_proportion_to_their_length(packing_of):
    # a solid block amid a strip of void, one wide, along the four walls
    block = np.array([[1.0, 1.0], [9.0, 1.0], [9.0, 9.0], [1.0, 9.0]])
    packing = packing_of([block], Rectangle(0.0, 0.0, 10.0, 10.0))
    assert fraction_with_walls_of(packing.domain, packing, 2.0) == pytest.approx(0.64)
    # sides alone: of 8 / 10 of the height all but 2 of the width is solid
    wide = Rectangle(0.0, 0.0, 100.0, 10.0)
    assert fraction_with_walls_of(wide, packing, 2.0) == pytest.approx(0.8 * 0.98)
    large = Rectangle(0.0, 0.0, 1000.0, 100.0)
    assert fraction_with_walls_of(large, packing, 2.0) == pytest.approx(0.998 * 0.98)


def pilot(n_angle: int, n_loc: int, fraction: float, seconds: float, height: float = 1.0) -> Pilot:
    domain = Rectangle(0.0, 0.0, 2.0, height)
    return Pilot(n_angle, n_loc, domain, fraction, 100, 1.0, 1.0, seconds, 0.0)


@given(per_area=st.floats(0.01, 10.0), per_width=st.floats(0.01, 10.0))
def test_seconds_grow_with_the_area_and_with_the_width_of_the_top(per_area, per_width):
    def seconds(domain):
        return per_area * domain.area + per_width * domain.width

    measured = [pilot(1, 1, 0.8, 0.0, height) for height in (1.0, 3.0, 3.0)]
    measured = [p._replace(kernel_s=seconds(p.domain)) for p in measured]
    whole = Rectangle(0.0, 0.0, 7.0, 40.0)
    assert seconds_in(whole, measured) == pytest.approx(seconds(whole), rel=1e-9)
    # pilots of one height say what a wider domain of that height takes
    low = Rectangle(0.0, 0.0, 7.0, 1.0)
    assert seconds_in(low, measured[:1]) == pytest.approx(seconds(low), rel=1e-9)


def test_the_surface_finds_smooth_maps_and_the_switch_between_the_searches_again():
    def fraction(n_angle, n_loc):
        return 0.7 + 0.03 * np.log(n_angle) + 0.02 * np.log(n_loc) - 0.001 * np.log(n_angle) ** 2

    def seconds(n_angle, n_loc):
        if search_of(n_angle, n_loc) == "pruned":
            return 3.0 * n_angle**0.5 * n_loc**0.4
        return n_angle * n_loc**0.9

    pairs = [(a, n) for a in (1, 3, 7, 18, 48) for n in (1, 3, 7, 8, 18, 40)]
    surface = Surface([pilot(*p, fraction(*p), seconds(*p)) for p in pairs], 48, 40)
    for n_angle, n_loc in ((1, 1), (10, 7), (10, 8), (48, 40), (1, 8)):
        at = n_angle - 1, n_loc - 1
        assert surface.volume_fraction[at] == pytest.approx(fraction(n_angle, n_loc), abs=1e-9)
        assert surface.seconds[at] == pytest.approx(seconds(n_angle, n_loc), rel=1e-9)
    assert surface.deviation_of_one < 1e-9


def test_the_deviation_falls_as_the_root_of_the_particles():
    rng = np.random.default_rng(1)
    pairs = [(a, n) for a in (1, 3, 7, 18, 48) for n in (1, 3, 7, 8, 18, 40)] * 40
    noisy = []
    for n, pair in enumerate(pairs):
        particles = 100 if n % 2 else 10_000
        value = 0.8 + 0.1 * rng.standard_normal() / np.sqrt(particles)
        noisy.append(pilot(*pair, value, 1.0)._replace(particles=particles))
    assert Surface(noisy, 48, 40).deviation_of_one == pytest.approx(0.1, rel=0.1)


@given(
    width=st.floats(1.0, 1e4), height=st.floats(1.0, 1e4), scale=st.sampled_from([1e-6, 1.0, 1e6])
)
@settings(max_examples=30, deadline=None)
def test_pilots_lie_in_the_scene_and_have_its_scale(width, height, scale):
    whole = Rectangle(scale, -scale, (1 + width) * scale, (height - 1) * scale)
    of = scene(domain=whole, size=Uniform(0.5 * scale, 1.5 * scale))
    built = PilotScale(of, api.build_shapes(of), 80.0)
    domain = built.domain(16.0)
    assert domain.width == pytest.approx(min(whole.width, domain.width))
    assert domain.height <= whole.height * (1 + 1e-12)
    wanted = 80.0 * 16.0 * built.unit**2
    assert domain.area >= min(wanted, whole.area) * (1 - 1e-9)
    longest = pilots.LONGEST_GRAINS * np.sqrt(2) * 1.5 * scale
    for side, full in ((domain.width, whole.width), (domain.height, whole.height)):
        assert side >= min(full, longest) * (1 - 1e-9)


@pytest.fixture(scope="module")
def found():
    small = scene(domain=Rectangle(0.0, 0.0, 40.0, 25.0))
    told: list[int] = []
    database = api.build_shapes(small)
    return small, database, recommend(small, database, 0.78, told.append), told


def test_the_pair_recommended_reaches_the_target(found):
    small, database, recommended, told = found
    assert recommended.volume_fraction == pytest.approx(0.78, abs=0.015)
    assert 0.0 < recommended.spread < 0.03
    assert 1 <= recommended.n_angle <= 48 and 1 <= recommended.n_loc <= 40
    assert len(told) == recommended.pilots and min(told) > 0
    pair = PackingEffort(recommended.n_angle, recommended.n_loc, 12)
    packing, _ = api.pack(dataclasses.replace(small, packing=pair), database, seed=77)
    # 4 standard deviations: one packing in 16,000 is farther off
    off = packing.area.sum() / packing.domain.area - recommended.volume_fraction
    assert abs(off) < 2 * recommended.spread
    assert packing.x.size == pytest.approx(recommended.particles, rel=0.05)


def test_volume_fractions_repeat(found):
    small, database, recommended, _ = found
    pair = recommended.n_angle, recommended.n_loc
    study = effort._Study(small, database, None)
    again = study._check(pair)
    assert again.volume_fraction == recommended.volume_fraction
    assert again.particles == recommended.particles


def test_outlines_fill_less_than_their_hulls():
    shapes = FourierGrains(count=40, d2=0.15, d3=0.2, vertices=24)
    hulls = scene(shapes=shapes)
    outlines = dataclasses.replace(hulls, replacement=True)
    database = api.build_shapes(hulls)
    of_hulls, of_outlines = (
        pilots.pack_pilot(PilotScale(one, database, 80.0), 2, 2, 16.0, seed=3)
        for one in (hulls, outlines)
    )
    packing = api.replace(api.pack(hulls, database, seed=3)[0], database)
    assert of_outlines.volume_fraction < of_hulls.volume_fraction
    assert of_outlines.volume_fraction == pytest.approx(packing.area.sum() / 15.0**2, rel=1e-9)


@pytest.mark.parametrize("target", [0.3, 0.97])
def test_a_target_out_of_reach_is_told_with_what_can_be_reached(target):
    with pytest.raises(
        InputError, match=rf"small: .* {target} is out of reach: .* from 0\.\d+ .* 0\."
    ):
        recommend(scene(), api.build_shapes(scene()), target)


def test_a_domain_too_small_is_told():
    tiny = scene(domain=Rectangle(0.0, 0.0, 0.52, 0.52))
    with pytest.raises(InputError, match="no particle fits into the domain"):
        recommend(tiny, api.build_shapes(tiny), 0.7)
