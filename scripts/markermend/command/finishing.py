"""The command `finish`: the commands of filling, export and quality, one after the other in one process.

Each stage has its own log lines, record, and reasons to be set aside, as if its command had run alone; its record names that command. A
stage whose inputs, options and code are those of the last time keeps its outputs.
"""

from __future__ import annotations

import argparse
import json
import logging
import shlex
import sys
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

STAGES = ("fill", "export", "qc")
"""The stages in their order."""

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
        prog="finish.py",
        description=description,
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    for title, files in {"reads": READS, "writes": WRITES}.items():
        group = made.add_argument_group(title)
        for name, text in files.items():
            nargs = "*" if name in ANY_NUMBER else None
            group.add_argument(f"--{name}", required=True, nargs=nargs, metavar="FILE", help=text)
    stages = "the flags of each stage: a JSON file of lists by the names of the stages"
    made.add_argument("--stages", type=Path, required=True, metavar="FILE", help=stages)
    made.add_argument("--within", required=True, metavar="FOLDER|none", help="see export.py")
    made.add_argument("--decisions", required=True, metavar="JSON", help="see fill.py")
    return made


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
    logging.basicConfig(stream=sys.stderr, level=logging.INFO, format="%(levelname)s %(message)s")
    given = vars(parser(description).parse_args(argv))
    if argv is None:
        logging.getLogger("markermend").info("%s", shlex.join([sys.executable, *sys.argv]))
    flags = json.loads(given["stages"].read_text(encoding="utf-8"))
    own = {"fill": [f"--decisions={given['decisions']}"], "export": [f"--within={given['within']}"]}
    for stage in STAGES:
        module = import_module(stage)
        words = [*_files(module.STAGE, given), *flags[stage], *own.get(stage, [])]
        module.STAGE.run(
            module.work, words, set_aside=getattr(module, "set_aside", None), script=scripts / f"{stage}.py"
        )


def _files(stage: Any, given: Mapping[str, Any]) -> Iterator[str]:
    """The files of a stage, as its flags."""
    for name in (*stage.inputs, *stage.outputs):
        value = given[NAMES.get((stage.name, name), name)]
        yield f"--{name}"
        yield from [value] if isinstance(value, str) else value
