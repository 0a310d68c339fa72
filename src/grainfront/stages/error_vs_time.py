"""Errors of a scene against the run time they cost, and pictures of them."""

from __future__ import annotations

from grainfront import api
from grainfront.stages.stage import stage


@stage
def error_vs_time(*, scene: str, database: str, record: str) -> None:
    """Measure the axes that a scene lists and write what was found to `record`."""
    from grainfront.files.error_vs_time import write_error_vs_time
    from grainfront.files.netcdf import read_shapes
    from grainfront.studies.error_vs_time import measure_axes

    loaded = api.load_scene(scene)
    seeds, axes = measure_axes(loaded, read_shapes(database))
    write_error_vs_time(
        record,
        {axis: found.quantities for axis, found in axes.items()},
        seeds=seeds,
        scene_text=loaded.text,
        length_unit=loaded.length_unit,
    )


@stage
def error_vs_time_picture(*, record: str, axis: str, picture: str) -> None:
    """Draw one axis of a record."""
    from grainfront import figures
    from grainfront.files.error_vs_time import read_error_vs_time

    _, axes = read_error_vs_time(record)
    figures.save_png(figures.error_vs_time(axis, axes[axis]), picture)
