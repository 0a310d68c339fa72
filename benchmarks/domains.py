"""Volume fraction and time in domains of any shape and in periodic cells.

`python benchmarks/domains.py SCENE.yaml ...` for the grains of each scene, its regions left out.
Areas are equal, so that about as many grains are packed; φ_bulk is the mean of the seeds.
"""

from __future__ import annotations

import dataclasses
import sys

import numpy as np
import shapely

from grainfront import api
from grainfront.arrangement.resolve import resolve_bounded
from grainfront.arrangement.zones import Silhouette
from grainfront.particles import Cell, Rectangle, Region
from grainfront.scene import Scene

SEEDS = (1, 2, 3)
HOPPER = [(50, 0), (70, 0), (70, 20), (120, 90), (120, 160), (0, 160), (0, 90), (50, 20)]
INSERT = [(45, 95), (75, 95), (60, 125)]


def domains(area: float) -> dict[str, Rectangle]:
    """The rectangle, domains of other shapes, and periodic cells, all of an area."""
    side = float(np.sqrt(area))
    shapes = {
        "square as polygon": shapely.box(0, 0, 1, 1),
        "square with hole": shapely.box(0, 0, 1, 1).difference(shapely.box(0.35, 0.35, 0.65, 0.65)),
        "circle": shapely.Point(0, 0).buffer(1.0, quad_segs=45),
        "hopper": shapely.Polygon(HOPPER, [INSERT]),
        "horse": resolve_bounded(Silhouette("skimage:horse", (0.0, 0.0), width=1.0)),
    }
    found: dict[str, Rectangle] = {"rectangle": Rectangle(0.0, 0.0, side, side)}
    for name, shape in shapes.items():
        factor = side / float(np.sqrt(shape.area))
        found[name] = Region.of(shapely.transform(shape, lambda nodes, by=factor: nodes * by))
    found["periodic in x"] = Cell(0.0, 0.0, side, side, along_y=False)
    found["periodic in x, y"] = Cell(0.0, 0.0, side, side, along_y=True)
    return found


def measure(scene: Scene) -> None:
    """Print a line for each domain."""
    database = api.build_shapes(scene)
    print(f"\n{scene.name}: n_angle {scene.packing.n_angle}, n_loc {scene.packing.n_loc}")
    print("domain             particles  φ       φ_bulk  ± seeds  E2 of S  noise    µs a particle")
    for name, domain in domains(scene.domain.area).items():
        rows = []
        for seed in SEEDS:
            one = dataclasses.replace(scene, domain=domain)
            packing, time = api.pack(one, database, seed)
            assert api.certify(packing).holds
            found = api.measure(one, database, packing)
            size = found.distributions["size"]
            rows.append(
                (
                    found.particles, found.volume_fraction, found.volume_fraction_bulk,
                    size.l2_error, size.noise_level, 1e6 * time.kernel_s / found.particles,
                )
            )  # fmt: skip
        n, fraction, bulk, error, noise, us = np.mean(rows, axis=0)
        spread = np.std([row[2] for row in rows], ddof=1)
        print(
            f"{name:18s} {n:9.0f}  {fraction:.4f}  {bulk:.4f}  {spread:.4f}   "
            f"{100 * error:.2f} %   {100 * noise:.2f} %  {us:8.0f}",
            flush=True,
        )


if __name__ == "__main__":
    for path in sys.argv[1:]:
        measure(dataclasses.replace(api.load_scene(path), arrangement=None, target=None))
