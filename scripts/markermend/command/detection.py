"""The command `detect`: the commands of several detectors, one after the other in one process, which reads each file once.

Each detector has its own log lines, record, and reasons to be set aside, as if its command had run alone; its record names that
command. A detector whose inputs, options and code are those of the last time keeps its events.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

from markermend.command import detector_stage, shared_job
from markermend.command.detector_inputs import DetectorInputs
from markermend.core.artifacts import DETECTORS

READS = {"markers": "trajectories as ingested", "mesh": "functional body mesh of the subject"}
"""The files that it reads, and what they hold."""

WRITES = {"events": "what each of the detectors found, in their order"}
"""The files that it writes, and what they hold."""


def run(scripts: Path, description: str, argv: Sequence[str] | None = None) -> None:
    """Parse the flags, and run the detectors.

    Parameters
    ----------
    scripts : Path
        The folder of the detectors' scripts, from which modules can be imported.
    description : str
        What the command does, reads and writes.
    argv : sequence of str, optional
        The arguments, in place of the command line's.

    Raises
    ------
    SystemExit
        With the status 1 where an output cannot be written; with 2 where flags cannot be used.
    """
    parser = shared_job.make_parser("detect", description, reads=READS, writes=WRITES, many=WRITES)
    call = shared_job.begin(parser, argv)
    files = DetectorInputs()
    for number, stage in enumerate(stage for stage in DETECTORS if stage in call.stages):
        given = ["--markers", call.markers, "--mesh", call.mesh, "--earlier", *call.events[:number]]
        module = import_module(stage)
        detector_stage.run(
            module.STAGE,
            module.work,
            [*given, "--events", call.events[number], *call.stages[stage]],
            script=scripts / f"{stage}.py",
            files=files,
        )
