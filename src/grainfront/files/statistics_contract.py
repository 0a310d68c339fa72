"""What the statistics of a scene's packings hold: the contract of their file."""

from __future__ import annotations

from grainfront.files.contract import (
    AREA,
    LAW_UNITS,
    LENGTH,
    SCENE,
    VERSION,
    Contract,
    Variable,
    variables_of,
)


def _law(law: str, units: str) -> dict[str, Variable]:
    """A prescribed law and, for every seed, what was placed."""
    name, one_bin = law.replace("_", " "), (f"{law}_bin",)
    rows = {
        f"{law}_bin_edges": ((f"{law}_bin_edge",), units, f"edges of the bins of the {name}"),
        f"{law}_probability": (one_bin, "1", f"prescribed probability of each bin of the {name}"),
        f"{law}_share": (("seed", *one_bin), "1", f"share of particles in each bin of the {name}"),
        f"{law}_l2_error": (("seed",), "1", f"L2 distribution error E2 of the {name}"),
        f"{law}_noise_level": (("seed",), "1", f"E2 of the {name} under independent sampling"),
    }
    return {key: Variable("double", *row, optional=True) for key, row in rows.items()}


SEED_COUNTS = variables_of(
    ("seed",),
    type="int64",
    particles=("1", "particles placed"),
    left_over=("1", "particles drawn that found no place"),
    contact_pairs=("1", "pairs of particles that touch"),
    wall_contacts=("1", "pairs of a particle and a wall that touch"),
    pairs_tested=("1", "certificate: pairs of particles whose bounding boxes meet"),
    pairs_exact=("1", "certificate: pairs that floating point could not decide"),
    overlaps=("1", "certificate: pairs of particles that share interior points"),
    across_wall=("1", "certificate: particles that cross a wall"),
)
SEED_FRACTIONS = variables_of(
    ("seed",),
    finite=False,
    volume_fraction=("1", "area of the particles over area of the domain"),
    volume_fraction_bulk=("1", "volume fraction away from the walls"),
    empty_area=(AREA, "area of rooms of the domain, islands or beyond necks, that stayed empty"),
    void_ratio=("1", "(1 - volume fraction) over volume fraction"),
    coordination_number=("1", "2 x contact pairs / particles"),
    size_correlation_x=("1", "correlation of size with x, NaN where that repeats itself"),
    size_correlation_y=("1", "correlation of size with y, NaN where that repeats itself"),
    size_correlation_centre=(
        "1",
        "correlation of size with the distance to the centre, NaN where the domain repeats itself",
    ),
    size_correlation_noise_level=("1", "standard deviation of these if size and place are random"),
)


def _region_law(law: str) -> dict[str, Variable]:
    """How far what was placed in each region is from the laws that hold there."""
    name, each = law.replace("_", " "), ("seed", "region")
    rows = {
        f"region_{law}_l2_error": (each, f"E2 of the {name} in the region against its own law"),
        f"region_{law}_noise_level": (each, f"E2 of the {name} there under independent sampling"),
        f"{law}_forced_l2_error": (
            ("seed",),
            f"E2 of the {name} of the whole if each region followed its own law exactly",
        ),
    }
    return {
        key: Variable("double", dimensions, "1", text, finite=False, optional=True)
        for key, (dimensions, text) in rows.items()
    }


def _regions() -> dict[str, Variable]:
    """What was placed in each region; NaN where there is nothing to be told."""
    each = ("seed", "region")
    return {
        "region_area": Variable(
            "double", ("region",), AREA, "area of the region, counted in points", optional=True
        ),
        "region_particles": Variable(
            "int64", each, "1", "particles with their centre in the region", optional=True
        ),
        "region_volume_fraction": Variable(
            "double",
            each,
            "1",
            "area of these particles over area of the region",
            finite=False,
            optional=True,
        ),
        "region_mean_size": Variable(
            "double", each, LENGTH, "mean size of these particles", finite=False, optional=True
        ),
        "misplaced_share": Variable(
            "double",
            ("seed",),
            "1",
            "share of particles with their centre in another region than they were drawn for",
            optional=True,
        ),
        **{key: v for law in LAW_UNITS for key, v in _region_law(law).items()},
    }


REGION_VARIABLES = _regions()

STATISTICS = Contract(
    name="statistics",
    title="Statistics of the packings of a scene",
    dimensions={
        "seed": "packings of the scene",
        "contact_count": "contacts of one particle: 0, 1, 2 ...",
        "region": "regions of the arrangement, the rest of the domain last",
        "rose_bin": "bins of the orientation rose",
        "rose_bin_edge": "edges of the bins of the orientation rose",
        **{
            f"{law}_{dimension}": f"{meaning} of the {law.replace('_', ' ')}"
            for law in LAW_UNITS
            for dimension, meaning in {"bin": "bins", "bin_edge": "edges of the bins"}.items()
        },
    },
    variables={
        **variables_of(("seed",), type="int64", seed=("1", "seed of the random generators")),
        **SEED_COUNTS,
        **SEED_FRACTIONS,
        **variables_of(
            ("seed", "contact_count"),
            contact_share=("1", "share of the particles that have so many contacts"),
        ),
        **variables_of(
            ("rose_bin_edge",),
            rose_bin_edges=("degree", "edges of the bins of the orientation rose"),
        ),
        **variables_of(
            ("seed", "rose_bin"),
            rose_share=("1", "share of the particles in each bin of the orientation rose"),
        ),
        "rose_probability": Variable(
            "double", ("rose_bin",), "1", "prescribed probability of each bin of the rose",
            optional=True,
        ),
        **{key: v for law, units in LAW_UNITS.items() for key, v in _law(law, units).items()},
        **REGION_VARIABLES,
    },
    attributes={**VERSION, **SCENE},
)  # fmt: skip
