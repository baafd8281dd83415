"""What runs within a job of a cluster, called as SLURM's plug-in calls it, without a cluster."""

from support.workflow_runs import Project, write_recording

WITHIN = (
    "--mode",
    "remote",
    "--executor",
    "slurm-jobstep",
    "--jobs",
    "1",
    "--no-hooks",
    "--force",
    "--until",
    "ingest",
)

MEETING = """
import os, sys, time
if len(sys.orig_argv) > 1 and os.path.basename(sys.orig_argv[1]) == "ingest.py":
    os.mkdir(os.path.join({folder!r}, str(os.getpid())))
    for _ in range(600):
        if len(os.listdir({folder!r})) >= 3:
            break
        time.sleep(0.1)
    else:
        sys.exit("the others did not come")
"""
"""Each recording waits until three were begun."""


def test_recordings_run_side_by_side_on_the_cores_of_the_job_and_not_as_steps_of_it(tmp_path):
    project = Project(tmp_path)
    for number in range(3):
        write_recording(project.recordings / f"S{number}/walk.c3d", seed=number)
    (tmp_path / "met").mkdir()
    (tmp_path / "sitecustomize.py").write_text(MEETING.format(folder=str(tmp_path / "met")))
    project.run(*WITHIN, "--cores", "3", environment={"PYTHONPATH": str(tmp_path)})
    assert len(list(project.results.glob("*/walk/01_markers.parquet"))) == len(list((tmp_path / "met").iterdir())) == 3
