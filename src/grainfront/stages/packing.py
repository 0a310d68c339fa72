"""From a scene to its packings: shapes, kernels, hulls, outlines, files for ParaView."""

from __future__ import annotations

import json

from grainfront import api
from grainfront.stages.stage import stage


@stage
def shapes(*, scene: str, database: str) -> None:
    """Build the shape database of the scene at path `scene` and write it to `database`."""
    loaded = api.load_scene(scene)
    built = api.build_shapes(loaded)
    api.warn_of_uncovered(loaded, built)
    api.write_shapes(database, built, loaded.shapes)


@stage
def kernels(*, search: str) -> None:
    """Compile all that packings by a search need, once, before they run side by side."""
    from grainfront.warm_up import compile_kernels

    compile_kernels(search)


@stage
def packing(*, scene: str, database: str, seed: int, packing: str, timing: str) -> None:
    """Pack the hulls of a database for one seed; the run time goes to a file of its own."""
    from grainfront.files.atomic import write_text
    from grainfront.files.netcdf import read_shapes

    loaded = api.load_scene(scene)
    with api.progress_bar() as progress:
        packed, run_time = api.pack(loaded, read_shapes(database), seed, progress)
    api.write_packing(packing, packed, loaded, seed)
    times = {"kernel_s": run_time.kernel_s, "compile_s": run_time.compile_s}
    write_text(timing, json.dumps(times) + "\n")


@stage
def packing_to_target(
    *,
    scene: str,
    database: str,
    seed: int,
    contour: str | None,
    packing: str,
    target: str,
    timing: str,
) -> None:
    """Pack the hulls of a database to the scene's target volume fraction, and keep the attempts.

    A contour map of the scene, where it has one, tells the effort to start with.
    """
    from grainfront.files.atomic import write_text
    from grainfront.files.contour import read_contour
    from grainfront.files.netcdf import read_shapes

    loaded = api.load_scene(scene)
    effort = None if contour is None else api.effort_from_map(loaded, read_contour(contour))
    with api.progress_bar() as progress:
        packed, run_time, attempts = api.pack_to_target(
            loaded, read_shapes(database), seed, progress, effort
        )
    api.write_packing(packing, packed, loaded, seed)
    api.write_target(target, attempts, loaded, seed)
    times = {"kernel_s": run_time.kernel_s, "compile_s": run_time.compile_s}
    write_text(timing, json.dumps(times) + "\n")


@stage
def replacement(*, scene: str, database: str, seed: int, packing: str, nonconvex: str) -> None:
    """Give the hulls of a packing their outlines back."""
    from grainfront.files.netcdf import read_packing, read_shapes

    replaced = api.replace(read_packing(packing), read_shapes(database))
    api.write_packing(nonconvex, replaced, api.load_scene(scene), seed)


@stage
def vtk(*, packing: str, vtp: str) -> None:
    """Write a packing for ParaView."""
    from grainfront.files.netcdf import read_packing
    from grainfront.files.vtk import write_vtp

    write_vtp(vtp, read_packing(packing))
