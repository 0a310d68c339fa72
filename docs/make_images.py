"""Draw the pictures of README and docs from shipped scenes: `python docs/make_images.py`.

Those of errors against run time and of stability come from records, which take minutes to make:
`python docs/make_images.py results/error_vs_time_gravel/error_vs_time.nc`, and
`python docs/make_images.py results/stability/stability.nc`.
"""

from __future__ import annotations

import io
import sys
from pathlib import Path

from matplotlib.figure import Figure
from PIL import Image

from grainfront import api, figures
from grainfront.files.contour import Contour
from grainfront.files.error_vs_time import read_error_vs_time
from grainfront.files.stability import read_stability
from grainfront.from_scene.regions import distances
from grainfront.scene import Scene
from grainfront.shapes.images import find_outlines
from grainfront.studies import sweep

ROOT = Path(__file__).parents[1]
IMAGES = Path(__file__).parent / "images"
DPI = 150
COARSE_DPI = 120  # thousands of grains once more, after those of the README
SCENES = ("cow", "graded_bed", "shear_band", "hopper", "periodic_cell")
COLOURS = 256  # a palette: a third of the bytes


def main() -> None:
    """Pack the gravel and draw the photograph and the packing; draw a contour map."""
    scene = api.load_scene(ROOT / "config" / "scenes" / "river_gravel.yaml")
    found = find_outlines(scene.shapes)[0]
    draw = {
        "photograph": figures.photograph(
            found.image, found.outlines, title="gravel, from scikit-image"
        ),
        "packing": packing_of("river_gravel"),
        "contour": contour_map(),
        "arrangement": zones_of(scene),
        **{name: packing_of(name) for name in SCENES},
    }
    for name, figure in draw.items():
        save_small(figure, IMAGES / f"{name}.png", COARSE_DPI if name in SCENES else DPI)


def zones_of(scene: Scene) -> Figure:
    """Draw the zones of a scene's regions."""
    measured = distances(scene)
    return figures.signed_distance(
        list(measured.values()),
        [f"region {number}" for number in measured],
        scene.domain,
        length_unit=scene.length_unit,
    )


def packing_of(name: str) -> Figure:
    """Pack a scene and draw it."""
    scene = api.load_scene(ROOT / "config" / "scenes" / f"{name}.yaml")
    database = api.build_shapes(scene)
    packing, _ = api.pack(scene, database, scene.seeds[0])
    outlines = api.replace(packing, database) if scene.replacement else None
    drawn = [packing] if outlines is None else [packing, outlines]
    return figures.packing(
        packing,
        outlines,
        length_unit=scene.length_unit,
        volume_fractions=[api.volume_fractions(each)[0] for each in drawn],
    )


def draw_record(path: str) -> None:
    """Draw the stability matrix, or the axes of a record of errors against run time."""
    if Path(path).stem == "stability":
        found = read_stability(path)
        save_small(figures.stability(found), IMAGES / "stability.png")
        save_small(figures.clearance(found), IMAGES / "clearance.png")
        return
    _, axes = read_error_vs_time(path)
    for axis, quantities in axes.items():
        figure = figures.error_vs_time(axis, quantities)
        save_small(figure, IMAGES / f"error_vs_time_{axis}.png")


def contour_map() -> Figure:
    """Pack the sweep of contour_rectangles."""
    scene = api.load_scene(ROOT / "config" / "scenes" / "contour_rectangles.yaml")
    assert scene.target is not None
    efforts, seeds = sweep.sweep_of(scene), sweep.seeds(scene)
    database = api.build_shapes(scene)
    numbers = dict(sweep.pack_points(scene, database, sweep.points(scene), threads=2))
    found = Contour.of(
        efforts.n_angle, efforts.n_loc, seeds, lambda *point: numbers[sweep.Point(*point)]
    )
    return figures.contour(
        found.n_angle,
        found.n_loc,
        found.volume_fraction,
        seeds=len(seeds),
        target=scene.target.volume_fraction,
    )


def save_small(figure: Figure, path: Path, dpi: int = DPI) -> None:
    """Write a figure with the resolution and the colours that a page needs."""
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=dpi, bbox_inches="tight", pad_inches=0.05)
    image = (
        Image.open(drawn)
        .convert("RGB")
        .quantize(COLOURS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    )
    image.save(path, optimize=True)


if __name__ == "__main__":
    if sys.argv[1:]:
        draw_record(sys.argv[1])
    else:
        main()
