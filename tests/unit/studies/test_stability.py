"""The stability matrix: the table of cases, a small twin of it, and that nothing is overlooked."""

from __future__ import annotations

import dataclasses
import subprocess
import sys
from decimal import Decimal, getcontext
from itertools import chain

import numpy as np
import pytest
import shapely

from grainfront import api
from grainfront.errors import InputError
from grainfront.laws import Histogram, Lognormal
from grainfront.packing.state import CLEARANCE_ULPS
from grainfront.particles import Rectangle
from grainfront.studies.stability import measure_stability
from grainfront.studies.stability.case import (
    LEAST_FRACTION,
    MODERATE,
    MOST_E2,
    MOST_GROWTH,
    MOST_LOST,
    PLAIN,
    square,
)
from grainfront.studies.stability.cases import CASES, GROUPS
from grainfront.studies.stability.error_growth import measure_error_growth
from grainfront.studies.stability.expectations import MOST_DEPARTURE, NEVER, unmet
from grainfront.studies.stability.matrix import exponents, measure
from grainfront.studies.stability.rounding import (
    contact_gaps,
    departure,
    lost_to_clearance,
    ulp,
)
from grainfront.studies.stability.run import _pack, run, unaccounted
from grainfront.studies.stability.variants import Mirrored, Scaled, mirrored

SMALL = ("moderate", "equal squares at 0°, domain 7.25", "one particle", "offset by 1e9",
         "all wider than the domain", "slivers 1:30", "offset by 1e6")  # fmt: skip


@pytest.fixture(scope="module")
def rows():
    """A few cases of the matrix, plainly packed, for two seeds."""
    few = {n: dataclasses.replace(CASES[n], efforts=(PLAIN,), seeds=2) for n in SMALL}
    return list(measure(few))


def test_names_are_unique_and_every_exception_has_its_reason():
    assert len(CASES) == 1 + len(list(chain.from_iterable(GROUPS.values())))
    loosest = {"most_growth": MOST_GROWTH, "most_e2": MOST_E2, "most_lost": MOST_LOST}
    for case in CASES.values():
        loose = case.least_fraction < LEAST_FRACTION or any(
            getattr(case, name) > usual for name, usual in loosest.items()
        )
        assert case.reason or not loose, case.name
        assert not case.like or set(case.efforts) <= set(CASES[case.like].efforts), case.name


def test_a_small_twin_of_the_matrix_is_as_expected(rows):
    # times are held to their bounds by the study alone: the machine that runs tests is noisy
    cases = [dataclasses.replace(row.case, most_growth=np.inf) for row in rows]
    untimed = [dataclasses.replace(row, case=case) for row, case in zip(rows, cases, strict=True)]
    assert unmet(untimed) == []
    found = {row.case.name: row.found for row in rows}
    assert "must stay within" in found["offset by 1e9"].refusal
    assert found["one particle"].particles.tolist() == [1, 1]
    assert found["equal squares at 0°, domain 7.25"].particles.tolist() == [49, 49]
    drawn = found["moderate"].particles + found["moderate"].left_over
    assert np.array_equal(found["moderate"].drawn, drawn)


def spoilt(row, **fields):
    """A row in which something else was found."""
    changed = {name: np.full_like(getattr(row.found, name), v) for name, v in fields.items()}
    return dataclasses.replace(row, found=dataclasses.replace(row.found, **changed))


@pytest.mark.parametrize(
    ("fields", "told"),
    [
        *(({name: 1}, meaning) for name, meaning in NEVER.items()),
        ({"departure": 2 * MOST_DEPARTURE}, "ulps from exact ones"),
        ({"gaps": 0.1}, "a gap of 0.10 clearances"),
        ({"lost": 1e-8}, "lost to clearances"),
        ({"volume_fraction": 0.3}, "of the moderate case's volume fraction"),
        ({"volume_fraction_mirrored": 0.9}, "in the mirror"),
        ({"size_l2_error": 1.0}, "E2 of the size"),
        ({"orientation_l2_error": 1.0}, "E2 of the orientation"),
        ({"kernel_s": 10.0}, "times the moderate case's time"),
    ],
)
def test_whatever_is_not_as_expected_is_told_with_the_case(rows, fields, told):
    row = next(row for row in rows if row.case.name == "moderate")
    failures = unmet([spoilt(row, **fields)])
    assert any(told in failure for failure in failures)
    assert all(failure.startswith("moderate (1/1): ") for failure in failures)


