"""Names are names, in the workflow too: nothing in them is run, expanded or taken for a path."""

from __future__ import annotations

import pytest

SHAPES = "results/tiny/shapes.nc"
TRIANGLE = "POLYGON ((0 0, 2 0, 1 2, 0 0))\n"


def with_outlines(project, name):
    """The project, the shapes of its scene `tiny` from an outlines file of this name."""
    (project.folder / "config/scenes" / name).write_text(TRIANGLE)
    scene = project.folder / "config/scenes/tiny.yaml"
    text = scene.read_text(encoding="utf-8")
    family = text[text.index("  family:") : text.index("size:")]
    quoted = name.replace("\n", "\\n").replace('"', '\\"')
    scene.write_text(text.replace(family, f'  outlines_file: {{path: "{quoted}"}}\n\n'))
    return project


@pytest.mark.parametrize(
    "name", ['it\'s; "a" $(touch hurt) `touch hurt` ü & *', "-rf %s\nand a line"]
)
def test_strange_names_of_folders_and_files_are_safe(new_project, tmp_path, name):
    project = with_outlines(new_project(tmp_path / name), f"{name}.wkt")
    run = project.snakemake("--cores", "1", SHAPES)
    assert run.returncode == 0, run.stderr
    assert (project.folder / SHAPES).is_file()
    assert list(tmp_path.rglob("hurt")) == []


def test_a_file_with_braces_in_its_name_is_refused(project):
    run = with_outlines(project, "a {wildcards.scene}.wkt").snakemake("--dry-run")
    assert run.returncode != 0
    (sentence,) = [line for line in run.stderr.splitlines() if line.startswith("grainfront: ")]
    assert "config/scenes/tiny.yaml" in sentence and "without braces" in sentence


@pytest.mark.parametrize("scene", ["../tiny", "tiny; touch hurt", "tiny\\n", "$(touch hurt)"])
def test_a_scene_is_named_by_letters_alone(project, scene):
    (project.folder / "config/config.yaml").write_text(f'scenes: ["{scene}"]\n')
    run = project.snakemake("--dry-run")
    assert run.returncode != 0
    (sentence,) = [line for line in run.stderr.splitlines() if line.startswith("grainfront: ")]
    assert "scenes[0]" in sentence and "Traceback" not in run.stderr
    assert list(project.folder.rglob("hurt")) == []


def test_the_configuration_is_no_template(project):
    """Snakemake's own `configfile:` runs what follows the question mark (yte)."""
    (project.folder / "config/config.yaml").write_text(
        "__use_yte__: true\nscenes:\n  - ?open('hurt', 'w').name\n"
    )
    run = project.snakemake("--dry-run")
    assert run.returncode != 0 and "__use_yte__ is an unknown key" in run.stderr
    assert not (project.folder / "hurt").exists()
