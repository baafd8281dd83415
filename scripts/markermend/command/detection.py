"""The command `detect`: the commands of several detectors, one after the other in one process, which reads each file once.

Each detector has its own log lines, record, and reasons to be set aside, as if its command had run alone; its record names that
command. A detector whose inputs, options and code are those of the last time keeps its events.
"""

from __future__ import annotations

import argparse
import json
import logging
import shlex
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

from markermend.command import detector_stage
from markermend.command.detector_inputs import DetectorInputs
from markermend.core.artifacts import DETECTORS

log = logging.getLogger("markermend")


def parser(description: str) -> argparse.ArgumentParser:
    """Make the parser of the command's flags.

    Parameters
    ----------
    description : str
        What the command does, reads and writes.

    Returns
    -------
    ArgumentParser
        A parser whose flags are all required.
    """
    made = argparse.ArgumentParser(
        prog="detect.py",
        description=description,
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    reads, writes = made.add_argument_group("reads"), made.add_argument_group("writes")
    for name, text in {
        "markers": "trajectories as ingested",
        "mesh": "functional body mesh of the subject",
        "detectors": "the flags of each detector that runs: a JSON file of lists by the names of the detectors",
    }.items():
        reads.add_argument(f"--{name}", type=Path, required=True, metavar="FILE", help=text)
    writes.add_argument(
        "--events", type=Path, required=True, nargs="+", metavar="FILE", help="what each of them found, in their order"
    )
    return made


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
    logging.basicConfig(stream=sys.stderr, level=logging.INFO, format="%(levelname)s %(message)s")
    call = parser(description).parse_args(argv)
    if argv is None:
        log.info("%s", shlex.join([sys.executable, *sys.argv]))
    flags = json.loads(call.detectors.read_text(encoding="utf-8"))
    files, events = DetectorInputs(), list(map(str, call.events))
    for number, stage in enumerate(stage for stage in DETECTORS if stage in flags):
        given = ["--markers", str(call.markers), "--mesh", str(call.mesh), "--earlier", *events[:number]]
        module = import_module(stage)
        detector_stage.run(
            module.STAGE,
            module.work,
            [*given, "--events", events[number], *flags[stage]],
            script=scripts / f"{stage}.py",
            files=files,
        )
