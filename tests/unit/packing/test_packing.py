"""Packings of random scenes: what must hold of every one of them."""

import math
import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront.certificate import certify
from grainfront.geometry.placing import place_polygon
from grainfront.geometry.rings import polygon_areas
from grainfront.jit import kernel
from grainfront.packing.front import front_length, member_at, position_of
from grainfront.packing.fronts import advance_to
from grainfront.packing.orientations import orientation_law
from grainfront.packing.pack import fill
from grainfront.packing.prepare import prepare
from grainfront.packing.turns import N_PLACED, WAITING_PLACES
from grainfront.particles import Rectangle
from grainfront.polygons import Polygons
from grainfront.statistics import find_contacts

COMPILED = os.environ.get("NUMBA_DISABLE_JIT") != "1"
UNIFORM = (np.full(24, 1 / 24), np.linspace(0.0, 180.0, 6145))


def rectangle(aspect_ratio):
    return np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [aspect_ratio / 2, 0.5]


def jittered_polygons(count, kinds, rng):
    """Convex polygons of about S = 1 round their centroids."""
    polygons = []
    for _ in range(kinds):
        angle = (np.arange(count) + rng.uniform(-0.3, 0.3, count)) * 2.0 * np.pi / count
        nodes = np.column_stack([np.cos(angle), np.sin(angle)])
        x, y = nodes.T
        cross = x * np.roll(y, -1) - np.roll(x, -1) * y
        centroid = (cross[:, None] * (nodes + np.roll(nodes, -1, axis=0))).sum(0) / cross.sum() / 3
        polygons.append((nodes - centroid) / 1.9)
    return polygons


FAMILIES = {
    "squares": [rectangle(1.0)],
    "rectangles of 1.5": [rectangle(1.5)],
    "rectangles of 4": [rectangle(4.0)],
    "needles of 50": [rectangle(50.0)],
    "triangles": jittered_polygons(3, 50, np.random.default_rng(3)),
    "pentagons": jittered_polygons(5, 50, np.random.default_rng(5)),
    "hulls of 30 nodes": jittered_polygons(30, 50, np.random.default_rng(30)),
    "polygons of 500 nodes": jittered_polygons(500, 2, np.random.default_rng(500)),
}


def pack_family(family, domain, sizes, n_angle, n_loc, seed, law=UNIFORM):
    """Pack a family with sizes drawn uniformly from the range `sizes`."""
    hulls = Polygons.of(FAMILIES[family])
    rng = np.random.default_rng(seed)
    mean_area = polygon_areas(hulls.nodes, hulls.offsets).mean() * np.mean(np.square(sizes))
    n = int(3.0 * domain.area / mean_area) + 20
    shape, size = rng.integers(0, hulls.count, n), rng.uniform(*sizes, n)
    empty = prepare(hulls, shape, size, [orientation_law(*law)], domain, n_angle, n_loc, rng)
    return fill(empty, np.ones(hulls.count))[0]


def square_domain(side, origin=0.0):
    return Rectangle(origin, origin, origin + side, origin + side)


efforts = st.sampled_from([(1, 1), (1, 5), (6, 1), (6, 5)])


@settings(max_examples=40 if COMPILED else 4, deadline=None)
@given(
    st.sampled_from(sorted(FAMILIES)),
    st.floats(0.05, 1.0),
    st.floats(4.0, 14.0),
    st.floats(0.5, 2.0),
    st.sampled_from([0.0, 1e3, -1e6]),
    efforts,
    st.integers(0, 2**32 - 1),
)
def test_no_packing_has_an_exact_overlap(family, smallest, width, height, origin, effort, seed):
    domain = Rectangle(origin, -origin, origin + width, -origin + width * height)
    packing = pack_family(family, domain, (smallest, 1.0), *effort, seed)
    assert packing.left_over <= WAITING_PLACES
    if packing.x.size:
        certificate = certify(packing)
        assert (certificate.overlaps, certificate.across_wall) == (0, 0)


@pytest.mark.compiled
@pytest.mark.parametrize("exponent", [-30, 40])
@pytest.mark.parametrize("effort", [(1, 1), (6, 5)])
def test_a_scene_scaled_by_a_power_of_two_packs_the_same_bits(effort, exponent):
    scale = 2.0**exponent
    packing = pack_family("hulls of 30 nodes", square_domain(12.0), (0.5, 1.0), *effort, 1)
    scaled = pack_family(
        "hulls of 30 nodes", square_domain(12.0 * scale), (0.5 * scale, scale), *effort, 1
    )
    np.testing.assert_array_equal(scaled.polygons.nodes, packing.polygons.nodes * scale)
    np.testing.assert_array_equal(scaled.orientation, packing.orientation)


@pytest.mark.compiled
def test_the_same_seed_packs_the_same_bits_and_another_seed_does_not():
    one, same, other = (
        pack_family("pentagons", square_domain(12.0), (0.5, 1.0), 6, 5, seed).polygons.nodes
        for seed in (7, 7, 8)
    )
    np.testing.assert_array_equal(one, same)
    assert one.shape != other.shape or not np.array_equal(one, other)


@pytest.mark.compiled
def test_every_particle_but_the_lowest_touches_two_others_or_walls():
    packing = pack_family("hulls of 30 nodes", square_domain(20.0), (0.5, 1.0), 6, 5, 2)
    contacts = find_contacts(packing)
    touching = np.bincount(contacts.pairs.ravel(), minlength=packing.x.size)
    touching += np.bincount(contacts.wall_particle, minlength=packing.x.size)
    assert touching.min() >= 2
    assert 2.0 * len(contacts.pairs) / packing.x.size > 3.0


