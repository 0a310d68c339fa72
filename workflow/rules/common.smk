# The scenes, checked; what each of them asks for; and on what the results of each stage depend.

import json
import os
import sys
from pathlib import Path

import yaml

from grainfront import api, stages
from grainfront.checked_yaml import parse_checked, read_text
from grainfront.errors import InputError
from grainfront.image_files import SHIPPED


wildcard_constraints:
    scene="[A-Za-z0-9_-]+",
    seed="[0-9]+",
    particles="packing|nonconvex",
    kind="|_nonconvex",


# The files of the hulls as packed and of the outlines that replaced them differ by these endings.
KINDS = {"": "packing", "_nonconvex": "nonconvex"}
PICTURES = ["packing", "laws", "contacts", "rose"]


def scene_file(scene):
    return f"config/scenes/{scene}.yaml"


def read_config():
    """The configuration and what `--config` changes in it, checked; InputError where at fault.

    Snakemake's own `configfile:` would run what a template says.
    """
    name = "config/config.yaml"
    schema = json.loads(read_text(Path(workflow.basedir) / "config/config.schema.json"))
    given = parse_checked(read_text(Path(name)), schema, name)
    return parse_checked(yaml.safe_dump(given | config), schema, name)


def files_of_shapes(scene):
    """The files that the shapes of a scene come from; a photograph of scikit-image is none."""
    source = scene.shapes
    paths = [source.path] if hasattr(source, "path") else getattr(source, "paths", [])
    return [path for path in paths if not path.startswith(SHIPPED)]


def read_scene(name):
    """A scene, checked; InputError where it is at fault or names files that Snakemake cannot take."""
    scene = api.load_scene(scene_file(name))
    for path in [*files_of_shapes(scene), *scene.zone_files]:
        if "{" in path or "}" in path:
            raise InputError(
                f"{scene_file(name)}: the file {path!r} must have a name without braces, "
                "which Snakemake takes for wildcards"
            )
    return scene


try:
    CONFIG = read_config()
    SCENES = {name: read_scene(name) for name in CONFIG["scenes"]}
except InputError as error:
    sys.exit(api.sentence(error))


# Told once, before the first job, not by each of them.
onstart:
    Path("results").mkdir(exist_ok=True)
    if not os.access("results", os.W_OK):
        sys.exit("grainfront: results: the folder is not writable.")


def image_files(wildcards):
    return files_of_shapes(SCENES[wildcards.scene])


def zone_files(wildcards):
    """The images and files that the domain and the regions of a scene come from."""
    return SCENES[wildcards.scene].zone_files


def kinds_of(scene):
    """The hulls as packed and, with replacement, the outlines."""
    return list(KINDS) if scene.replacement else [""]


def has_images(scene):
    return isinstance(scene.shapes, api.ImageSource)


def has_zones(scene):
    regions = scene.arrangement.regions if scene.arrangement else ()
    return any(region.inside for region in regions)


def results_of(scene):
    """Every file that a scene asks for."""
    folder = f"results/{scene.name}"
    for kind in kinds_of(scene):
        yield f"{folder}/statistics{kind}.nc"
        for seed in scene.seeds:
            yield f"{folder}/{seed}/{KINDS[kind]}.nc"
            yield f"{folder}/{seed}/contacts{kind}.nc"
            if "vtk" in scene.outputs:
                yield f"{folder}/{seed}/{KINDS[kind]}.vtp"
    if scene.target:
        yield from (f"{folder}/{seed}/target.nc" for seed in scene.seeds)
    if scene.sweep:
        yield from (f"{folder}/contour.nc", f"{folder}/contour_timing.nc")
    if "figures" in scene.outputs:
        pictures = PICTURES + ["photograph"] * has_images(scene)
        pictures += ["contour"] * bool(scene.sweep)
        pictures += ["arrangement"] * has_zones(scene)
        yield from (f"{folder}/figures/{picture}.png" for picture in pictures)


def of_scene(*fields):
    """A param of a rule: the fields of the scene that its results depend on."""
    return lambda wildcards: repr(
        [getattr(SCENES[wildcards.scene], name) for name in fields]
    )
