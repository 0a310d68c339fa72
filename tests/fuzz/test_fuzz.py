"""A short share of the fuzzing: random scenes, damaged files; and what it has found."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings

from grainfront.packing import elsewhere
from grainfront.particles import Packing, Region
from grainfront.polygons import Polygons
from grainfront.statistics.fractions import volume_fraction_between

sys.path.insert(0, str(Path(__file__).parent))
from damage import DOMAINS, IMAGES, KINDS, OUTLINES, RESULTS, check_file, damaged_files, whole
from scenes import check_scene, scenes

SQUARE = [[0, 0], [3, 0], [3, 3], [0, 3]]

# Sequences are the same in each run, so that a failure is found again.
SHORT = settings(
    deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck)
)


@pytest.mark.skipif("NUMBA_DISABLE_JIT" in os.environ, reason="takes too long uncompiled")
@settings(SHORT, max_examples=15)
@given(scenes())
def test_random_scenes_are_packed_or_refused(described):
    check_scene(*described)


@settings(SHORT, max_examples=150)
@given(damaged_files(("scene.yaml", *OUTLINES)))
def test_damaged_texts_are_valid_or_refused(damaged):
    check_file(*damaged)


@settings(SHORT, max_examples=60)
@given(damaged_files(tuple(DOMAINS)))
def test_damaged_domains_are_packed_or_refused(damaged):
    check_file(*damaged)


@settings(SHORT, max_examples=100)
@given(damaged_files(tuple(IMAGES)))
def test_damaged_images_are_valid_or_refused(damaged):
    check_file(*damaged)


@settings(SHORT, max_examples=100)
@given(damaged_files(tuple(RESULTS)))
def test_damaged_results_are_refused(damaged):
    check_file(*damaged)


@pytest.mark.parametrize("kind", KINDS)
def test_whole_files_are_valid(kind):
    assert check_file(kind, whole(kind)) == "valid"


SMALL = {
    "seed": 0,
    "domain": {"width": 6, "height": 6},
    "shapes": {"family": {"rectangle": {}}},
    "size": {"constant": 1},
}


def test_a_constant_orientation_beside_another_law():
    """Found by fuzzing: laws of one bin and of several ended in a traceback."""
    region = {"inside": {"circle": {"centre": [3, 3], "radius": 2}}}
    law = {"orientation": {"uniform": {"minimum": 0, "maximum": 90}}}
    arrangement = {"arrangement": {"regions": [region | law]}}
    assert check_scene(SMALL | {"orientation": {"constant": 30}} | arrangement) == "packed"


def test_a_periodic_cell_lower_than_its_grains():
    """Found by fuzzing: where none fits, none was left for the seam, which was a traceback."""
    cell = {"domain": {"width": 16, "height": 0.8, "periodic": ["x"]}}
    ends = {"minimum": 0.3, "maximum": 1.6}
    size = {"size": {"lognormal": {"median": 1, "log_standard_deviation": 0.01, **ends}}}
    assert check_scene(SMALL | cell | size) == "refused"


def test_obstacles_that_leave_slivers_far_from_the_origin():
    """Found by fuzzing: rounding outweighed the area of a slice, whose fraction was negative."""
    far, d = 1500, 2.25e-6
    outer = [[d, far + d], [4.5 - d, far + d], [4.5 - d, far + 4.5 - d], [d, far + 4.5 - d]]
    inner = [[1.125, far + 1.125], [3.375, far + 1.125], [3.375, far + 3.375], [1.125, far + 3.375]]
    rings = [[*ring, ring[0]] for ring in (outer, inner)]
    stone = {"stones.geojson": json.dumps({"type": "Polygon", "coordinates": rings})}
    domain = {
        "domain": {"width": 4.5, "height": 4.5, "origin": [0, far]},
        "obstacles": {"path": "stones.geojson"},
        "shapes": {"family": {"regular_polygon": {"vertices": 3}}},
        "size": {"constant": 1.5},
        "orientation": {"constant": 0},
        "packing": {"n_angle": 1, "n_loc": 1, "n_bin": 1},
    }
    assert check_scene(SMALL | domain, stone) == "packed"


def test_slices_of_a_notched_domain_with_corners_on_the_border():
    """Found by fuzzing: GEOS's clip_by_rect gave 3.0 for the area 4.5 of the topmost slice."""
    notched = shapely.Polygon([(0, 0), (6, 0), (6, 5), (3, 4), (0, 5)])
    square = np.array([[0.0, 4.0], [1.0, 4.0], [1.0, 4.5], [0.0, 4.5]])
    one, polygons = np.ones(1), Polygons.of([square])
    packing = Packing(Region.of(notched), polygons, *[one] * 7, np.zeros(1, dtype=np.int64), 0)
    assert volume_fraction_between(packing, 1, 3.75, 5.0) == pytest.approx(0.5 / 4.5)


