"""The project's scenes, in domains of any size."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

from grainfront import api
from grainfront.particles import Rectangle
from grainfront.scene import Scene
from grainfront.shapes.database import ShapeDatabase

SCENES = Path(__file__).parents[1] / "config" / "scenes"
# Edge of a domain that takes about a hundred grains of any scene: a moment to pack.
SMALL = 20.0


def scene_and_shapes(name: str, edge: float | None = None) -> tuple[Scene, ShapeDatabase]:
    """A scene and its shapes, in a square of another `edge` (in the scene's unit) if given.

    Regions have their place in the scene's own domain, and are left out in another.
    """
    scene, database = _as_it_is(name)
    if edge is not None:
        scene = replace(scene, domain=Rectangle(0.0, 0.0, edge, edge), arrangement=None)
    return scene, database


@cache
def _as_it_is(name: str) -> tuple[Scene, ShapeDatabase]:
    scene = api.load_scene(SCENES / f"{name}.yaml")
    return scene, api.build_shapes(scene)
