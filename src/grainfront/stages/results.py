"""What packings are like: contacts, certificate and statistics, pictures."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path

from grainfront import api
from grainfront.stages.stage import stage


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
        api.warn_of_empty_rooms(path, packing)
        api.warn_of_much_left_over(path, packing)
        api.warn_of_empty_regions(path, loaded, packing)
        measured.append(api.measure(loaded, built, packing))
    write_statistics(
        statistics,
        SceneStatistics.of(seeds, measured, certificates),
        scene_text=loaded.text,
        length_unit=loaded.length_unit,
    )


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
def arrangement_picture(*, scene: str, picture: str) -> None:
    """Draw the signed distances to the zones of a scene's regions."""
    from grainfront import figures
    from grainfront.from_scene.regions import distances

    loaded = api.load_scene(scene)
    measured = distances(loaded)
    figure = figures.signed_distance(
        list(measured.values()),
        [f"region {number}" for number in measured],
        loaded.domain,
        length_unit=loaded.length_unit,
    )
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
