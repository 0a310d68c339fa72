"""The command line: one packing, or one shape database, without the workflow."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TypeAlias

from grainfront import api
from grainfront.errors import InputError
from grainfront.files.atomic import require_writable
from grainfront.scene import IMAGES, scene_schema
from grainfront.shapes import sources
from grainfront.shapes.sources import ShapeSource

FAULTY_INPUT = 2

Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"

OUTLINE_SUFFIXES = (".geojson", ".json", ".wkt", ".csv")
SCENE_SUFFIXES = (".yaml", ".yml")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; the exit status: 0, or 2 where the input or the output is at fault."""
    options = _parser().parse_args(arguments)
    try:
        options.run(options)
    except (InputError, OSError, MemoryError) as error:
        print(api.sentence(error), file=sys.stderr)
        return FAULTY_INPUT
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="grainfront", description="Dense, overlap-free packings of irregular grains."
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    _add_pack(commands)
    _add_shapes(commands)
    _add_effort(commands)
    return parser


def _add_pack(commands: Commands) -> None:
    pack = commands.add_parser(
        "pack",
        help="pack the grains of a scene",
        description="Pack the grains of a scene, certify the packing and write its hulls. The "
        "workflow (snakemake) also writes outlines, contacts, statistics and pictures.",
    )
    pack.add_argument("scene", metavar="SCENE.yaml", help="the scene")
    pack.add_argument(
        "-o", "--output", required=True, metavar="packing.nc", help="where the packing goes"
    )
    pack.add_argument(
        "--seed",
        type=_seed,
        metavar="N",
        help="seed; that of the scene, or its first, if not given",
    )
    pack.add_argument("--json", action="store_true", help="print the result as one JSON object")
    pack.set_defaults(run=_pack)


def _add_shapes(commands: Commands) -> None:
    shapes = commands.add_parser(
        "shapes",
        help="build a shape database",
        description="Standardise the shapes of a source and tell what was found.",
    )
    shapes.add_argument(
        "source",
        metavar="SOURCE",
        help="an image, an outlines file (.geojson, .json, .wkt, .csv), skimage:gravel, or a "
        "scene (.yaml), whose shapes are built",
    )
    shapes.add_argument(
        "--kind", choices=IMAGES, default="photographs", help="what an image is (photographs)"
    )
    shapes.add_argument(
        "-o", "--output", required=True, metavar="shapes.nc", help="where the database goes"
    )
    shapes.set_defaults(run=_shapes)


def _add_effort(commands: Commands) -> None:
    effort = commands.add_parser(
        "effort",
        help="find the least effort that reaches a volume fraction",
        description="Recommend the cheapest n_angle and n_loc that reach a volume fraction in a "
        "scene, and tell what volume fraction and time to expect, from short pilot packings. "
        "n_angle up to 48 and n_loc up to 40 are considered, or up to the scene's own where these "
        "are larger. Where the scene replaces hulls, the volume fraction is that of the outlines.",
    )
    effort.add_argument("scene", metavar="SCENE.yaml", help="the scene")
    effort.add_argument(
        "--target",
        type=_fraction,
        metavar="FRACTION",
        help="the volume fraction; target_volume_fraction of the scene if not given",
    )
    effort.add_argument("--json", action="store_true", help="print the result as one JSON object")
    effort.set_defaults(run=_effort)


def _seed(text: str) -> int:
    try:
        seed = int(text)
    except ValueError:
        seed = -1
    largest = scene_schema()["properties"]["seed"]["maximum"]
    if not 0 <= seed <= largest:
        raise argparse.ArgumentTypeError(
            f"is {text:.30}, but must be a whole number from 0 to {largest}"
        )
    return seed


def _fraction(text: str) -> float:
    try:
        fraction = float(text)
    except ValueError:
        fraction = math.nan
    if not 0.0 < fraction < 1.0:
        raise argparse.ArgumentTypeError(
            f"is {text:.30}, but must be a number between 0 and 1, neither of them included"
        )
    return fraction


