"""Compiling all kernels that packings by a search need, before these run side by side."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from grainfront import api
from grainfront.arrangement.regions import Arrangement, LocalLaws, Region
from grainfront.arrangement.zones import Circle
from grainfront.jit import compiling
from grainfront.laws import Constant, Uniform
from grainfront.packing import PRUNED_FROM_N_LOC
from grainfront.particles import Rectangle
from grainfront.particles import Region as Outlined
from grainfront.polygons import Polygons
from grainfront.scene import PackingEffort, Scene, Target
from grainfront.shapes.database import ShapeDatabase
from grainfront.shapes.sources import RegularPolygon


def compile_kernels(search: str) -> None:
    """Compile the kernels of a search, one of `api.searches`, down to the certificate."""
    plain = search.removeprefix(api.ARRANGED).removesuffix(api.OUTLINED)
    scene, database = _smallest_scene(1 if plain == "exhaustive" else PRUNED_FROM_N_LOC)
    if plain == "controlled":
        scene = replace(scene, target=Target(volume_fraction=0.5, tolerance=0.5))
    if search.endswith(api.OUTLINED):
        scene = replace(scene, domain=_notched())
    if search.startswith(api.ARRANGED):
        laws = LocalLaws(size=Constant(0.5))
        scene = replace(scene, arrangement=Arrangement((Region(Circle((2.0, 2.0), 1.0), (laws,)),)))
    packing, _ = api.pack(scene, database, seed=0)
    with compiling("certificate"):
        for one in (packing, api.replace(packing, database)):
            api.certify(one)
            api.measure(scene, database, one)


def _notched() -> Outlined:
    """A square with a notch at its bottom, so that a front must be begun."""
    nodes = [[0.0, 0.0], [2.0, 1.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]
    rings = Polygons.of([np.array(nodes)])
    return Outlined(0.0, 0.0, 4.0, 4.0, rings, np.array([0, 1]))


def _smallest_scene(trials: int) -> tuple[Scene, ShapeDatabase]:
    """A few dented squares: the least that every kernel has work with."""
    dented = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [0.0, 0.4], [-0.5, 0.5]])
    on_hull = np.array([0, 1, 2, 4])
    database = ShapeDatabase(
        outlines=Polygons.of([dented]),
        hulls=Polygons.of([dented[on_hull]]),
        hull_nodes=on_hull,
        descriptors={"aspect_ratio": np.ones(1), "hull_area": np.ones(1), "area": np.full(1, 0.95)},
        counts={},
    )
    scene = Scene(
        name="smallest",
        text="",
        length_unit="1",
        seeds=(0,),
        domain=Rectangle(0.0, 0.0, 4.0, 4.0),
        shapes=RegularPolygon(4),
        size=Constant(1.0),
        matched=None,
        orientation=Uniform(0.0, 180.0),
        packing=PackingEffort(n_angle=trials, n_loc=trials, n_bin=2),
        replacement=True,
    )
    return scene, database
