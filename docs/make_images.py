"""Draw the pictures of the README from the scene river_gravel: `python docs/make_images.py`."""

from __future__ import annotations

import io
from pathlib import Path

from matplotlib.figure import Figure
from PIL import Image

from grainfront import api, figures
from grainfront.shapes.images import find_outlines

ROOT = Path(__file__).parents[1]
IMAGES = Path(__file__).parent / "images"
DPI = 150
COLOURS = 256  # a palette: a third of the bytes


def main() -> None:
    """Pack the gravel and draw the photograph and the packing."""
    scene = api.load_scene(ROOT / "config" / "scenes" / "river_gravel.yaml")
    database = api.build_shapes(scene)
    packing, _ = api.pack(scene, database, scene.seeds[0])
    outlines = api.replace(packing, database)
    found = find_outlines(scene.shapes)[0]
    draw = {
        "photograph": figures.photograph(
            found.image, found.outlines, title="gravel, from scikit-image"
        ),
        "packing": figures.packing(
            packing,
            outlines,
            length_unit=scene.length_unit,
            volume_fractions=[api.volume_fractions(each)[0] for each in (packing, outlines)],
        ),
    }
    for name, figure in draw.items():
        save_small(figure, IMAGES / f"{name}.png")


def save_small(figure: Figure, path: Path) -> None:
    """Write a figure with the resolution and the colours that a page needs."""
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=DPI, bbox_inches="tight", pad_inches=0.05)
    image = (
        Image.open(drawn)
        .convert("RGB")
        .quantize(COLOURS, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    )
    image.save(path, optimize=True)


if __name__ == "__main__":
    main()