def test_particles_are_the_hulls_scaled_turned_and_moved():
    packing = pack_family("pentagons", square_domain(12.0), (0.5, 1.0), 6, 5, 3)
    hulls = Polygons.of(FAMILIES["pentagons"])
    for p in range(packing.x.size):
        hull = hulls.polygon(packing.shape[p])
        expected = np.empty_like(hull)
        place_kernel(
            hull, packing.size[p], packing.orientation[p], packing.x[p], packing.y[p], expected
        )
        np.testing.assert_array_equal(packing.polygons.polygon(p), expected)
    assert packing.orientation.min() >= 0.0 and packing.orientation.max() < 180.0
    areas = polygon_areas(packing.polygons.nodes, packing.polygons.offsets)
    np.testing.assert_allclose(packing.area, areas, rtol=1e-12)


@kernel
def place_kernel(nodes, size, orientation, x, y, target):
    place_polygon(nodes, 0, nodes.shape[0], size, orientation, x, y, target, 0)


def test_equal_squares_at_zero_degrees_become_a_lattice():
    at_zero = (np.ones(1), np.zeros(257))
    packing = pack_family("squares", square_domain(20.5), (1.0, 1.0), 1, 1, 0, law=at_zero)
    assert packing.x.size == 400


@pytest.mark.compiled
@pytest.mark.parametrize(("n_angle", "n_loc"), [(1, 1), (24, 4)])
def test_orientations_follow_a_law_with_a_gap(n_angle, n_loc):
    angles = np.linspace(0.0, 10.0, 1537)
    quantile = np.concatenate([angles, 90.0 + angles[1:]])
    probabilities = np.array([0.5, 0, 0, 0, 0, 0, 0, 0, 0, 0.5])
    packing = pack_family(
        "rectangles of 1.5", square_domain(30.0), (0.5, 1.0), n_angle, n_loc, 0,
        law=(probabilities, quantile),
    )  # fmt: skip
    low = packing.orientation < 50.0
    within = np.where(low, packing.orientation, packing.orientation - 90.0)
    assert within.min() >= -1e-9 and within.max() <= 10.0 + 1e-9
    assert abs(np.mean(low) - 0.5) < 2.0 / packing.x.size**0.5 / 5.0


@pytest.mark.compiled
@pytest.mark.parametrize("n_angle", [1, 24])
def test_orientations_keep_far_closer_to_the_law_than_chance(n_angle):
    packing = pack_family("rectangles of 1.5", square_domain(40.0), (0.5, 1.5), n_angle, 3, 0)
    shares = np.histogram(packing.orientation, np.linspace(0.0, 180.0, 25))[0] / packing.x.size
    error = math.sqrt(np.sum((shares - 1 / 24) ** 2))
    noise = math.sqrt((1 - 1 / 24) / packing.x.size)
    assert error < 0.2 * noise


def test_grains_too_wide_for_the_domain_do_not_end_the_packing():
    hulls = Polygons.of([rectangle(1.0)])
    size = np.where(np.arange(400) % 10 == 3, 50.0, 1.0)
    empty = prepare(
        hulls, np.zeros(400, dtype=np.int64), size, [orientation_law(*UNIFORM)], square_domain(9.0),
        1, 1, np.random.default_rng(0),
    )  # fmt: skip
    packing, _ = fill(empty, np.ones(1))
    assert packing.x.size >= 64 * 0.7 and packing.size.max() == 1.0
    too_wide = packing.left_over - WAITING_PLACES
    assert 5 <= too_wide <= 15  # every tenth of those drawn


def test_progress_is_told_up_to_the_final_fraction():
    told = []
    hulls = Polygons.of(FAMILIES["squares"])
    empty = prepare(
        hulls, np.zeros(900, dtype=np.int64), np.ones(900), [orientation_law(*UNIFORM)],
        square_domain(20.0), 1, 1, np.random.default_rng(0),
    )  # fmt: skip
    packing, run_time = fill(empty, np.ones(1), lambda *so_far: told.append(so_far))
    assert told == sorted(told) and len(told) > 10
    assert told[-1] == (packing.x.size, pytest.approx(packing.area.sum() / 400.0))
    assert run_time.kernel_s > 0.0


def test_the_front_keeps_its_members_and_their_slots_in_step():
    hulls = Polygons.of(FAMILIES["pentagons"])
    rng = np.random.default_rng(0)
    n = 400
    state = prepare(
        hulls, np.zeros(n, dtype=np.int64), rng.uniform(0.5, 1.0, n), [orientation_law(*UNIFORM)],
        square_domain(12.0), 6, 5, rng,
    )  # fmt: skip
    for limit in range(0, 60, 3):
        advance_to(state, limit)
        front = state.front
        members = np.concatenate(
            [front.member[: front.ends[0]], front.member[front.ends[1] :]]
        ).tolist()
        assert members[0] == -1 and members[-1] == -3 and len(set(members)) == len(members)
        on_front = {m for m in members if m >= 0}
        placed = range(state.counters[N_PLACED])
        assert {p for p in placed if front.slot[p] >= 0} == on_front
        positions = np.empty(len(members), dtype=np.int64)
        positions_kernel(front, positions)
        assert positions.tolist() == list(range(len(members)))


@kernel
def positions_kernel(front, out):
    for p in range(front_length(front)):
        member = member_at(front, p)
        out[p] = position_of(front, member) if member >= 0 else p
