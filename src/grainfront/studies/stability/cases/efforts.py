"""Cases of effort: few and many trial orientations, a local front longer than the front."""

from __future__ import annotations

from grainfront.studies.stability.case import Case, square

ANGLES = [
    Case(name=f"n_angle {n}", efforts=((n, 20),), series="n_angle", at=float(n))
    for n in (1, 2, 7, 90, 360)
]
FRONTS = [Case(name=f"n_loc {n_loc}", efforts=((24, n_loc),)) for n_loc in (1, 2, 7, 8)] + [
    Case(name="n_loc longer than the front", domain=square(5.0), efforts=((24, 200), (1, 200))),
]
CASES = [*ANGLES, *FRONTS]
