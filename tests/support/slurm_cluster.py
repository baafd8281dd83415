"""A SLURM cluster of two nodes on the loopback of one machine, for as long as a test needs it.

Reads: munged, slurmctld, slurmd and their clients, as Debian's slurm-wlm and munge install them.
Writes: keys, states and logs in one temporary folder, which is removed in the end.
"""

from __future__ import annotations

import os
import re
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from datetime import timedelta
from pathlib import Path

import psutil

SLURM = {"munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "scontrol", "sinfo"}
NODES = ("node1", "node2")

# Nodes claim more CPUs and memory than there are. Limits of time hold, those of memory are counted only. A node that does not answer for ten
# seconds is lost. What became of a job can be asked for an hour.
CONFIGURATION = """
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SlurmdParameters=config_overrides
SlurmdTimeout=10
KillWait=1
MinJobAge=3600
NodeName={nodes[0]} NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=12 RealMemory=100000
NodeName={nodes[1]} NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=12 RealMemory=100000
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def why_not() -> str:
    """Why no cluster can be built here; empty where one can."""
    if missing := sorted(name for name in SLURM if _program(name) is None):
        return f"no SLURM here (of Debian, slurm-wlm and munge): {', '.join(missing)}"
    return "" if os.geteuid() == 0 else "the daemons of SLURM need root"


def _program(name: str) -> str | None:
    """Where a program of SLURM is; daemons are where users do not look for programs."""
    return shutil.which(name, path=f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin")


class Cluster:
    """The cluster, up from entry to exit. Clients find it by `environment`."""

    def __enter__(self) -> Cluster:
        # Munge wants a socket that everybody can reach: pytest's own folder is closed to others.
        self.folder = Path(tempfile.mkdtemp(prefix="slurm-"))
        self.folder.chmod(0o755)
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self._daemons: dict[str, subprocess.Popen[bytes]] = {}
        (self.folder / "state").mkdir()
        (self.folder / "munge.key").write_bytes(os.urandom(128))
        (self.folder / "munge.key").chmod(0o600)
        host = socket.gethostname().partition(".")[0]
        text = CONFIGURATION.format(folder=self.folder, host=host, nodes=NODES, ports=_free_ports(1 + len(NODES)))
        (self.folder / "slurm.conf").write_text(text, encoding="utf-8")
        try:
            files = {f"{name}-file": f"munge.{name}" for name in ("key", "pid", "log", "seed")}
            flags = {"socket": "munge.socket", **files}
            self._start("munged", "--foreground", *(f"--{flag}={self.folder / name}" for flag, name in flags.items()))
            self.wait_until((self.folder / "munge.socket").exists)
            self._start("slurmctld", "-D")
            for node in NODES:
                self._start("slurmd", "-D", "-N", node, name=node)
            self.wait_until(lambda: self.call("sinfo", "-hNo", "%T").split() == ["idle"] * len(NODES))
        except BaseException:
            self.__exit__()
            raise
        return self

    def _start(self, program: str, *arguments: str, name: str | None = None) -> None:
        name = name or program
        with open(self.folder / f"{name}.out", "wb") as output:
            command = [_program(program) or program, *arguments]
            self._daemons[name] = subprocess.Popen(command, env=self.environment, stdout=output, stderr=output)

    def call(self, *command: str) -> str:
        """What a client prints; nothing where it fails."""
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, encoding="utf-8").stdout

    def wait_until(self, happened: Callable[[], object], seconds: float = 600) -> None:
        """Wait until something happened."""
        end = time.monotonic() + seconds
        while not happened():
            assert time.monotonic() < end, (
                self.call("squeue"),
                (self.folder / "slurmctld.log").read_text(encoding="utf-8")[-2000:],
            )
            time.sleep(0.2)

    def job_of(self, process: int) -> tuple[str, str]:
        """The job within which a process runs, and its node."""
        environment = psutil.Process(process).environ()
        return environment["SLURM_JOB_ID"], environment["SLURMD_NODENAME"]

    def node_of(self, job: str) -> str:
        """The node on which a job is, or was last."""
        return self.call("squeue", "--noheader", "--states=all", "--format=%N", f"--jobs={job}").strip()

    def limits(self, job: str) -> tuple[float, float]:
        """What a job may take, whatever became of it: minutes and GB."""
        shown = self.call("scontrol", "--oneliner", "show", "job", job)
        days, hours, minutes, seconds = re.search(r" TimeLimit=(?:(\d+)-)?(\d+):(\d+):(\d+)", shown).groups()
        amount, unit = re.search(r" MinMemoryNode=([\d.]+)([MG])", shown).groups()
        span = timedelta(int(days or 0), hours=int(hours), minutes=int(minutes), seconds=int(seconds))
        return span.total_seconds() / 60, float(amount) / {"M": 1000, "G": 1}[unit]

    def lose(self, node: str) -> None:
        """Take a node away at once, and all that runs on it."""
        _kill(self._daemons.pop(node))
        for step in self._steps(node):
            within = step.children(recursive=True)
            # First what would have told the controller how the job ended.
            for process in (step, *within):
                process.kill()

    def _steps(self, node: str) -> Iterator[psutil.Process]:
        """The processes of SLURM that each look after the script of a job on a node."""
        spool = f"{self.folder}/{node}/"
        for process in psutil.process_iter(["cmdline"]):
            if any(word.startswith(spool) for word in process.info["cmdline"] or ()):
                yield from (parent for parent in process.parents()[:1] if parent.pid > 1)

    def __exit__(self, *error: object) -> None:
        for node in NODES:
            if node in self._daemons:
                self.lose(node)
        for daemon in self._daemons.values():
            _kill(daemon)
        shutil.rmtree(self.folder)


def _kill(daemon: subprocess.Popen[bytes]) -> None:
    daemon.kill()
    daemon.wait()


def _free_ports(count: int) -> list[int]:
    """Ports of the loopback that nobody uses."""
    sockets = [socket.socket() for _ in range(count)]
    try:
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]
    finally:
        for each in sockets:
            each.close()
