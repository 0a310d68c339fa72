"""How exact a packing is stored, and what its clearances cost.

Everything is told in clearances or in units in the last place (ulps) of the farthest coordinate of
the domain, 2**-52 times that coordinate, as the clearance itself is.
"""

from __future__ import annotations

import numpy as np
import shapely

from grainfront.errors import InputError
from grainfront.packing.state import CLEARANCE_ULPS
from grainfront.particles import Packing, Rectangle
from grainfront.shapes.database import ShapeDatabase
from grainfront.statistics import find_contacts

# The digits of the number that a radian is derived from, for floats longer than float64.
PI = np.longdouble("3.14159265358979323846264338327950288")
# More bits than float64's: enough to tell its rounding to a thousandth.
BITS_NEEDED = 62


def ulp(domain: Rectangle) -> float:
    """A unit in the last place of the farthest coordinate."""
    sides = (domain.x_min, domain.y_min, domain.x_max, domain.y_max)
    return float(np.spacing(1.0)) * max(map(abs, sides))


def departure(packing: Packing, database: ShapeDatabase) -> float:
    """Largest departure, in ulps, of a stored coordinate from the exact transformation.

    That is x + S (cos α u − sin α v), and likewise for y, of the stored centre (x, y), size S and
    orientation α, and of the node (u, v) of the database, in extended precision. Raises InputError
    where the machine has none.
    """
    if np.finfo(np.longdouble).nmant < BITS_NEEDED:
        raise InputError("this machine has no floats longer than float64 to compare with")
    hulls, shape = database.hulls, packing.shape
    counts = hulls.node_counts[shape]
    owner = np.repeat(np.arange(shape.size), counts)
    first = np.repeat(hulls.offsets[shape] - packing.polygons.offsets[:-1], counts)
    u, v = hulls.nodes[np.arange(owner.size) + first].astype(np.longdouble).T
    angle = packing.orientation.astype(np.longdouble) * PI / 180
    cosine, sine = ((packing.size * f(angle))[owner] for f in (np.cos, np.sin))
    x, y = packing.polygons.nodes.astype(np.longdouble).T
    off_x = packing.x[owner] + (cosine * u - sine * v) - x
    off_y = packing.y[owner] + (sine * u + cosine * v) - y
    return float(max(np.abs(off_x).max(), np.abs(off_y).max()) / ulp(packing.domain))


def contact_gaps(packing: Packing) -> np.ndarray:
    """Gaps of all contacts between particles, in clearances, shape (n_contacts,)."""
    pairs = find_contacts(packing).pairs
    polygons = packing.polygons.to_shapely()
    clearance = CLEARANCE_ULPS * ulp(packing.domain)
    return shapely.distance(polygons[pairs[:, 0]], polygons[pairs[:, 1]]) / clearance


def lost_to_clearance(packing: Packing, database: ShapeDatabase) -> float:
    """Share of the domain by which the particles, as tested, are larger than those stored.

    A particle is tested inflated about its centre by a clearance over its inradius.
    """
    from grainfront.geometry.placing import radii_about_origin

    circumradius, inradius = np.empty((2, database.count))
    radii_about_origin(database.hulls.nodes, database.hulls.offsets, circumradius, inradius)
    relative = CLEARANCE_ULPS * ulp(packing.domain) / (inradius[packing.shape] * packing.size)
    return float(np.sum(packing.area * relative * (2.0 + relative)) / packing.domain.area)