def test_refusals_are_told_apart(rows):
    by_name = {row.case.name: row for row in rows}
    refused, packed = by_name["offset by 1e9"], by_name["moderate"]
    (failure,) = unmet([dataclasses.replace(refused, case=MODERATE)])
    assert "a refusal" in failure and "expected a packing" in failure
    (failure,) = unmet([dataclasses.replace(packed, case=refused.case)])
    assert "a packing (expected a refusal" in failure
    other = dataclasses.replace(refused.case, refused="no such words")
    assert len(unmet([dataclasses.replace(refused, case=other)])) == 1


def test_other_volume_fractions_than_those_of_the_like_are_told(rows):
    by_name = {row.case.name: row for row in rows}
    far = by_name["offset by 1e6"]
    low = spoilt(far, volume_fraction=0.62, volume_fraction_mirrored=0.62)
    (failure,) = unmet([by_name["moderate"], low])
    assert "beside moderate" in failure
    lattice = by_name["equal squares at 0°, domain 7.25"]
    (failure,) = unmet([spoilt(lattice, volume_fraction=0.93, volume_fraction_mirrored=0.93)])
    assert "expected 0.932224 exactly" in failure


def test_a_failure_ends_the_study_with_the_names_of_the_cases():
    case = dataclasses.replace(
        MODERATE, name="dense", domain=square(6.0), volume_fraction=0.99, efforts=(PLAIN,), seeds=1
    )
    with pytest.raises(InputError, match=r"1 expectations are not met: dense \(1/1\): volume"):
        measure_stability({"dense": case}, ratios=(), offsets=(), edges=())


def test_particles_that_vanish_or_come_twice_are_counted():
    case = dataclasses.replace(MODERATE, domain=square(8.0))
    state, packing, _ = _pack(case.scene(PLAIN), case.database(), 1)
    assert unaccounted(state, packing.left_over) == 0
    assert unaccounted(state, packing.left_over + 1) == 1
    state.placed.source[0] = state.placed.source[1]
    assert unaccounted(state, packing.left_over) == 2


def test_what_does_not_end_is_ended_with_one_sentence():
    code = (
        "import time\n"
        "from grainfront.studies.stability.run import ending\n"
        "with ending('quick (1/1)', 60.0): pass\n"
        "with ending('endless (1/1)', 0.2): time.sleep(60.0)"
    )
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ended.returncode == 1
    assert ended.stderr == (
        "grainfront: stability: endless (1/1) must end, but has not after 0.2 s.\n"
    )


def _cos_sin(degrees: float) -> tuple[Decimal, Decimal]:
    """Cosine and sine by their series, to 40 digits."""
    pi = Decimal("3.14159265358979323846264338327950288419716939937510")
    angle, term = Decimal(degrees) * pi / 180, Decimal(1)
    sums = [Decimal(0), Decimal(0)]
    for n in range(60):
        sums[n % 2] += term if n % 4 < 2 else -term
        term *= angle / (n + 1)
    return sums[0], sums[1]


def test_departure_is_that_of_40_digits_and_sees_a_moved_node():
    getcontext().prec = 40
    case = dataclasses.replace(MODERATE, domain=square(6.0, 100.0, -50.0))
    database = case.database()
    packing, _ = api.pack(case.scene(PLAIN), database, 1)
    worst = Decimal(0)
    for i in range(packing.x.size):
        cosine, sine = (Decimal(packing.size[i]) * f for f in _cos_sin(packing.orientation[i]))
        hull = database.hulls.polygon(packing.shape[i])
        for (u, v), (x, y) in zip(hull, packing.polygons.polygon(i), strict=True):
            exact_x = Decimal(packing.x[i]) + cosine * Decimal(u) - sine * Decimal(v)
            exact_y = Decimal(packing.y[i]) + sine * Decimal(u) + cosine * Decimal(v)
            worst = max(worst, abs(exact_x - Decimal(x)), abs(exact_y - Decimal(y)))
    found = departure(packing, database)
    assert found == pytest.approx(float(worst) / ulp(packing.domain), rel=1e-2)
    packing.polygons.nodes[5, 1] += 16 * ulp(packing.domain)
    assert departure(packing, database) > 15


def test_gaps_and_losses_are_measured_in_clearances(packing_of):
    unit = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    domain = Rectangle(0.0, 0.0, 4.0, 4.0)
    clearance = CLEARANCE_ULPS * ulp(domain)
    apart = [unit, unit + [1.0 + 2.0 * clearance, 0.0], unit + [0.0, 2.0]]
    gaps = contact_gaps(packing_of(apart, domain))
    assert gaps == pytest.approx([2.0], abs=0.1)


