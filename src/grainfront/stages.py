"""The stages of the workflow, from files to files; each is one rule, called with keywords.

Every result is written under a temporary name and renamed at the end. Faults of the input, and a
certificate that does not hold, end the job with one sentence.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Callable, Sequence
from functools import wraps
from pathlib import Path
from typing import ParamSpec

from grainfront import api
from grainfront.errors import InputError

P = ParamSpec("P")

_PACKAGE = Path(__file__).parent
_ALWAYS = ("__init__", "api", "checked_yaml", "errors", "particles", "polygons", "scene", "stages")
_FILES = ("files.atomic", "files.contract", "files.dataset", "files.netcdf", "files.schema")
_DATABASE = ("shapes.database", "shapes.descriptors")
_LAWS = ("laws", "shapes.sources", *_ALWAYS)
SOURCES = {
    "shapes": ("draw", "shapes", "laws", *_FILES, *_ALWAYS),
    "packing": ("draw", "geometry", "jit", "packing", *_DATABASE, *_FILES, *_LAWS),
    "replacement": ("geometry", "jit", "replacement", *_DATABASE, *_FILES, *_LAWS),
    "contacts": ("geometry", "jit", "statistics", *_FILES, *_LAWS),
    "statistics": (
        "certificate", "geometry", "jit", "statistics", "files.statistics", *_DATABASE,
        *_FILES, *_LAWS,
    ),
    "vtk": ("files.vtk", *_FILES, *_LAWS),
    "figures": (
        "certificate", "figures", "geometry", "jit", "shapes", "statistics", "files.statistics",
        *_FILES, *_LAWS,
    ),
}  # fmt: skip
"""What of the package each stage's results depend on: modules, and packages with all of theirs."""


def sources_digest(stage: str) -> str:
    """Hexadecimal digest of the sources that a stage uses: an edit of them asks for a new run."""
    digest = hashlib.sha256()
    for module in SOURCES[stage]:
        path = _PACKAGE.joinpath(*module.split("."))
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path.with_suffix(".py")]:
            digest.update(file.relative_to(_PACKAGE).as_posix().encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def stage(run: Callable[P, None]) -> Callable[P, None]:
    """End the process with one sentence where the input is at fault."""

    @wraps(run)
    def told(*args: P.args, **kwargs: P.kwargs) -> None:
        try:
            run(*args, **kwargs)
        except (InputError, OSError, MemoryError) as error:
            raise SystemExit(api.sentence(error)) from None

    return told


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
def replacement(*, scene: str, database: str, seed: int, packing: str, nonconvex: str) -> None:
    """Give the hulls of a packing their outlines back."""
    from grainfront.files.netcdf import read_packing, read_shapes

    replaced = api.replace(read_packing(packing), read_shapes(database))
    api.write_packing(nonconvex, replaced, api.load_scene(scene), seed)


@stage
def contacts(*, scene: str, seed: int, packing: str, contacts: str) -> None:
    """Find the contacts of a packing."""
    from grainfront.files import netcdf
    from grainfront.statistics import find_contacts

    loaded = api.load_scene(scene)
    netcdf.write_contacts(
        contacts,
        find_contacts(netcdf.read_packing(packing)),
        scene_text=loaded.text,
        seed=seed,
        length_unit=loaded.length_unit,
    )


@stage
def statistics(
    *, scene: str, database: str, seeds: Sequence[int], packings: Sequence[str], statistics: str
) -> None:
    """Certify and measure the packings of a scene, one a seed.

    Nothing is written where a certificate does not hold.
    """
    from grainfront.files import netcdf
    from grainfront.files.statistics import SceneStatistics, write_statistics

    loaded = api.load_scene(scene)
    built = netcdf.read_shapes(database)
    certificates, measured = [], []
    for path in packings:
        packing = netcdf.read_packing(path)
        certificates.append(api.require_certificate(path, packing))
        measured.append(api.measure(loaded, built, packing))
    write_statistics(
        statistics,
        SceneStatistics.of(seeds, measured, certificates),
        scene_text=loaded.text,
        length_unit=loaded.length_unit,
    )


@stage
def vtk(*, packing: str, vtp: str) -> None:
    """Write a packing for ParaView."""
    from grainfront.files.netcdf import read_packing
    from grainfront.files.vtk import write_vtp

    write_vtp(vtp, read_packing(packing))


@stage
def photograph(*, scene: str, picture: str) -> None:
    """Draw the first image of a scene with the outlines found in it."""
    from grainfront import figures
    from grainfront.shapes.images import find_outlines

    source = api.load_scene(scene).shapes
    assert isinstance(source, api.ImageSource), "no photograph is planned for other sources"
    found = find_outlines(dataclasses.replace(source, paths=source.paths[:1]))[0]
    figure = figures.photograph(found.image, found.outlines, title=Path(found.path).name)
    figures.save_png(figure, picture)


@stage
def figures(
    *,
    length_unit: str,
    hulls: str,
    outlines: str | None,
    contacts: str,
    statistics: str,
    packing_picture: str,
    laws_picture: str,
    contacts_picture: str,
    rose_picture: str,
) -> None:
    """Draw the packing of the first seed, its laws, its contacts and its rose."""
    from grainfront import figures
    from grainfront.files import netcdf
    from grainfront.files.statistics import read_statistics

    packed = netcdf.read_packing(hulls)
    replaced = netcdf.read_packing(outlines) if outlines else None
    touching = netcdf.read_contacts(contacts)
    measured = read_statistics(statistics)
    drawn_packings = [packed] if replaced is None else [packed, replaced]
    drawn = {
        packing_picture: figures.packing(
            packed,
            replaced,
            length_unit=length_unit,
            volume_fractions=[api.volume_fractions(each)[0] for each in drawn_packings],
        ),
        laws_picture: figures.laws(measured.distributions[0], length_unit=length_unit),
        contacts_picture: figures.contacts(
            packed,
            touching,
            measured.contact_shares[0],
            float(measured.values["coordination_number"][0]),
            length_unit=length_unit,
        ),
        rose_picture: figures.rose(measured.orientation_roses[0], api.contact_rose(touching)),
    }
    for path, figure in drawn.items():
        figures.save_png(figure, path)
