"""What result datasets hold: the one place where their variables are named and explained.

The writers take their metadata from here, the JSON Schemas and CDL headers are made from here
(`files.schema`), and both writers and readers check files against them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

CONVENTIONS = "CF-1.9"

# Units may name a global attribute, whose value is filled in when a file is written.
LENGTH = "{length_unit}"
AREA = "{length_unit}^2"
SOURCE_LENGTH = "{source_unit}"


@dataclass(frozen=True)
class Variable:
    """One variable: CDL type, dimensions, units and its meaning in a sentence."""

    type: str
    dimensions: tuple[str, ...]
    units: str
    long_name: str
    attributes: dict[str, str] = field(default_factory=dict)
    finite: bool = True
    """False where an infinite or an undefined value (NaN) is lawful."""
    optional: bool = False
    """True where only some scenes have it."""


@dataclass(frozen=True)
class Attribute:
    """One global attribute: JSON type and meaning; a name ending in * stands for a group."""

    type: str
    description: str
    optional: bool = False
    """True where only some scenes have it."""


@dataclass(frozen=True, eq=False)
class Contract:
    """One result dataset; hashed by identity."""

    name: str
    title: str
    dimensions: dict[str, str]
    variables: dict[str, Variable]
    attributes: dict[str, Attribute]

    @property
    def data(self) -> dict[str, Variable]:
        """The variables that hold data: all but the geometry container."""
        return {name: v for name, v in self.variables.items() if name != "geometry"}


def _polygons(element: str, units: str, long_name: str) -> dict[str, Variable]:
    """The CF geometry container `geometry` (CF-1.9, section 7.5) of one polygon per `element`."""
    container = {
        "geometry_type": "polygon",
        "node_count": "node_count",
        "node_coordinates": "node_x node_y",
        "variable_name": "geometry",  # what cf_xarray calls the decoded polygons
    }
    node = f"coordinate of the nodes of each {long_name}, counter-clockwise, the first repeated"
    return {
        "geometry": Variable("int", (), "", f"{long_name} as polygons", container),
        "node_count": Variable(
            "int64", (element,), "1", f"nodes of each {long_name}, the repeated one too"
        ),
        "node_x": Variable("double", ("node",), units, f"x {node}", {"axis": "X"}),
        "node_y": Variable("double", ("node",), units, f"y {node}", {"axis": "Y"}),
    }


def variables_of(
    dimensions: tuple[str, ...], type: str = "double", geometry: bool = False, finite: bool = True,
    **rows: tuple[str, str],
) -> dict[str, Variable]:  # fmt: skip
    """Variables of the same dimensions from rows of (units, long_name)."""
    attributes = {"geometry": "geometry"} if geometry else {}
    return {
        name: Variable(type, dimensions, units, long_name, attributes, finite)
        for name, (units, long_name) in rows.items()
    }


VERSION = {"grainfront_version": Attribute("string", "version of grainfront that wrote the file")}
SEED = {"seed": Attribute("integer", "seed of the random generators")}
SCENE = {
    "scene": Attribute("string", "the scene, as YAML text"),
    "length_unit": Attribute("string", "unit of every length"),
}

PACKING = Contract(
    name="packing",
    title="Packing of particles: hulls as packed, or the outlines that replaced them",
    dimensions={"particle": "particles in order of placement", "node": "nodes of all polygons"},
    variables={
        **_polygons("particle", LENGTH, "particle"),
        **variables_of(
            ("particle",),
            geometry=True,
            x=(LENGTH, "x coordinate of the centroid of the hull"),
            y=(LENGTH, "y coordinate of the centroid of the hull"),
            size=(LENGTH, "size: minimum Feret diameter of the hull"),
            aspect_ratio=("1", "aspect ratio: length over size"),
            orientation=("degree", "direction of the length from the x axis, in [0, 180)"),
            area=(AREA, "area of the polygon"),
            circumradius=(LENGTH, "largest distance of a node from (x, y)"),
        ),
        "shape": Variable(
            "int64", ("particle",), "1", "index into the shape database", {"geometry": "geometry"}
        ),
        "region": Variable(
            "int64",
            ("particle",),
            "1",
            "region that the particle was drawn for, -1 for the rest of the domain",
            {"geometry": "geometry"},
            optional=True,
        ),
    },
    attributes={
        **VERSION,
        **SEED,
        **SCENE,
        "domain": Attribute(
            "string", "the domain as WKT, exact to the last bit; a MULTIPOLYGON if no rectangle"
        ),
        "periodic": Attribute(
            "string", "axes along which the domain repeats itself: x, or x y", optional=True
        ),
        "volume_fraction": Attribute("number", "area of the particles over area of the domain"),
        "left_over": Attribute("integer", "particles drawn that found no place"),
    },
)

SHAPES = Contract(
    name="shapes",
    title="Standardised shapes: centroid of the hull at the origin, size 1, orientation 0",
    dimensions={
        "shape": "shapes",
        "node": "nodes of all outlines",
        "hull_node": "nodes of all hulls",
    },
    variables={
        **_polygons("shape", "1", "outline"),
        "hull_node_count": Variable("int64", ("shape",), "1", "nodes of the hull, none repeated"),
        "hull_node": Variable(
            "int64", ("hull_node",), "1", "index along node of the nodes of the hulls"
        ),
        **variables_of(
            ("shape",),
            geometry=True,
            size=(SOURCE_LENGTH, "size (minimum Feret diameter) as found in the source"),
            orientation=("degree", "orientation as found in the source, in [0, 180)"),
            length=("1", "length over size"),
            aspect_ratio=("1", "aspect ratio: length over size"),
            area=("1", "area of the outline over the size squared"),
            hull_area=("1", "area of the hull over the size squared"),
            perimeter=("1", "perimeter of the outline over the size"),
            convex_perimeter=("1", "perimeter of the hull over the size"),
            convexity=("1", "convex perimeter over perimeter"),
            inscribed_radius=("1", "radius of the largest inscribed circle over the size"),
            circumscribed_radius=("1", "radius of the smallest circumscribed circle over the size"),
            circularity=("1", "square root of inscribed over circumscribed radius"),
        ),
        **variables_of(
            ("shape",),
            geometry=True,
            finite=False,
            regularity=("1", "log10(P / (P - Pcon)), infinite for a convex outline"),
        ),
    },
    attributes={
        **VERSION,
        **SEED,
        "source": Attribute("string", "where the shapes come from, with its parameters"),
        "source_unit": Attribute("string", "unit of lengths in the source, pixel for images"),
        "count_*": Attribute("integer", "what was found in the source, kept, or dropped and why"),
    },
)

CONTACTS = Contract(
    name="contacts",
    title="Contacts between particles, and of particles with walls",
    dimensions={"contact": "pairs of particles that touch", "wall_contact": "contacts with a wall"},
    variables={
        **variables_of(
            ("contact",),
            type="int64",
            particle_a=("1", "index of the first particle, the smaller one"),
            particle_b=(
                "1",
                "index of the second particle, which may touch by an image",
            ),
        ),
        **variables_of(
            ("contact",),
            x=(LENGTH, "x coordinate of the contact"),
            y=(LENGTH, "y coordinate of the contact"),
            normal_x=("1", "x component of the unit normal from the first to the second particle"),
            normal_y=("1", "y component of the unit normal from the first to the second particle"),
        ),
        **variables_of(
            ("wall_contact",),
            type="int64",
            wall_particle=("1", "index of the particle that touches the wall"),
            wall=(
                "1",
                "the wall: 0 left, 1 bottom, 2 right, 3 top; of a domain given as MULTIPOLYGON, "
                "its rings in their order from 0 on",
            ),
        ),
    },
    attributes={**VERSION, **SEED, **SCENE},
)

LAW_UNITS = {
    "size": LENGTH,
    "aspect_ratio": "1",
    "circularity": "1",
    "regularity": "1",
    "orientation": "degree",
}
"""What a law may be prescribed for."""
