"""The profile for Slurm names what is there: options of Snakemake, and every rule, each once.

That jobs run on Slurm is shown by `make test-slurm`; here its plugin need not be installed.
"""

from __future__ import annotations

import subprocess
import sys

import yaml

PROFILE = "workflow/profiles/slurm"
# Options are checked with the executor that is there, which is all that this changes.
HERE = ("--profile", PROFILE, "--executor", "local", "--cores", "2")


def settings(project) -> dict:
    return yaml.safe_load((project.folder / PROFILE / "config.yaml").read_text(encoding="utf-8"))


def rules(project) -> set[str]:
    listed = project.snakemake("--list-rules")
    assert listed.returncode == 0, listed.stderr
    without_work = {"all", "error_vs_time", "stability"}
    return set(listed.stdout.split()) - without_work


def test_snakemake_takes_the_profile_and_plans_the_same_jobs(project):
    assert project.planned(*HERE) == project.planned()


def test_a_setting_unknown_to_snakemake_would_be_told(project):
    project.edit(f"{PROFILE}/config.yaml", "latency-wait: 60", "latency-weight: 60")
    run = subprocess.run(
        [sys.executable, "-m", "snakemake", "--dry-run", *HERE],
        cwd=project.folder, capture_output=True, text=True,
    )  # fmt: skip
    assert run.returncode != 0
    assert "latency-weight" in run.stderr


def test_every_rule_has_its_resources_and_no_other(project):
    resources = settings(project)["set-resources"]
    assert set(resources) == rules(project)
    assert all({"runtime", "mem_mb"} <= set(names) for names in resources.values())


def test_steps_of_a_seed_run_one_at_a_time_in_the_job_that_they_share(project):
    found = settings(project)
    taken = {rule for rule, names in found["set-resources"].items() if "step_of_a_seed" in names}
    assert taken == set(found["groups"])
    assert found["set-resource-scopes"] == {"step_of_a_seed": "local"}


def test_jobs_are_not_submitted_as_arrays(project):
    assert "slurm-array-jobs" not in settings(project)
