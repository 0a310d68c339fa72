"""The kernels as plain Python: the same tests pass, and a packing is the same, bit for bit."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from grainfront.packing.orientations import orientation_law
from grainfront.packing.pack import fill
from grainfront.packing.prepare import prepare
from grainfront.particles import Rectangle
from grainfront.polygons import Polygons

TESTS = Path(__file__).parent
WITHOUT_JIT = {**os.environ, "NUMBA_DISABLE_JIT": "1"}


def digest_of_a_packing() -> str:
    """Pack some forty pentagons and digest where they are."""
    angle = np.arange(5) * 0.4 * np.pi + 0.1
    rng = np.random.default_rng(5)
    empty = prepare(
        Polygons.of([np.column_stack([np.cos(angle), np.sin(angle)]) / 1.8]),
        np.zeros(150, dtype=np.int64),
        rng.uniform(0.5, 1.0, 150),
        [orientation_law(np.full(12, 1 / 12), np.linspace(0.0, 180.0, 3073))],
        Rectangle(0.0, 0.0, 6.0, 6.0),
        6,
        4,
        rng,
    )
    packing, _ = fill(empty, np.ones(1))
    assert packing.x.size > 30
    return hashlib.sha256(packing.polygons.nodes.tobytes()).hexdigest()


if __name__ == "__main__":
    print(digest_of_a_packing())


@pytest.mark.skipif("NUMBA_DISABLE_JIT" in os.environ, reason="the kernels are not compiled")
class TestWithoutJit:
    def test_a_packing_is_the_same(self):
        interpreted = subprocess.run(
            [sys.executable, __file__], env=WITHOUT_JIT, capture_output=True, text=True, check=True
        )
        assert interpreted.stdout.strip() == digest_of_a_packing()

    @pytest.mark.parametrize("folder", ["geometry", "packing", "arrangement"])
    def test_the_tests_of_the_kernels_pass(self, folder):
        run = subprocess.run(
            [sys.executable, "-m", "pytest", "-m", "not compiled", "-p", "no:cacheprovider",
             TESTS / folder],
            env=WITHOUT_JIT, capture_output=True, text=True,
        )  # fmt: skip
        assert run.returncode == 0, run.stdout