def test_regions_where_a_scout_finds_no_place_among_obstacles():
    """Found by fuzzing: the region of a place at ∞ was looked for, which was a traceback."""
    outer = [[0.495, 0.2475], [0.505, 0.2475], [0.505, 0.2525], [0.495, 0.2525], [0.495, 0.2475]]
    stone = {"stones.geojson": json.dumps({"type": "Polygon", "coordinates": [outer]})}
    zone = {"polygon": {"nodes": [[0, 0], [1, 0], [0, 1]]}}
    domain = {
        "domain": {"width": 1, "height": 1},
        "obstacles": {"path": "stones.geojson"},
        "shapes": {"family": {"regular_polygon": {"vertices": 3}}},
        "orientation": {"constant": 0},
        "packing": {"n_angle": 1, "n_loc": 8, "n_bin": 1},
        "arrangement": {"regions": [{"inside": zone, "size": {"constant": 0.6}}]},
    }
    assert check_scene(SMALL | domain, stone) == "packed"


def test_slices_that_an_obstacle_leaves_a_rounding_of():
    """Found by fuzzing: of an area of rounding alone -0.29 was filled."""
    square = np.array([[0.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]]) * 0.7 - [0.3, 0.0]
    right = float(np.nextafter(0.4, 1.0))
    notched = shapely.Polygon(
        [(0.4, 0.0), (right, 0.0), (right, 0.7), (-0.3, 0.7), (-0.3, 0.35), (0.4, 0.35)]
    )
    one, polygons = np.ones(1), Polygons.of([square])
    packing = Packing(Region.of(notched), polygons, *[one] * 7, np.zeros(1, dtype=np.int64), 0)
    assert np.isnan(volume_fraction_between(packing, 1, 0.0, 0.175))
    assert volume_fraction_between(packing, 1, 0.35, 0.7) == pytest.approx(0.5)


def test_a_truncated_law_without_a_maximum():
    """Found by fuzzing: rounding made 1 of the largest share below it, and a size of ∞."""
    law = {"normal": {"mean": 1, "standard_deviation": 0.49, "minimum": 0.2}}
    region = {"inside": {"circle": {"centre": [3, 3], "radius": 1}}, "size": {"constant": 0.6}}
    assert check_scene(SMALL | {"size": law, "arrangement": {"regions": [region]}}) == "packed"


def test_an_island_of_many_edges_that_no_grain_fits(monkeypatch):
    """Found by fuzzing: twenty searches among all pairs of its edges, which took two minutes."""
    tried, start = [], elsewhere._start

    def counted(state, obstacles, limit, room, *attempt):
        tried.append(room)
        return start(state, obstacles, limit, room, *attempt)

    monkeypatch.setattr(elsewhere, "_start", counted)
    angle = np.arange(128) * np.pi / 64
    disc = 0.55 * np.column_stack([np.cos(angle), np.sin(angle)]) + [3.6, 1.0]
    islands = [{"polygon": {"nodes": nodes}} for nodes in (SQUARE, disc.tolist())]
    scene = {
        "domain": {"inside": {"union": islands}},
        "shapes": {"family": {"rectangle": {"aspect_ratio": [2, 2], "count": 1}}},
        "size": {"constant": 0.9},
        "packing": {"n_angle": 20, "n_loc": 1, "n_bin": 1},
    }
    assert check_scene(SMALL | scene) == "packed"
    on_island = [room for room in tried if room.edges.size]
    assert len(on_island) <= 3 * 4  # in three packings, for four sets of particles each
