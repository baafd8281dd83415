"""The command `finish`: the commands of filling, export and quality, one after the other in one process.

Each stage has its own log lines, record, and reasons to be set aside, as if its command had run alone; its record names that command. A
stage whose inputs, options and code are those of the last time keeps its outputs.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

from markermend.command import shared_job
from markermend.core.remarks import without_remarks
from markermend.options.general import FINISHING
from markermend.options.values import text

NAMES = {("export", "record"): "changes", ("export", "changes"): "table"}
"""What the command calls files of a stage that are called otherwise there."""

READS = {
    "source": "the original file",
    "markers": "trajectories as ingested",
    "mesh": "functional body mesh of the subject",
    "events": "findings of the detectors, in their order",
    "repaired": "trajectories after repair",
    "repairs": "what repair did",
    "poses": "poses of the subject, if there are any",
}
"""The files that it reads, and what they hold."""

WRITES = {
    "filled": "trajectories after filling",
    "changes": "what repair and filling did to each stretch, or why nothing was done",
    "cleaned": "the cleaned recording, in the format of the original",
    "trc": "the cleaned recording as TRC besides",
    "table": "table of changes, in the capture program's frame numbers",
    "originals": "the original value of every changed sample, with its bytes",
    "certificate": "what changed and that nothing else did, as JSON",
    "qc": "the recording in numbers, as JSON",
    "page": "the recording for a person, as HTML",
}
"""The files that it writes, and what they hold."""

ANY_NUMBER = ("events", "poses", "trc")
"""Those of which there may be none or several."""


def run(scripts: Path, description: str, argv: Sequence[str] | None = None) -> None:
    """Parse the flags, and run the stages.

    Parameters
    ----------
    scripts : Path
        The folder of their scripts, from which modules can be imported.
    description : str
        What the command does, reads and writes.
    argv : sequence of str, optional
        The arguments, in place of the command line's.

    Raises
    ------
    SystemExit
        With the status 1 where an output cannot be written; with 2 where flags cannot be used.
    """
    parser = shared_job.make_parser("finish", description, reads=READS, writes=WRITES, many=ANY_NUMBER)
    parser.add_argument("--within", required=True, metavar="FOLDER|none", help="see export.py")
    parser.add_argument("--decisions", required=True, metavar="JSON", help="see export.py")
    given = vars(shared_job.begin(parser, argv))
    decided = [f"--decisions={given['decisions']}"]
    own = {
        "fill": [f"--decisions={text(without_remarks(json.loads(given['decisions'])))}"],
        "export": [f"--within={given['within']}", *decided],
        "qc": decided,
    }
    for stage in FINISHING:
        module = import_module(stage)
        words = [*_files(module.STAGE, given), *given["stages"][stage], *own.get(stage, [])]
        module.STAGE.run(
            module.work, words, set_aside=getattr(module, "set_aside", None), script=scripts / f"{stage}.py"
        )


def _files(stage: Any, given: Mapping[str, Any]) -> Iterator[str]:
    """The files of a stage, as its flags."""
    for name in (*stage.inputs, *stage.outputs):
        value = given[NAMES.get((stage.name, name), name)]
        yield f"--{name}"
        yield from [value] if isinstance(value, str) else value
