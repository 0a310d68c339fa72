"""A trial of the workflow on a Slurm cluster of one machine: make test-slurm.

A sweep with a packing to a target, and a scene of several seeds, are built on this machine, and
again through the cluster. There a job of the sweep is killed (SIGKILL), which ends that run; the
next run resumes, and loses a job again (scancel), which it repeats. All result files must come out
the same, byte for byte.
"""

from __future__ import annotations

import filecmp
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from cluster import cluster, install

ROOT = Path(__file__).parents[2]
ON_SLURM = [
    "--profile", "workflow/profiles/slurm",
    "--slurm-status-command", "squeue",  # no slurmdbd here
    "--slurm-init-seconds-before-status-checks", "3",  # rather than 40: the jobs are short
    "--group-components", "seed=1",  # rather than 6: else seeds that need the sweep hold up others
]  # fmt: skip
PATIENCE_S = 300  # for a job to kill
TIMES = ("timing.json", "contour_timing.nc")


def project(folder: Path, chunk_seconds: int) -> Path:
    """A copy of what the workflow needs, with a sweep and a scene of three seeds to be built."""
    for part in ("config", "profiles", "workflow"):
        shutil.copytree(ROOT / part, folder / part)
    shutil.copy(ROOT / "Snakefile", folder)
    scenes = folder / "config/scenes"
    shutil.copy(ROOT / "tests/slurm/rectangles.yaml", scenes)
    tiny = (scenes / "tiny.yaml").read_text(encoding="utf-8")
    assert tiny.count("seeds: [1, 2] ") == 1
    (scenes / "tiny.yaml").write_text(
        tiny.replace("seeds: [1, 2] ", "seeds: [1, 2, 3] "), encoding="utf-8"
    )
    (folder / "config/config.yaml").write_text(
        f"scenes: [tiny, rectangles]\nchunk_seconds: {chunk_seconds}\n"
    )
    return folder


def snakemake(project: Path, options: list[str], environment: dict[str, str]) -> tuple[int, str]:
    """Run Snakemake; its exit code and what it said."""
    run = subprocess.run(
        [sys.executable, "-m", "snakemake", *options],
        cwd=project, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    return run.returncode, run.stdout


class Killer(threading.Thread):
    """Kills the first job of a sweep that is in the midst of its packings."""

    def __init__(self, project: Path, environment: dict[str, str], by: str) -> None:
        super().__init__(daemon=True)
        self.project, self.environment, self.by = project, environment, by
        self.before = self.kept()
        self.killed = ""

    def ask(self, *command: str) -> str:
        return subprocess.run(command, env=self.environment, capture_output=True, text=True).stdout

    def kept(self) -> int:
        """Packings of the sweep that are finished."""
        return len(list(self.project.glob("results/rectangles/sweep/*/*.json")))

    def run(self) -> None:
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            for line in self.ask("squeue", "--noheader", "-t", "R", "-o", "%i %k").splitlines():
                job, comment = line.split(maxsplit=1)
                if comment.startswith("rule_sweep") and self.kept() > self.before:
                    self.kill(job)
                    self.killed = f"job {job} ({comment}), with {self.kept()} packings kept"
                    return
            time.sleep(0.1)

    def kill(self, job: str) -> None:
        if self.by == "scancel":
            self.ask("scancel", job)
        else:
            for line in self.ask("scontrol", "listpids", job).splitlines()[1:]:
                os.kill(int(line.split()[0]), signal.SIGKILL)


def run_and_kill(
    project: Path, options: list[str], environment: dict[str, str], by: str
) -> tuple[int, str]:
    """Run on the cluster, and kill one job of the sweep."""
    killer = Killer(project, environment, by)
    killer.start()
    code, said = snakemake(project, ON_SLURM + options, environment)
    require(bool(killer.killed), f"a job of the sweep is killed by {by}", said)
    print(f"  killed by {by}: {killer.killed}")
    return code, said


def require(holds: bool, what: str, said: str) -> None:
    """End the trial, with what Snakemake said, where something expected did not happen."""
    if not holds:
        print(said, file=sys.stderr)
        raise SystemExit(f"The trial failed. It was expected that {what}.")


def files(project: Path) -> list[str]:
    """Result files, those of run times excepted."""
    results = project / "results"
    return sorted(
        str(path.relative_to(results))
        for path in results.rglob("*")
        if path.is_file() and path.name not in TIMES
    )


def trial(folder: Path) -> None:
    """Build on this machine and on the cluster, and compare."""
    here = project(folder / "here", chunk_seconds=60)
    there = project(folder / "there", chunk_seconds=2)

    started = time.monotonic()
    code, said = snakemake(here, ["--cores", "all"], dict(os.environ))
    require(code == 0, "the workflow runs on this machine", said)
    print(f"  on this machine: {time.monotonic() - started:.0f} s")

    (folder / "cluster").mkdir()
    with cluster(folder / "cluster") as environment:
        environment["GRAINFRONT_CACHE"] = str(folder / "kernels")  # empty: compiled in a job
        started = time.monotonic()
        code, said = run_and_kill(there, ["--retries", "0"], environment, by="SIGKILL")
        require(code != 0, "without retries, a run that loses a job fails", said)
        require("tiny/statistics.nc" in files(there), "the other scene is finished", said)
        print(f"  first run, ended by the killed job: {time.monotonic() - started:.0f} s")

        started = time.monotonic()
        code, said = run_and_kill(there, [], environment, by="scancel")
        require(code == 0, "the second run finishes what the first left", said)
        require("tiny: packing of seed" not in said, "finished packings are not packed again", said)
        require("Trying to restart job" in said, "the killed job is run again", said)
        compiled = list((folder / "kernels").rglob("*.nbc"))
        require(bool(compiled), "jobs compile the kernels into the folder they are told", said)
        print(f"  second run, resumed, its killed job repeated: {time.monotonic() - started:.0f} s")
        columns = "--format=%.5i %.10T %.4C %.8m %.8M  %k"
        subprocess.run(["squeue", "--states=all", "--sort=i", columns], env=environment)

    names = files(here)
    require(names == files(there), "both have the same result files", f"{names}\n{files(there)}")
    _, different, errors = filecmp.cmpfiles(
        here / "results", there / "results", names, shallow=False
    )
    require(not different + errors, "all files are the same", "\n".join(different + errors))
    print(f"  {len(names)} result files, the same byte for byte")


def main() -> None:
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        raise SystemExit(
            "make test-slurm installs Debian's Slurm and starts its daemons: run it as root, on "
            "Debian or Ubuntu, best in a container or a virtual machine."
        )
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("Stopped."))
    install()
    folder = Path(tempfile.mkdtemp(prefix="grainfront-slurm-"))
    folder.chmod(0o755)  # munged hands out its socket only where others may enter
    print(f"Slurm on one machine, in {folder}:", flush=True)
    try:
        trial(folder)
    except BaseException:
        print(f"Everything, with the logs, is kept in {folder}.", file=sys.stderr)
        raise
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
