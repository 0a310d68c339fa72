"""Errors of area, perimeter, descriptors and volume fraction against the outlines' resolution."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely
from scipy.interpolate import CubicSpline

from grainfront import api
from grainfront.particles import Packing
from grainfront.polygons import Polygons
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase, standardised_database
from grainfront.shapes.sources import FourierGrains
from grainfront.studies.error_vs_time.record import AxisRecord, over_points, pareto_front
from grainfront.studies.error_vs_time.runs import Point, delivered_fraction, run, without_target

# Vertices of the reference, and the fewest, on average, that still make a grain.
REFERENCE_VERTICES = 500
FEWEST_VERTICES = 8
# Tolerances in sizes. The vertices left grow as one over the square root of the tolerance, so a
# quarter of the tolerance doubles them; 0.004 is what outlines of images are simplified to.
COARSEST = 0.064
FINER = 1 / 4
FINEST = 0.001 / 64
DESCRIPTORS = ("aspect_ratio", "circularity", "convexity")


def measure_outlines(
    scene: Scene, database: ShapeDatabase, seeds: Sequence[int], repeats: int
) -> AxisRecord:
    """Simplify the outlines of the scene more and more, measure their errors, and pack them.

    The reference is `reference_outlines`, the first point. Errors of shape are means over the
    shapes of |value / reference − 1|; that of the volume fraction (of the outlines where the scene
    replaces hulls, of the hulls otherwise) is |φ − φ of the reference| for the same seed.
    Simplified after Douglas & Peucker (1973).
    """
    reference = reference_outlines(scene, database)
    finest = standardised_database(reference, {})
    tolerances, databases = [0.0], [finest]
    tolerance = COARSEST
    while tolerance > FINEST:
        simplified = _simplified(finest.outlines, tolerance)
        if FEWEST_VERTICES <= simplified.node_counts.mean() < finest.outlines.node_counts.mean():
            tolerances.append(tolerance)
            databases.append(standardised_database(simplified, {}))
        tolerance *= FINER
    found = run([Point(without_target(scene), one) for one in databases], seeds, repeats, _observe)
    errors = _errors_of_shape(databases)
    fraction = found.numbers["volume_fraction"]
    return AxisRecord(
        settings={
            "tolerance": np.array(tolerances),
            "vertices": np.array([one.outlines.node_counts.mean() for one in databases]),
            "hull_vertices": np.array([one.hulls.node_counts.mean() for one in databases]),
        },
        results=found.numbers | errors | {"volume_fraction_error": np.abs(fraction - fraction[0])},
        seconds={"kernel_s": found.kernel_s},
        pareto=pareto_front(over_points(found.kernel_s), errors["perimeter_error"]),
    )


def reference_outlines(scene: Scene, database: ShapeDatabase) -> Polygons:
    """The finest outlines of a scene's shapes.

    Fourier grains are drawn with REFERENCE_VERTICES; through the nodes traced in images goes a
    smooth closed curve (periodic cubic spline over the chords' length) with as many; polygons of
    any other source are what they are. A grain whose curve would cross itself keeps its polygon.
    """
    source = scene.shapes
    if isinstance(source, FourierGrains):
        vertices = max(source.vertices, REFERENCE_VERTICES)
        return api.build_shapes_of(replace(source, vertices=vertices)).outlines
    if isinstance(source, api.ImageSource):
        polygons = [database.outlines.polygon(i) for i in range(database.count)]
        return Polygons.of([_smooth(polygon) for polygon in polygons])
    return database.outlines


def _smooth(polygon: np.ndarray) -> np.ndarray:
    closed = np.vstack([polygon, polygon[:1]])
    chord = np.hypot(*np.diff(closed, axis=0).T)
    position = np.concatenate([[0.0], np.cumsum(chord)])
    equal = np.linspace(0.0, position[-1], REFERENCE_VERTICES, endpoint=False)
    curve = CubicSpline(position, closed, bc_type="periodic")(equal)
    return curve if shapely.Polygon(curve).is_valid else polygon


def _simplified(outlines: Polygons, tolerance: float) -> Polygons:
    reduced = shapely.simplify(outlines.to_shapely(), tolerance)
    rings = shapely.get_exterior_ring(shapely.orient_polygons(reduced))
    return Polygons.of([shapely.get_coordinates(ring)[:-1] for ring in rings])


def _errors_of_shape(databases: Sequence[ShapeDatabase]) -> dict[str, np.ndarray]:
    """Mean relative errors, each of shape (n_points,), against the first database."""
    values = [_values(databases[0], np.ones(databases[0].count))]
    values += [_values(one, one.descriptors["size"]) for one in databases[1:]]
    return {
        f"{name}_error": np.array([np.mean(np.abs(v[name] / values[0][name] - 1)) for v in values])
        for name in values[0]
    }


def _values(database: ShapeDatabase, size: np.ndarray) -> dict[str, np.ndarray]:
    """Area and perimeter in sizes of the reference, and the descriptors, which have no unit."""
    found = database.descriptors
    return {
        "area": found["area"] * size**2,
        "perimeter": found["perimeter"] * size,
        **{name: found[name] for name in DESCRIPTORS},
    }


def _observe(point: Point, packing: Packing) -> dict[str, float]:
    return {
        "particles": packing.x.size,
        "volume_fraction": delivered_fraction(point, packing),
    }
