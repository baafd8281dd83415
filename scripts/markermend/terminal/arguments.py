"""The arguments of the commands of `markermend`, and what its help says of them."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Collection, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any, NoReturn

import markermend

EPILOG = """\
Flags after -- go to Snakemake: markermend clean FOLDER -- --dry-run
On a cluster: markermend clean FOLDER -- --profile profiles/slurm
"""

Work = Callable[[argparse.Namespace, list[str]], int]
"""What a command does, given its arguments and those for Snakemake; the exit status."""


class Parser(argparse.ArgumentParser):
    """A parser that says in one sentence what is wrong with a command line, and which word was probably meant."""

    def error(self, message: str) -> NoReturn:
        """Say what is wrong; see `argparse.ArgumentParser`."""
        self.exit(2, f"{message} (see {self.prog} --help)\n")

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse a command line; see `argparse.ArgumentParser`."""
        found, unknown = self.parse_known_args(args, namespace)
        if unknown:
            command = self._commands()[found.command]
            known = [flag for action in command._actions for flag in action.option_strings]
            command.error(f"{unknown[0]!r} means nothing here{suggestion(unknown[0], known)}")
        return found

    def _commands(self) -> Mapping[str, Any]:
        """The parsers of the commands."""
        actions = [action for action in self._actions if isinstance(action, argparse._SubParsersAction)]
        return actions[0].choices


def suggestion(word: str, known: Collection[str]) -> str:
    """Ask whether a similar word was meant.

    Parameters
    ----------
    word : str
        The word that means nothing.
    known : collection of str
        The words that mean something.

    Returns
    -------
    str
        The end of a sentence; empty where no word is similar.
    """
    close = get_close_matches(word, list(known), n=1)
    return f"; did you mean {close[0]}?" if close else ""


def make_parser(work: Mapping[str, Work], presets: Collection[str]) -> Parser:
    """Make the parser of the commands.

    Parameters
    ----------
    work : mapping of str to callable
        What each command does.
    presets : collection of str
        Names of the presets.

    Returns
    -------
    Parser
        The parser; what it gives has the name of the command as `command`, and its function as `work`.
    """
    made = Parser(
        prog="markermend",
        description="Clean whole data sets of optical motion capture, and report what was done to every sample.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    made.add_argument("--version", action="version", version=f"markermend {markermend.__version__}")
    commands = made.add_subparsers(title="commands", required=True, metavar="COMMAND", dest="command")

    def add(name: str, meaning: str) -> argparse.ArgumentParser:
        description = f"{meaning[0].upper()}{meaning[1:]}."
        command = commands.add_parser(
            name,
            help=meaning,
            description=description,
            epilog=EPILOG if name in ("clean", "look", "papers") else None,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        command.set_defaults(work=work[name])
        return command

    clean = add("clean", "clean the recordings of a folder, or of a table of recordings")
    _about_recordings(clean)
    clean.add_argument("--preset", choices=presets, help="options for a purpose: see markermend presets")
    _about_recordings(add("look", "find and report what a folder has, and alter nothing"))
    _about_report(add("report", "print what became of the recordings, and where the report is"))
    verify = add("verify", "check every result and original against its checksum")
    _about_results(verify)
    verify.add_argument("--remake", action="store_true", help="let the next run make anew what differs")
    _about_undoing(add("undo", "get originals back from cleaned files, or parts of them"))
    _about_table(add("table", "write a table of the recordings of a folder, for you to correct and clean"))
    _about_crate(add("crate", "describe results as an RO-Crate, to publish them with"))
    add("presets", "list the presets")
    _about_papers(add("papers", "repeat the experiments of the papers"))
    return made


def _about_recordings(command: argparse.ArgumentParser) -> None:
    """Add the arguments of a command that looks at recordings."""
    command.add_argument("recordings", metavar="FOLDER", help="a folder of recordings, or a table of them")
    command.add_argument("--decisions", metavar="TABLE", help="what you decided: see the pages of the report")
    _about_run(command)


def _about_run(command: argparse.ArgumentParser) -> None:
    """Add the arguments of a command that runs the workflow."""
    command.add_argument(
        "--results", type=Path, default=Path("results"), help="the folder for the results (default: results)"
    )
    _about_options(command)
    command.add_argument(
        "--cores",
        type=_cores,
        metavar="N|all",
        help="number of cores (default: all; on a cluster what its profile says)",
    )


def _cores(words: str) -> str:
    """Read a number of cores."""
    if words != "all" and not (words.isdecimal() and int(words)):
        raise argparse.ArgumentTypeError(f"{words!r} is neither a number of cores nor all")
    return words


def _about_options(command: argparse.ArgumentParser) -> None:
    """Add the files of options."""
    command.add_argument(
        "--options", nargs="+", default=[], metavar="FILE", help="files with options: see config/config.yaml"
    )


def _about_results(command: argparse.ArgumentParser) -> None:
    """Add the folder of results."""
    command.add_argument("results", type=Path, metavar="RESULTS", help="the folder of results")


def _about_report(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command that prints the summary."""
    _about_results(command)
    command.add_argument("--open", action="store_true", help="open the report in the browser")


class _Frames(argparse.Action):
    """The first and last frame of a stretch."""

    def __call__(self, parser: Any, namespace: argparse.Namespace, values: Any, option_string: Any = None) -> None:
        """Keep the frames in their order; see `argparse.Action`."""
        first, last = values
        if last < first:
            raise argparse.ArgumentError(self, f"the last frame, {last}, comes before the first, {first}")
        setattr(namespace, self.dest, (first, last))


def _about_undoing(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command that takes changes back."""
    command.add_argument(
        "results", type=Path, metavar="RESULTS", help="the folder of results, or that of one recording"
    )
    command.add_argument(
        "recordings",
        nargs="*",
        metavar="RECORDING",
        help="recordings as SUBJECT/RECORDING or RECORDING, with * and ? (default: all)",
    )
    command.add_argument("--to", type=Path, required=True, metavar="FOLDER", help="the folder that the files go to")
    command.add_argument(
        "--markers",
        nargs="+",
        default=[],
        metavar="NAME",
        help="take back what was done to these markers only, with * and ?",
    )
    command.add_argument(
        "--frames",
        nargs=2,
        type=int,
        action=_Frames,
        metavar=("FIRST", "LAST"),
        help="take back only findings and gaps with any of these frames, numbered as in changes.tsv",
    )


def _about_table(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command that writes a table of recordings."""
    command.add_argument("recordings", metavar="FOLDER", help="a folder of recordings")
    command.add_argument(
        "--to", type=Path, default=Path("recordings.tsv"), metavar="TABLE", help="the table (default: recordings.tsv)"
    )
    _about_options(command)


def _about_crate(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command that describes results."""
    _about_results(command)
    command.add_argument("--name", required=True, metavar="TITLE", help="the title of the data set")
    command.add_argument(
        "--license",
        metavar="ADDRESS",
        help="the address of its license, such as https://creativecommons.org/licenses/by/4.0/",
    )
    command.add_argument(
        "--authors", nargs="+", default=[], metavar="NAME", help="their names, the one who ran the cleaning first"
    )


def _about_papers(command: argparse.ArgumentParser) -> None:
    """Add the arguments of the command that repeats experiments."""
    command.add_argument(
        "recordings", nargs="?", metavar="FOLDER", help="your recordings; by default those of a synthetic person"
    )
    command.add_argument(
        "--size", choices=("quick", "hours", "full"), default="quick", help="how many runs (default: quick)"
    )
    _about_run(command)
