"""Target volume fractions by the workflow: reached, repeated, started from a map, or refused."""

from __future__ import annotations

import pytest
import xarray

TARGET, TOLERANCE = 0.72, 0.004
TARGETED = ["results/tiny/1/nonconvex.nc", "results/tiny/2/nonconvex.nc"]
ATTEMPTS = "results/tiny/1/target.nc"


def with_keys(project, **keys):
    """The project, its scene `tiny` with more keys."""
    scene = project.folder / "config/scenes/tiny.yaml"
    more = "".join(f"{key}: {value}\n" for key, value in keys.items())
    scene.write_text(scene.read_text(encoding="utf-8") + more, encoding="utf-8")
    return project


def targeted(project, target=TARGET, **keys):
    return with_keys(project, target_volume_fraction=target, target_tolerance=TOLERANCE, **keys)


@pytest.fixture(scope="module")
def reached(tmp_path_factory, new_project):
    """A project with packings to a target, made on one core."""
    project = targeted(new_project(tmp_path_factory.mktemp("reached") / "project"))
    run = project.snakemake("--cores", "1", *TARGETED)
    assert run.returncode == 0, run.stderr
    return project


def test_the_outlines_have_the_fraction_asked_for(reached):
    for path in TARGETED:
        with xarray.open_dataset(reached.folder / path) as outlines:
            assert abs(outlines.attrs["volume_fraction"] - TARGET) <= TOLERANCE


def test_the_attempts_are_there_and_the_best_was_taken(reached):
    with xarray.open_dataset(reached.folder / ATTEMPTS) as attempts:
        assert attempts.attrs["target_volume_fraction"] == TARGET
        differences = abs(attempts.volume_fraction.values - TARGET)
        assert (differences[:-1] > TOLERANCE).all(), "no attempt is made once one has reached it"
        assert differences[-1] <= TOLERANCE
        assert (attempts.shared_particles < attempts.particles).all()
        taken = attempts.volume_fraction.values[-1]
    with xarray.open_dataset(reached.folder / TARGETED[0]) as outlines:
        assert outlines.attrs["volume_fraction"] == pytest.approx(taken, abs=1e-9)


def test_two_cores_give_the_same_bytes(reached, project):
    run = targeted(project).snakemake("--cores", "2", *TARGETED)
    assert run.returncode == 0, run.stderr
    for name in (*TARGETED, ATTEMPTS, "results/tiny/2/target.nc"):
        assert (project.folder / name).read_bytes() == (reached.folder / name).read_bytes()


def test_a_map_tells_where_to_start(project):
    targeted(project, sweep="{n_angle: [1, 6], n_loc: [1, 5]}")
    jobs = project.planned("--", ATTEMPTS)
    assert jobs["contour"] == 1 and jobs["packing_to_target"] == 1
    run = project.snakemake("--cores", "2", ATTEMPTS)
    assert run.returncode == 0, run.stderr
    with xarray.open_dataset(project.folder / "results/tiny/contour.nc") as found:
        assert (found.volume_fraction_outlines < found.volume_fraction).all()


def test_out_of_reach_is_one_sentence_and_leaves_no_packing(project):
    run = targeted(project, target=0.95).snakemake("--cores", "1", TARGETED[0])
    assert run.returncode != 0
    told = [line for line in run.stderr.splitlines() if line.startswith("grainfront: tiny: ")]
    assert len(told) == 1
    assert "target_volume_fraction is 0.95, but this scene reaches 0." in told[0]
    assert "Traceback" not in run.stderr
    assert not list(project.folder.glob("results/tiny/1/*.nc"))
