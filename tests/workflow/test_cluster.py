"""Twelve recordings on a cluster: those of a job side by side, with the bytes of one machine, whatever becomes of a job."""

import csv
import shutil
import subprocess
from pathlib import Path

import pytest

from support.slurm_cluster import Cluster, why_not
from support.workflow_runs import Project, write_recording

pytestmark = [pytest.mark.cluster, pytest.mark.skipif(bool(why_not()), reason=why_not())]

PEAKS = ("--configfile", "peaks.yaml")
# By itself the plug-in looks after its jobs every 40 s at most.
PROFILE = ("--profile", "profiles/slurm", "--slurm-init-seconds-before-status-checks", "2", *PEAKS)

HANGING = """
import os, sys, time
script = os.path.basename(sys.orig_argv[1]) if len(sys.orig_argv) > 1 else ""
if script in ("mesh.py", "repair.py", "finish.py"):
    with open(os.path.join({folder!r}, script + ".jobs"), "a") as file:
        file.write(os.environ["SLURM_JOB_ID"] + "\\n")
    try:
        with open(os.path.join({folder!r}, script), "x") as file:
            file.write(str(os.getpid()))
        time.sleep(600)
    except FileExistsError:
        pass
"""
"""Of three stages, the process that comes first gets no further, until its job ends."""


@pytest.fixture
def cluster():
    with Cluster() as cluster:
        yield cluster


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """Twelve recordings of two subjects, and their results on one machine."""
    project = Project(tmp_path_factory.mktemp("cluster"))
    (project.folder / "peaks.yaml").write_text("detect: [peaks]")
    for number in range(12):
        write_recording(project.recordings / f"S{number % 2}/r{number:02}.c3d", seed=number, body=number % 2)
    project.run(*PEAKS)
    return project


def most_at_once(results: Path) -> int:
    """The largest number of recordings that were worked on at one time, by the stages' own records."""
    stretches = []
    for path in results.glob("*/*/logs/*.tsv"):
        (row,) = csv.DictReader(path.read_text().splitlines(), delimiter="\t")
        stop = path.stat().st_mtime
        stretches.append((stop - float(row["s"]), stop, path.parent))
    at_once = (
        {recording for start, stop, recording in stretches if start <= moment < stop} for moment, _, _ in stretches
    )
    return max(map(len, at_once))


def test_the_recordings_of_a_job_run_side_by_side_with_the_bytes_of_one_machine(project, cluster, tmp_path):
    project.run(*PROFILE, environment=cluster.environment, results=tmp_path / "out")
    assert project.outputs(tmp_path / "out") == project.outputs()
    # Ten recordings were in one job, two in another.
    assert most_at_once(tmp_path / "out") > 2


def test_a_job_that_was_cancelled_or_out_of_time_or_on_a_node_that_was_lost_is_done_again(project, cluster, tmp_path):
    (tmp_path / "sitecustomize.py").write_text(HANGING.format(folder=str(tmp_path)))
    shutil.copytree(project.recordings / "S0", tmp_path / "recordings/S0")
    command = project.command(*PROFILE, recordings=tmp_path / "recordings", results=tmp_path / "out")
    environment = {**cluster.environment, "PYTHONPATH": str(tmp_path)}

    def hanging(script):
        path = tmp_path / script
        cluster.wait_until(lambda: path.exists() and path.read_text())
        return cluster.job_of(int(path.read_text()))

    def jobs(script):
        return list(dict.fromkeys((tmp_path / f"{script}.jobs").read_text().split()))

    with (
        open(tmp_path / "log", "w", encoding="utf-8") as log,
        subprocess.Popen(command, cwd=project.folder, env=environment, stdout=log, stderr=log) as running,
    ):
        try:
            cancelled, _ = hanging("mesh.py")
            cluster.call("scancel", cancelled)
            slow, _ = hanging("repair.py")
            first = cluster.limits(slow)
            # Of six recordings side by side: half an hour to detect, as much to repair, and 4 GB each.
            assert first == (60, 24)
            cluster.call("scontrol", "update", f"JobId={slow}", "TimeLimit=1")
            lost, node = hanging("finish.py")
            cluster.lose(node)
            assert running.wait(timeout=900) == 0, (tmp_path / "log").read_text()
        finally:
            running.kill()
    subject = {
        path: content for path, content in project.outputs().items() if path.removeprefix("cleaned/").startswith("S0/")
    }
    assert subject.items() <= project.outputs(tmp_path / "out").items()
    assert cancelled in jobs("mesh.py")[:-1]
    assert cluster.limits(jobs("repair.py")[-1]) == tuple(2 * limit for limit in first)
    assert jobs("finish.py").count(lost) == 1 and cluster.node_of(lost) not in ("", node)
