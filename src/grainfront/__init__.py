"""Reproducible packings of irregular grains by the optimised advancing front method.

In a notebook::

    import grainfront

    scene = grainfront.load_scene("config/scenes/river_gravel.yaml")
    database = grainfront.build_shapes(scene)
    packing, run_time = grainfront.pack(scene, database, seed=1)
    assert grainfront.certify(packing).holds
"""

from typing import Any

__all__ = [
    "InputError",
    "build_shapes",
    "certify",
    "load_scene",
    "measure",
    "pack",
    "progress_bar",
    "replace",
    "shape_coverage",
    "write_packing",
    "write_shapes",
]


def __getattr__(name: str) -> Any:
    """Import what is asked for, so that `import grainfront` alone costs nothing."""
    if name not in __all__:
        raise AttributeError(f"module 'grainfront' has no attribute '{name}'")
    from grainfront import api

    return getattr(api, name)


def __dir__() -> list[str]:
    return __all__
