"""Cases of domain: far from the origin, tiny and huge, narrow and long, for few and many grains."""

from __future__ import annotations

from grainfront.laws import Constant, Uniform
from grainfront.particles import Rectangle
from grainfront.studies.stability.case import PLAIN, Case, square

ALL_TOP = "all of it is near the top, where nearly all tries are in vain and room is left"
FEW_FIT = "few orientations of the law fit below the top: the rest is tried in vain, and lacking"
FEW = "the few particles share the tries that end a packing, and the start of the kernel"

OFFSETS = [
    Case(name="offset by 1e3", domain=square(40.0, 1e3, -1e3), like="moderate"),
    Case(name="offset by 1e6", domain=square(40.0, -1e6, 1e6), like="moderate", most_lost=1e-7,
         reason="the clearance is in proportion to the farthest coordinate"),
    Case(name="offset by 1e9", domain=square(40.0, 1e9, 1e9), refused="must stay within"),
]  # fmt: skip
SCALES = [
    Case(
        name=f"scale {name}",
        size=Uniform(0.5 * factor, 1.5 * factor),
        domain=square(40.0 * factor),
        like="moderate",
    )
    for name, factor in (("2^30", 2.0**30), ("2^-30", 2.0**-30), ("1e9", 1e9), ("1e-9", 1e-9))
]
NARROW = [
    Case(name="one grain wide", domain=Rectangle(0.0, 0.0, 1.5, 150.0)),
    Case(name="one grain high", domain=Rectangle(0.0, 0.0, 150.0, 1.5),
         least_fraction=0.6, most_growth=60.0, most_e2=4.0, reason=FEW_FIT),
    Case(name="two grains wide", domain=Rectangle(0.0, 0.0, 3.0, 150.0)),
    Case(name="three grains wide", domain=Rectangle(0.0, 0.0, 4.5, 150.0)),
    Case(name="domain 1000:1", domain=Rectangle(0.0, 0.0, 2000.0, 2.0),
         least_fraction=0.5, reason=ALL_TOP),
    Case(name="domain 1:1000", domain=Rectangle(0.0, 0.0, 2.0, 2000.0)),
]  # fmt: skip
LARGEST = [
    Case(name="largest as wide as the domain", size=Uniform(0.5, 5.0), domain=square(5.0),
         least_fraction=0.3, most_growth=50.0, reason=FEW),
    Case(name="largest wider than the domain", size=Uniform(0.5, 10.0), domain=square(5.0),
         least_fraction=0.3, most_growth=50.0, most_e2=2.0, reason=FEW),
    Case(name="all wider than the domain", size=Uniform(6.0, 7.0), domain=square(5.0),
         refused="no particle fits"),
]  # fmt: skip
NUMBERS = [
    Case(
        name="one particle",
        size=Constant(1.0),
        domain=square(1.5),
        least_fraction=0.3,
        most_growth=100.0,
        reason=FEW,
    ),
    Case(name="a million particles", domain=square(1400.0), efforts=(PLAIN,), seeds=1),
]
CASES = [*OFFSETS, *SCALES, *NARROW, *LARGEST, *NUMBERS]