def _pack(options: argparse.Namespace) -> None:
    scene = api.load_scene(options.scene)
    seed = scene.seeds[0] if options.seed is None else options.seed
    _require_place(options.output, options.scene)
    database = api.build_shapes(scene)
    api.warn_of_uncovered(scene, database)
    with api.progress_bar() as progress:
        packing, run_time = api.pack(scene, database, seed, progress)
    api.require_certificate(options.output, packing)
    api.warn_of_empty_rooms(options.output, packing)
    api.warn_of_much_left_over(options.output, packing)
    api.warn_of_empty_regions(options.output, scene, packing)
    api.write_packing(options.output, packing, scene, seed)

    fraction, bulk = api.volume_fractions(packing)
    result = {
        "particles": packing.x.size,
        "volume_fraction": fraction,
        "volume_fraction_bulk": bulk if math.isfinite(bulk) else None,
        "kernel_s": run_time.kernel_s,
        "compile_s": run_time.compile_s,
        "left_over": packing.left_over,
    }
    outlines = ""
    if scene.replacement:
        of_outlines = api.volume_fraction_of_outlines(packing, database)
        result["volume_fraction_outlines"] = of_outlines
        outlines = f", their outlines {of_outlines:.4f}"
    if options.json:
        print(json.dumps(result))
    else:
        print(
            f"{result['particles']:,} particles at a volume fraction of {fraction:.4f} "
            f"({bulk:.4f} away from the walls){outlines}, packed in {run_time.kernel_s:.2f} s; "
            f"{packing.left_over} left over; certified; written to {options.output}"
        )


def _shapes(options: argparse.Namespace) -> None:
    _require_place(options.output, options.source)
    source = _source(options.source, options.kind)
    database = api.build_shapes_of(source)
    api.write_shapes(options.output, database, source)
    for what, count in database.counts.items():
        print(f"{what.replace('_', ' ')}: {count}")
    print(f"{database.count} shapes written to {options.output}")


def _effort(options: argparse.Namespace) -> None:
    # not imported above, as compiled code comes with it
    from grainfront.studies import effort

    scene = api.load_scene(options.scene)
    target = options.target
    if target is None:
        if scene.target is None:
            raise InputError(
                f"{options.scene}: has no target_volume_fraction and --target is not given, but "
                "one of them must be"
            )
        target = scene.target.volume_fraction
    if scene.arrangement is not None:
        print(
            f"grainfront: warning: {options.scene}: the pilot packings leave its regions out; "
            "with sizes parted between regions, expect 0.01 less.",
            file=sys.stderr,
        )
    database = api.build_shapes(scene)
    with _pilots_bar() as progress:
        found = effort.recommend(scene, database, target, progress)
    if options.json:
        print(json.dumps(asdict(found)))
        return
    of_outlines = " of the outlines" if scene.replacement else ""
    print(
        f"n_angle {found.n_angle} and n_loc {found.n_loc} are the cheapest that reach {target:g}: "
        f"expect a volume fraction{of_outlines} of {found.volume_fraction:.4f} ± "
        f"{found.spread:.4f} (two standard deviations) and some {found.particles:,} particles, "
        f"packed in {found.kernel_s:.2g} s of one core.\n"
        f"{found.pilots} pilot packings took {found.pilot_s:.1f} s, compiling the kernels or "
        f"reading them from the cache {found.compile_s:.1f} s; they are in the cache now."
    )


@contextmanager
def _pilots_bar() -> Iterator[Callable[[int], None] | None]:
    """A bar of pilots and the particles in them, on a terminal only."""
    if not sys.stderr.isatty():
        yield None
        return
    from tqdm import tqdm

    with tqdm(desc="pilots", unit=" particles", delay=api.SECONDS_BEFORE_BAR) as bar:
        yield lambda particles: bar.update(particles)


def _require_place(output: str, source: str) -> None:
    """Raise InputError, before any work is done, where the output cannot or must not be written."""
    require_writable(output)
    if Path(output).exists() and Path(source).exists() and Path(output).samefile(source):
        raise InputError(f"{output}: is the source itself, but must be another file")


def _source(text: str, kind: str) -> ShapeSource:
    """The source that a path names: a scene and outlines by their suffixes, else an image."""
    suffix = Path(text).suffix.lower()
    if suffix in SCENE_SUFFIXES:
        return api.load_scene(text).shapes
    if suffix in OUTLINE_SUFFIXES:
        return sources.OutlinesFile(text)
    return IMAGES[kind]((text,))


if __name__ == "__main__":
    raise SystemExit(main())
