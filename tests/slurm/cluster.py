"""A Slurm cluster of one node, this machine, with everything of its own in one folder.

No accounting database (slurmdbd), no cgroups: what Debian's packages offer where nothing is set up.
"""

from __future__ import annotations

import contextlib
import os
import platform
import secrets
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

PACKAGES = {"slurm-wlm": "slurmctld", "munge": "munged"}  # and a program of each
PATIENCE_S = 60  # for daemons to start; they take some 2 s

CONFIGURATION = """\
ClusterName=trial
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
# without cgroups, which need an init system that hands them out
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
# processors are what jobs take
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
# ended jobs stay in the answers of squeue for an hour: there is no database to ask
MinJobAge=3600
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} RealMemory={memory_mb} State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def install() -> None:
    """Install Debian's packages of Slurm where they are missing; needs root and Debian."""
    missing = [package for package, program in PACKAGES.items() if not shutil.which(program)]
    if missing:
        quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
        subprocess.run(["apt-get", "update", "-qq"], check=True, env=quiet)
        command = ["apt-get", "install", "-qq", "--yes", "--no-install-recommends", *missing]
        subprocess.run(command, check=True, env=quiet, stdout=subprocess.DEVNULL)


def free_ports(count: int) -> list[int]:
    """Ports that nobody listens at."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]


def write_configuration(folder: Path) -> Path:
    """The files that the daemons expect, and the key that they share."""
    for name in ("munge", "state", "spool", "log"):
        (folder / name).mkdir()
    key = folder / "munge/key"
    key.touch(mode=0o600)
    key.write_bytes(secrets.token_bytes(128))
    controller_port, node_port = free_ports(2)
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    configuration = folder / "slurm.conf"
    configuration.write_text(
        CONFIGURATION.format(
            host=platform.node().split(".")[0],
            controller_port=controller_port,
            node_port=node_port,
            folder=folder,
            processors=os.cpu_count(),
            memory_mb=memory * 9 // 10 // 2**20,
        )
    )
    return configuration


def srun_of_this_cluster(folder: Path, configuration: Path) -> Path:
    """A folder with an srun that knows the configuration.

    The executor plugin starts each job's srun without any variable named SLURM_…, SLURM_CONF too.
    """
    (folder / "bin").mkdir()
    srun = folder / "bin/srun"
    srun.write_text(f'#!/bin/sh\nSLURM_CONF={configuration} exec {shutil.which("srun")} "$@"\n')
    srun.chmod(0o755)
    return srun.parent


def wait_until(ready: list[str], environment: dict[str, str], wanted: str, log: Path) -> None:
    """Ask until the answer is the wanted one."""
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        answer = subprocess.run(ready, env=environment, capture_output=True, text=True)
        if answer.returncode == 0 and wanted in answer.stdout:
            return
        time.sleep(0.5)
    raise SystemExit(f"{ready[0]} did not answer {wanted!r} in {PATIENCE_S} s; see {log}.")


def cancel_jobs(environment: dict[str, str]) -> None:
    """Cancel all jobs and wait for their end, without which their guards would stay behind."""
    subprocess.run(["scancel", "--user=root"], env=environment, capture_output=True, timeout=30)
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        queue = subprocess.run(
            ["squeue", "--noheader"], env=environment, capture_output=True, text=True, timeout=30
        )
        if not queue.stdout.strip():
            return
        time.sleep(0.5)


@contextlib.contextmanager
def cluster(folder: Path) -> Iterator[dict[str, str]]:
    """Run munged, slurmctld and slurmd; the environment in which Slurm's commands find them.

    Jobs and daemons are stopped at the end, whatever happens; where this process itself is killed,
    the daemons are.
    """
    configuration = write_configuration(folder)
    path = f"{srun_of_this_cluster(folder, configuration)}:{os.environ['PATH']}"
    environment = {**os.environ, "SLURM_CONF": str(configuration), "PATH": path}
    munge, log = folder / "munge", folder / "log"
    munged = [
        "munged", "--foreground", f"--socket={munge}/socket", f"--key-file={munge}/key",
        f"--log-file={log}/munged.log", f"--pid-file={munge}/pid", f"--seed-file={munge}/seed",
    ]  # fmt: skip
    slurm = [["slurmctld", "-D"], ["slurmd", "-D"]]
    running: list[subprocess.Popen[bytes]] = []

    def start(command: list[str]) -> None:
        with open(log / f"{command[0]}.out", "wb") as out:
            tied = ["setpriv", "--pdeathsig", "TERM", *command]
            running.append(
                subprocess.Popen(tied, env=environment, stdout=out, stderr=subprocess.STDOUT)
            )

    try:
        start(munged)
        wait_until(["munge", f"--socket={munge}/socket", "-n"], environment, "MUNGE", log)
        for command in slurm:
            start(command)
        wait_until(["sinfo", "--noheader", "--format=%T"], environment, "idle", log)
        yield environment
    finally:
        if len(running) == 3:
            cancel_jobs(environment)
        for daemon in reversed(running):  # each while those that it talks to are there
            daemon.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                daemon.wait(timeout=15)
            daemon.kill()
            daemon.wait()
