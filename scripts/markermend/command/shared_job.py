"""What commands share that run several stages in one process: their flags, and those of the stages, which a file holds."""

from __future__ import annotations

import argparse
import json
import logging
import shlex
import sys
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

log = logging.getLogger("markermend")


def make_parser(
    name: str, description: str, *, reads: Mapping[str, str], writes: Mapping[str, str], many: Collection[str]
) -> argparse.ArgumentParser:
    """Make the parser of a command's flags.

    Parameters
    ----------
    name : str
        Name of the command.
    description : str
        What it does, reads and writes.
    reads, writes : mapping of str to str
        The files, and what they hold.
    many : collection of str
        Those of which there may be none or several.

    Returns
    -------
    ArgumentParser
        A parser whose flags are all required. Paths are text; `stages` has the flags of each stage, by its name.
    """
    made = argparse.ArgumentParser(
        prog=f"{name}.py",
        description=description,
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    for title, files in {"reads": reads, "writes": writes}.items():
        group = made.add_argument_group(title)
        for file, text in files.items():
            nargs = "*" if file in many else None
            group.add_argument(f"--{file}", required=True, nargs=nargs, metavar="FILE", help=text)
    help = "the flags of each stage that runs: a JSON file of lists by the names of the stages"
    made.add_argument("--stages", type=_read_flags, required=True, metavar="FILE", help=help)
    return made


def begin(parser: argparse.ArgumentParser, argv: Sequence[str] | None) -> argparse.Namespace:
    """Parse the flags of a command, and log its command line.

    Parameters
    ----------
    parser : ArgumentParser
        What `make_parser` gives.
    argv : sequence of str or None
        The arguments, in place of the command line's.

    Returns
    -------
    Namespace
        The values of the flags.

    Raises
    ------
    SystemExit
        With the status 2 where flags cannot be used.
    """
    logging.basicConfig(stream=sys.stderr, level=logging.INFO, format="%(levelname)s %(message)s")
    found = parser.parse_args(argv)
    if argv is None:
        log.info("%s", shlex.join([sys.executable, *sys.argv]))
    return found


def _read_flags(path: str) -> dict[str, list[str]]:
    """Read the flags of the stages."""
    try:
        found: dict[str, list[str]] = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as problem:
        raise argparse.ArgumentTypeError(f"{path} cannot be read: {problem}") from problem
    return found