def test_what_is_lost_is_the_area_of_the_inflated_particles():
    case = dataclasses.replace(MODERATE, domain=square(8.0, 1e6, 0.0))
    database = case.database()
    packing, _ = api.pack(case.scene(PLAIN), database, 1)
    clearance = CLEARANCE_ULPS * ulp(packing.domain)
    added = 0.0
    for i in range(packing.x.size):
        hull = shapely.Polygon(packing.size[i] * database.hulls.polygon(packing.shape[i]))
        inradius = hull.exterior.distance(shapely.Point(0.0, 0.0))
        added += hull.area * ((1.0 + clearance / inradius) ** 2 - 1.0)
    lost = lost_to_clearance(packing, database)
    assert lost == pytest.approx(added / packing.domain.area, rel=1e-6)


@pytest.mark.parametrize(
    "law", [Histogram((0.0, 10.0, 40.0), (1.0, 2.0)), Lognormal(median=20.0,
            log_standard_deviation=0.3, minimum=5.0, maximum=90.0)],
)  # fmt: skip
def test_scaled_and_mirrored_laws_are_laws(law):
    u = np.linspace(0.01, 0.99, 50)
    larger, seen = Scaled(law, 2.0**30), Mirrored(law)
    assert np.array_equal(larger.quantile(u), law.quantile(u) * 2.0**30)
    for one in (larger, seen):
        assert one.cdf(one.quantile(u)) == pytest.approx(u, abs=1e-9)
    assert seen.support == pytest.approx([180.0 - end for end in law.support[::-1]])


def test_a_mirror_turns_shapes_over_and_two_turn_them_back():
    database = MODERATE.database()
    scene, once = mirrored(MODERATE.scene(PLAIN), database)
    _, twice = mirrored(scene, once)
    assert once.descriptors["area"][::-1] == pytest.approx(database.descriptors["area"])
    turned = 180.0 - database.descriptors["orientation"]
    assert not np.allclose(turned, once.descriptors["orientation"][::-1] + 1.0)
    assert twice.descriptors["aspect_ratio"] == pytest.approx(database.descriptors["aspect_ratio"])
    there = [shapely.normalize(shapely.set_precision(p, 1e-6)) for p in once.hulls.to_shapely()]
    back = [shapely.normalize(shapely.set_precision(p, 1e-6)) for p in database.hulls.to_shapely()]
    assert not any(map(shapely.equals_exact, there[::-1], back, [1e-6] * len(back)))


def test_growth_of_time_is_a_power_along_a_series(rows):
    base = next(row for row in rows if row.case.name == "moderate")
    along = [
        dataclasses.replace(
            spoilt(base, kernel_s=1e-3 * at**1.5, particles=100),
            case=dataclasses.replace(base.case, series="edges", at=at),
        )
        for at in (10.0, 20.0, 40.0)
    ]
    assert exponents([base, *along]) == {("edges", PLAIN): pytest.approx(1.5)}


def test_less_than_the_clearance_gives_overlaps_but_the_clearance_has_a_wide_margin():
    growth = measure_error_growth(ratios=(1.0, 10.0), offsets=(0.0, 1e4), edges=(8, 200))
    assert (growth.rounding > 0).all()
    assert (growth.rounding <= CLEARANCE_ULPS / 8.0).all()
    assert (growth.edges_rounding > 0).all()
    assert (growth.edges_rounding <= CLEARANCE_ULPS / 4.0).all()
    assert (growth.departure <= 1.0).all()
    assert growth.clearance[0, 1] > 100 * growth.clearance[0, 0]
    ulps = growth.clearance / growth.farthest / np.spacing(1.0)
    assert ulps == pytest.approx(CLEARANCE_ULPS)


def test_a_run_of_a_case_repeats_but_for_its_times():
    case = dataclasses.replace(MODERATE, domain=square(8.0), seeds=2)
    one, other = (dataclasses.asdict(run(case, (6, 8))) for _ in range(2))
    one.pop("kernel_s")
    for name, value in one.items():
        assert np.array_equal(value, other[name]), name


@pytest.mark.parametrize("name", ["domain 1000:1", "one grain wide"])
def test_a_narrow_domain_is_filled_whatever_orientation_its_law_lacks(name):
    case = CASES[name]
    for seed in (1, 4):
        packing = _pack(case.scene((24, 20) if "grain" in name else PLAIN), case.database(), seed)[
            1
        ]
        assert packing.x.max() > 0.99 * case.domain.width - 1.5
        assert packing.y.max() > 0.97 * case.domain.height - 1.5
