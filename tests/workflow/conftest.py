"""Copies of the project, in which the workflow runs as a user would run it."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


class Project:
    """A copy of what the workflow needs, with the scene `tiny` to be built."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for part in ("config", "profiles", "workflow"):
            shutil.copytree(ROOT / part, folder / part)
        shutil.copy(ROOT / "Snakefile", folder)
        (folder / "config/config.yaml").write_text("scenes: [tiny]\n")

    def snakemake(self, *options: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "snakemake", *options]
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True)

    def planned(self, *options: str) -> dict[str, int]:
        """Jobs that would run now, by rule."""
        dry = self.snakemake("--dry-run", "--quiet", "rules", *options)
        assert dry.returncode == 0, dry.stderr
        text = dry.stdout + dry.stderr
        if "Nothing to be done" in text:
            return {}
        table = re.search(r"^job +count\n[- ]+\n(.*?)^total", text, re.MULTILINE | re.DOTALL)
        jobs = {name: int(count) for name, count in re.findall(r"(\w+) +(\d+)\n", table[1])}
        jobs.pop("all", None)  # none where single files are asked for
        return jobs

    def edit(self, name: str, old: str, new: str) -> None:
        """Change one place in a file."""
        path = self.folder / name
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{name} has {text.count(old)} places like {old}"
        path.write_text(text.replace(old, new), encoding="utf-8")


@pytest.fixture(scope="session")
def new_project() -> type[Project]:
    """Makes projects, for fixtures that outlive a test."""
    return Project


@pytest.fixture
def project(tmp_path) -> Project:
    """A project in which nothing has been built."""
    return Project(tmp_path / "project")


@pytest.fixture(scope="session")
def built(tmp_path_factory) -> Project:
    """A project in which `tiny` was built on one core; not to be changed."""
    project = Project(tmp_path_factory.mktemp("built") / "project")
    run = project.snakemake("--cores", "1")
    assert run.returncode == 0, run.stderr
    return project


@pytest.fixture
def copy_of_built(built, tmp_path) -> Project:
    """A copy of the built project, with the times of its files, to be edited."""
    project = Project.__new__(Project)
    project.folder = tmp_path / "copy"
    shutil.copytree(built.folder, project.folder)
    return project
