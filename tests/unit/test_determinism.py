"""Golden digests: packings are the same to the last bit, compiled or not, on any number of threads.

CONTRIBUTING.md says when they may change. `python tests/unit/test_determinism.py` prints them.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pytest
from scipy import special

import grainfront

RECTANGLES = """
seed: 7
domain: {width: 12, height: 12}
shapes: {family: {rectangle: {aspect_ratio: [1, 3], count: 21}}}
size: {uniform: {minimum: 0.6, maximum: 1.4}}
packing: {n_angle: 1, n_loc: 1}
"""
OUTLINES = """
seed: 7
domain: {width: 10, height: 10}
shapes: {family: {fourier_grain: {count: 40, vertices: 32, d2: 0.15, d3: 0.1, d8: 0.03}}}
size: {lognormal: {median: 1.2, log_standard_deviation: 0.3, minimum: 0.6, maximum: 2}}
aspect_ratio: {uniform: {minimum: 1.2, maximum: 1.4}}
orientation: {normal: {mean: 30, standard_deviation: 20, minimum: -60, maximum: 120}}
packing: {n_angle: 4, n_loc: 8, n_bin: 12}
replacement: true
"""
REGIONS = """
seed: 7
domain: {width: 10, height: 10}
shapes: {family: {random_convex_polygon: {vertices: 8, count: 30}}}
size: {uniform: {minimum: 0.8, maximum: 1.6}}
packing: {n_angle: 3, n_loc: 3, n_bin: 12}
arrangement:
  regions:
    - inside: {circle: {centre: [5, 5], radius: 3}}
      size: {uniform: {minimum: 0.4, maximum: 0.7}}
"""
WALLS = """\
seed: 3
domain: {inside: {polygon: {nodes: [[0, 0], [6, 1], [12, 0], [9, 10], [4, 11]]}}}
shapes: {family: {random_convex_polygon: {vertices: 6, count: 5}}}
size: {uniform: {minimum: 0.5, maximum: 1.1}}
packing: {n_angle: 2, n_loc: 2, n_bin: 12}
"""
SCENES = {"rectangles": RECTANGLES, "outlines": OUTLINES, "regions": REGIONS, "walls": WALLS}
GOLDEN = {
    "rectangles": "24b1d2ddbd0d6be158f8fe11143ced2800d130a0c8831a0e133c1a5b347e85df",
    "outlines": "b057318c73ce7ce09a89332bb5d55f8157f070ca858bce3452546ce0308cc791",
    "regions": "4dd8e32aac82a91ca7efe57200ea28bf20f88f2673884f140fd67d87dcd86893",
    "walls": "7c137f8fcef5b751f1e87c0a80830b60f2680b964d9ab71137c7a623f1afde59",
}
# Of the functions that libraries compute in their own way on each kind of processor.
ARITHMETIC = "a64996b422947921d48f6f0449c8724d5eaeae3fce27e8b4056f5f7d87f9aa4f"

ONE_THREAD = {"OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


def digest(text: str) -> str:
    """SHA-256 of where the particles of a scene are, hulls and outlines, and of what they are."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.yaml"
        path.write_text(text)
        scene = grainfront.load_scene(path)
    database = grainfront.build_shapes(scene)
    packing, _ = grainfront.pack(scene, database, scene.seeds[0])
    assert packing.x.size > 40 and grainfront.certify(packing).holds
    arrays = [packing.polygons.nodes, packing.x, packing.y, packing.orientation, packing.shape]
    if scene.replacement:
        arrays.append(grainfront.replace(packing, database).polygons.nodes)
    return hashlib.sha256(b"".join(array.tobytes() for array in arrays)).hexdigest()


def digests() -> dict[str, str]:
    return {name: digest(text) for name, text in SCENES.items()}


def arithmetic() -> str:
    """SHA-256 of elementary functions of many numbers, by numpy, scipy and the C library."""
    x = np.linspace(0.001, 0.999, 4001)
    values = [f(x) for f in (np.sin, np.cos, np.exp, np.log, np.sqrt, special.ndtri, special.ndtr)]
    values += [x**1.7, np.arctan2(x, x[::-1]), np.array([math.sin(v) + math.cos(v) for v in x])]
    return hashlib.sha256(b"".join(value.tobytes() for value in values)).hexdigest()


def digests_elsewhere(**variables: str) -> dict[str, str]:
    """The digests that another process finds, with these environment variables."""
    run = subprocess.run(
        [sys.executable, __file__], env={**os.environ, **variables}, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)["GOLDEN"]


if __name__ == "__main__":
    print(json.dumps({"GOLDEN": digests(), "ARITHMETIC": arithmetic()}, indent=4))


@pytest.mark.skipif(
    arithmetic() != ARITHMETIC, reason="numpy or the C library round otherwise on this processor"
)
def test_packings_are_those_that_were_recorded():
    assert digests() == GOLDEN


def test_packings_are_the_same_on_one_thread():
    assert digests_elsewhere(**ONE_THREAD) == digests()


@pytest.mark.parametrize("rubbish", [-5, 7])
def test_packings_do_not_depend_on_what_memory_held_before(monkeypatch, rubbish):
    def full_of_rubbish(shape, dtype=np.float64, **options):
        value = np.nan if rubbish < 0 and np.dtype(dtype).kind == "f" else rubbish
        return np.full(shape, value, dtype, **options)

    expected = digests()
    monkeypatch.setattr(np, "empty", full_of_rubbish)
    assert digests() == expected


@pytest.mark.skipif("NUMBA_DISABLE_JIT" in os.environ, reason="the kernels are not compiled")
def test_packings_are_the_same_without_compilation():
    assert digests_elsewhere(NUMBA_DISABLE_JIT="1") == digests()
