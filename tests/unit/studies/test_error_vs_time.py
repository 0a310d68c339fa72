"""Errors against run time: each axis, against what a user would find by other means."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grainfront import api
from grainfront.laws import Constant, Histogram, Lognormal, Normal, Uniform, stratified
from grainfront.particles import Rectangle
from grainfront.polygons import Polygons
from grainfront.scene import ErrorVsTime, PackingEffort, Target, scene_schema
from grainfront.shapes.database import standardised_database
from grainfront.shapes.sources import FourierGrains, LabelMasks, Rectangles
from grainfront.studies.error_vs_time import AXES, measure_axes
from grainfront.studies.error_vs_time.checks import measure_checks
from grainfront.studies.error_vs_time.domain import measure_domain
from grainfront.studies.error_vs_time.drawing import (
    deficit_controlled,
    independent,
    measure_drawing,
)
from grainfront.studies.error_vs_time.effort import measure_effort
from grainfront.studies.error_vs_time.outlines import measure_outlines, reference_outlines
from grainfront.studies.error_vs_time.record import pareto_front
from grainfront.studies.error_vs_time.target import measure_target

SEEDS = [3, 4]
TINY = Path(__file__).parents[3] / "config/scenes/tiny.yaml"


@pytest.fixture(scope="module")
def scene():
    """A few dozen grains at little effort, in a domain that is no square and off the origin."""
    loaded = api.load_scene(TINY)
    return replace(
        loaded,
        shapes=FourierGrains(vertices=32, count=60, d2=0.15, d3=0.1, d8=0.03),
        domain=Rectangle(3.0, -2.0, 15.0, 7.0),
        packing=PackingEffort(n_angle=4, n_loc=2, n_bin=24),
    )


@pytest.fixture(scope="module")
def database(scene):
    return api.build_shapes(scene)


def shapes_of(record, n_repeats):
    """The number of points, after checking that all arrays are about as many."""
    n = record.settings[next(iter(record.settings))].size
    assert all(a.shape == (n,) for a in record.settings.values())
    assert all(a.shape in {(n,), (n, len(SEEDS))} for a in record.results.values())
    assert all(a.shape == (n, len(SEEDS), n_repeats) for a in record.seconds.values())
    assert all((a > 0.0).all() for a in record.seconds.values())
    return n


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 5), st.integers(0, 5)), min_size=1, max_size=12))
def test_the_front_is_what_no_other_point_beats(points):
    time, error = np.array(points, dtype=float).T
    expected = [
        not any(t <= x and e <= y and (t, e) != (x, y) for t, e in points) for x, y in points
    ]
    assert pareto_front(time, error).tolist() == expected


def test_the_front_goes_by_medians():
    seconds = np.array([[[1.0, 9.0, 1.0]], [[2.0, 2.0, 2.0]]])
    assert pareto_front(seconds, np.array([[0.5], [0.5]])).tolist() == [1, 0]


def test_effort_takes_all_families_to_twice_the_scenes_own(scene, database):
    record = measure_effort(scene, database, SEEDS, 2)
    assert shapes_of(record, 2) == 12
    pairs = list(zip(record.settings["n_angle"], record.settings["n_loc"], strict=True))
    assert {a for a, _ in pairs} == {1, 2, 4, 8} and {b for _, b in pairs} == {1, 2, 4}
    fraction, deficit = record.results["volume_fraction"], record.results["deficit"]
    packing, _ = api.pack(replace(scene, packing=PackingEffort(2, 4, 24)), database, seed=SEEDS[1])
    i = pairs.index((2, 4))
    assert fraction[i, 1] == pytest.approx(api.volume_fractions(packing)[0], rel=1e-12)
    assert record.results["particles"][i, 1] == packing.x.size
    medians = np.median(fraction, axis=1)
    assert np.allclose(np.median(deficit, axis=1), medians.max() - medians)
    assert record.pareto[np.argmax(medians)] == 1
    assert medians[pairs.index((8, 4))] > medians[0] + 0.02
    again = measure_effort(scene, database, SEEDS, 1)
    assert all(np.array_equal(a, again.results[name]) for name, a in record.results.items())


def test_outlines_err_less_the_more_vertices_they_have(scene, database):
    record = measure_outlines(scene, database, SEEDS, 1)
    shapes_of(record, 1)
    vertices = record.settings["vertices"]
    assert record.settings["tolerance"][0] == 0.0 and 490 < vertices[0] <= 500
    assert vertices[1:].min() >= 8 and (np.diff(vertices[1:]) > 0).all()
    for name in ("area", "perimeter", "aspect_ratio", "circularity", "convexity"):
        error = record.results[f"{name}_error"]
        assert error[0] == 0.0
        assert error[1] > 0.003 and error[-1] < 1e-4
    assert (record.results["volume_fraction_error"][0] == 0.0).all()

    rings = api.build_shapes_of(replace(scene.shapes, vertices=500)).outlines.to_shapely()
    simplified = shapely.simplify(rings, record.settings["tolerance"][2])
    for name, measured in (("area", shapely.area), ("perimeter", shapely.length)):
        expected = np.mean(np.abs(measured(simplified) / measured(rings) - 1))
        assert record.results[f"{name}_error"][2] == pytest.approx(expected, rel=1e-6)


def test_the_fraction_is_that_of_what_the_scene_delivers(scene, database):
    of_hulls = measure_outlines(replace(scene, replacement=False), database, SEEDS, 1)
    of_outlines = measure_outlines(scene, database, SEEDS, 1)
    hulls, outlines = (r.results["volume_fraction"] for r in (of_hulls, of_outlines))
    assert (hulls > outlines).all()


def test_there_is_nothing_to_simplify_in_rectangles(scene):
    plain = replace(
        scene, shapes=Rectangles((1.3, 1.3), 1), matched=None, packing=PackingEffort(1, 1, 24)
    )
    record = measure_outlines(plain, api.build_shapes(plain), SEEDS, 1)
    assert record.settings["vertices"].tolist() == [4.0]
    assert record.results["perimeter_error"].tolist() == [0.0]


def test_the_reference_of_a_traced_grain_is_the_smooth_curve_through_its_nodes(scene):
    angle = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    ellipse = np.column_stack([2.0 * np.cos(angle), np.sin(angle)])
    database = standardised_database(Polygons.of([ellipse]), {})
    traced = replace(scene, shapes=LabelMasks(paths=()))
    (ring,) = reference_outlines(traced, database).to_shapely()
    (polygon,) = database.outlines.to_shapely()
    assert shapely.get_num_coordinates(ring) == 501
    shapely.prepare(ring)
    gap = shapely.distance(ring.exterior, shapely.points(database.outlines.nodes))
    assert gap.max() < 1e-3
    # the ellipse's area over that of the polygon inscribed in it
    inscribed = 20.0 * np.sin(2.0 * np.pi / 40) / np.pi
    assert ring.area / polygon.area == pytest.approx(1.0 / inscribed, rel=2e-4)


LAWS = (
    Uniform(2.0, 3.0),
    Lognormal(1.3, 0.4, minimum=0.5, maximum=3.0),
    Normal(10.0, 2.0),
    Histogram((0.0, 1.0, 2.0, 3.0), (3.0, 0.0, 1.0)),
)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
@pytest.mark.parametrize("n_bin", [1, 6, 24])
def test_no_bin_gets_more_than_its_share_and_one(law, n_bin):
    n = 500
    values = deficit_controlled(law, n, np.random.default_rng(n_bin), n_bin)
    edges, probability = law.bins(n_bin)
    share = np.histogram(values, edges)[0]
    assert share.sum() == n, "values stay within the support"
    assert (share <= probability / probability.sum() * n + 1.0 + 1e-6).all()


@pytest.mark.parametrize("law", LAWS[:2], ids=lambda law: type(law).__name__)
def test_values_follow_the_law_within_a_bin_too(law):
    for draw in (independent, lambda *args: deficit_controlled(*args, n_bin=6)):
        u = np.sort(law.cdf(draw(law, 4000, np.random.default_rng(0))))
        deviation = np.abs(u - (np.arange(4000) + 0.5) / 4000).max()
        assert deviation < 1.63 / np.sqrt(4000), "Kolmogorov and Smirnov, 1 %"


def test_a_constant_law_has_its_value():
    for draw in (independent, stratified, lambda *args: deficit_controlled(*args, n_bin=24)):
        assert draw(Constant(1.5), 5, np.random.default_rng(0)).tolist() == [1.5] * 5


def test_drawing_shows_what_controls_the_errors(scene, database):
    sized = replace(scene, domain=Rectangle(0.0, 0.0, 25.0, 25.0))
    record = measure_drawing(sized, database, SEEDS, 1)
    shapes_of(record, 1)
    method, n_bin = record.settings["method"], record.settings["n_bin"]
    n_angle = record.settings["n_angle"]

    def error(law, *conditions):
        (found,) = record.results[f"{law}_l2_error"][np.logical_and.reduce(conditions)]
        return np.median(found)

    for law in ("size", "orientation"):
        alone = error(law, method == "independent")
        assert error(law, method == "stratified") < 0.6 * alone
        assert error(law, method == "deficit-controlled", n_bin == 24) < 0.3 * alone
        assert error(law, method == "deficit-controlled", n_bin == 6) > 0.6 * alone
    placed = method == "packing"
    for one in (1, 4):
        free = error("orientation", placed, n_bin == 1, n_angle == one)
        assert error("orientation", placed, n_bin == 24, n_angle == one) < 0.2 * free
    packing, _ = api.pack(sized, database, SEEDS[0])
    measured = api.measure(sized, database, packing).distributions
    (row,) = np.flatnonzero(placed & (n_bin == 24) & (n_angle == 4))
    for law, name in (("size", "size"), ("descriptor", "aspect_ratio"), ("orientation",) * 2):
        expected = measured[name].l2_error
        assert record.results[f"{law}_l2_error"][row, 0] == pytest.approx(expected, rel=1e-12)


def test_drawing_without_a_law_of_a_descriptor(scene, database):
    record = measure_drawing(replace(scene, matched=None), database, SEEDS[:1], 1)
    assert np.isnan(record.results["descriptor_l2_error"]).all()
    assert np.isfinite(record.results["size_l2_error"]).all()
    assert record.pareto.any()


def test_domain_keeps_its_proportions_and_fits_a_power(scene, database):
    record = measure_domain(scene, database, SEEDS, 1, fewest=100, most=1000, most_plain=3000)
    assert shapes_of(record, 1) == 7
    plain = record.settings["n_angle"] == 1
    assert plain.sum() == 4 and (record.settings["n_loc"][~plain] == 2).all()
    assert np.allclose(record.settings["width"] / record.settings["height"], 12.0 / 9.0)
    particles = np.median(record.results["particles"], axis=1)
    assert np.allclose(particles[plain], [100, 310, 970, 3000], rtol=0.15)
    fraction, bulk = record.results["volume_fraction"], record.results["volume_fraction_bulk"]
    assert np.array_equal(record.results["wall_effect"], bulk - fraction)
    effect = np.median(record.results["wall_effect"], axis=1)
    assert effect[plain][0] > 2.0 * effect[plain][-1] > 0.0
    assert record.fits["fit_n_angle"].tolist() == [1, 4]
    seconds = np.median(record.seconds["kernel_s"][plain], axis=(1, 2))
    x, y = np.log(particles[plain]), np.log(seconds)
    slope = np.cov(x, y, bias=True)[0, 1] / np.var(x)
    assert record.fits["exponent"][0] == pytest.approx(slope)
    middle = record.fits["coefficient"][0] * np.exp(x.mean()) ** slope
    assert np.log(middle) == pytest.approx(y.mean())


def test_a_plain_scene_has_one_effort_of_domains(scene, database):
    plain = replace(scene, packing=PackingEffort(1, 1, 24))
    record = measure_domain(plain, database, SEEDS, 1, fewest=50, most=50, most_plain=160)
    assert record.fits["fit_n_loc"].tolist() == [1]


@pytest.mark.parametrize("replacement", [True, False])
def test_checks_share_the_whole_time(scene, database, replacement):
    record = measure_checks(replace(scene, replacement=replacement), database, SEEDS, 2)
    n_steps = shapes_of(record, 2)
    steps = record.settings["step"].tolist()
    assert ("replacement" in steps) == replacement and n_steps == 6 + replacement
    assert {"shapes", "packing", "certificate", "contacts", "statistics", "writing"} <= set(steps)
    assert np.allclose(record.results["share"].sum(axis=0), 1.0)


def test_the_axes_listed_are_measured_with_seeds_from_the_scenes_first(scene, database):
    asked = replace(scene, seeds=(7, 1), error_vs_time=ErrorVsTime(("checks", "effort"), 2, 1))
    seeds, records = measure_axes(asked, database)
    assert seeds == [7, 8]
    assert list(records) == ["checks", "effort"]
    assert records["effort"].seconds["kernel_s"].shape == (12, 2, 1)


def test_every_axis_of_the_schema_has_its_study():
    axes = scene_schema()["properties"]["error_vs_time"]["properties"]["axes"]["items"]["enum"]
    assert set(AXES) == set(axes)


def test_a_target_is_reached_within_every_tolerance(scene, database):
    sized = replace(scene, domain=Rectangle(0.0, 0.0, 30.0, 30.0))
    record = measure_target(sized, database, SEEDS, 1)
    shapes_of(record, 1)
    tolerance, prescribed = record.settings["tolerance"], record.settings["prescribed"]
    assert tolerance.tolist() == [0.01, 0.003], "finer ones than the share of a grain are left out"
    fraction = record.results["volume_fraction"]
    assert (np.abs(fraction - prescribed[:, None]) <= tolerance[:, None]).all()
    assert np.array_equal(record.results["deviation"], np.abs(fraction - prescribed[:, None]))
    assert (record.results["packings"] >= 1.0).all()
    ends = [api.pack(s, database, SEEDS[0])[0] for s in (sized, plain_of(sized))]
    dense, loose = (api.volume_fractions(api.replace(p, database))[0] for p in ends)
    assert loose < prescribed[0] < dense


def test_a_target_is_the_scenes_own_where_it_has_one(scene, database):
    aimed = replace(scene, domain=Rectangle(0.0, 0.0, 30.0, 30.0), target=Target(0.73, 0.001))
    record = measure_target(aimed, database, SEEDS[:1], 1)
    assert set(record.settings["prescribed"]) == {0.73}


def plain_of(scene):
    """The scene by the plain advancing front method."""
    return replace(scene, packing=PackingEffort(1, 1, 24))
