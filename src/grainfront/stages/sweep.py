"""The packings of a sweep, resumed one by one, and the contour map that they make."""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from grainfront import api
from grainfront.errors import InputError
from grainfront.stages.sources import sources_digest
from grainfront.stages.stage import stage

if TYPE_CHECKING:
    from grainfront.scene import Scene
    from grainfront.studies.sweep import Point


@stage
def sweep(*, scene: str, database: str, chunk: int, chunks: int, folder: str, threads: int) -> None:
    """Pack chunk 1, 2 … `chunks` of a sweep, as far as its packings are not in `folder` yet."""
    from grainfront.studies import sweep

    loaded = api.load_scene(scene)
    _pack(loaded, database, sweep.chunks(loaded, chunks)[chunk - 1], Path(folder), threads)


@stage
def contour(
    *, scene: str, database: str, folder: str, threads: int, contour: str, timing: str
) -> None:
    """Write the contour map of a sweep, after packing what is not in `folder` yet, and remove it.

    The run times go to a file of their own.
    """
    from grainfront.files.contour import Contour, write_contour, write_contour_timing
    from grainfront.studies import sweep

    loaded = api.load_scene(scene)
    efforts = sweep.sweep_of(loaded)
    (points,) = sweep.chunks(loaded, 1)
    numbers = _pack(loaded, database, points, Path(folder), threads)
    found = Contour.of(
        efforts.n_angle,
        efforts.n_loc,
        sweep.seeds(loaded),
        lambda *point: numbers[sweep.Point(*point)],
    )
    for write, path in ((write_contour, contour), (write_contour_timing, timing)):
        write(path, found, scene_text=loaded.text, length_unit=loaded.length_unit)
    shutil.rmtree(folder)


def _pack(
    scene: Scene, database: str, points: Sequence[Point], folder: Path, threads: int
) -> dict[Point, dict[str, float]]:
    """The numbers of these points, each packed now or found in a file of its own in `folder`.

    The files stand in a folder named by a digest of all that the numbers depend on, so that those
    of an edited scene are never taken for these. Each is whole or absent; InputError where one has
    been damaged since.
    """
    from grainfront.files.atomic import write_text
    from grainfront.files.netcdf import read_shapes
    from grainfront.studies.sweep import pack_points

    folder = folder / _digest(scene, database)
    folder.mkdir(parents=True, exist_ok=True)
    files = {point: folder / f"{'_'.join(map(str, point))}.json" for point in points}
    missing = [point for point in points if not files[point].exists()]
    # closed at once where a file cannot be written: the packings that wait are not begun
    with closing(pack_points(scene, read_shapes(database), missing, threads)) as packed:
        for point, numbers in packed:
            write_text(files[point], json.dumps(numbers) + "\n")
    return {point: _numbers(file) for point, file in files.items()}


def _numbers(file: Path) -> dict[str, float]:
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except ValueError:
        raise InputError(
            f"{file}: is cut off or damaged, but must hold the numbers of a packing; once it is "
            "removed, that packing is made again"
        ) from None


def _digest(scene: Scene, database: str) -> str:
    fields = (
        scene.domain, scene.size, scene.matched, scene.orientation, scene.packing.n_bin,
        scene.replacement,
    )  # fmt: skip
    digest = hashlib.sha256(f"{fields} {sources_digest('sweep')}".encode())
    digest.update(Path(database).read_bytes())
    return digest.hexdigest()[:16]


@stage
def contour_picture(*, scene: str, contour: str, picture: str) -> None:
    """Draw the map of the volume fraction, with the target of the scene where it has one."""
    from grainfront import figures
    from grainfront.files.contour import read_contour

    found = read_contour(contour)
    target = api.load_scene(scene).target
    figure = figures.contour(
        found.n_angle,
        found.n_loc,
        found.volume_fraction,
        seeds=found.seeds.size,
        target=None if target is None else target.volume_fraction,
    )
    figures.save_png(figure, picture)
