"""Scenes: what one packing is made of, read from YAML and checked."""

from grainfront.scene.read import IMAGES, load_scene, scene_schema
from grainfront.scene.scene import ErrorVsTime, PackingEffort, Scene, Sweep, Target

__all__ = [
    "IMAGES",
    "ErrorVsTime",
    "PackingEffort",
    "Scene",
    "Sweep",
    "Target",
    "load_scene",
    "scene_schema",
]
