"""The benchmarks run, and their checks hold; how long they take is nobody's business here."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).parents[2] / "benchmarks"


def test_a_quick_run_measures_every_subject():
    command = [sys.executable, str(FOLDER / "run.py"), "--quick"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    for title in (
        "Kernels", "Packings", "Laws kept", "Pruning", "Growth", "Checks", "Effort", "Targets",
        "Compilation",
    ):  # fmt: skip
        assert f"## {title}\n" in run.stdout
    assert "**no**" not in run.stdout, "pruned and exhaustive search chose differently"


def test_an_unknown_subject_is_refused():
    command = [sys.executable, str(FOLDER / "run.py"), "--quick", "kernel"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 2
    assert "there is no subject kernel" in run.stderr
