"""The command of a stage: its flags, made from its class of options, and its files."""

from __future__ import annotations

import argparse
import logging
import shlex
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

from markermend.command import inputs
from markermend.command.stage_run import Checksums, StageRun
from markermend.core.recording import SetAside
from markermend.options.description import Option, full_meaning, peel
from markermend.options.flags import flag, stage_options
from markermend.options.reader import BadOptions, parse
from markermend.options.reporting import NoOptions
from markermend.storage.atomic import NotWritten

log = logging.getLogger("markermend")


class Stage:
    """One stage as a command: every flag is required, none may be abbreviated.

    `@FILE` stands for the arguments in a file, one a line: a command line has room for about a thousand paths. Each
    field of the classes of options is a flag; lists, mappings and options with options of their own are JSON.

    The work function gets one argument, a namespace with a path (or list of paths) per file, `options` (an instance of
    the class of options), the fields of `given` by their names, and `facts` (what to store in the outputs: stage,
    options, sha256 of the inputs, by their flag).

    Parameters
    ----------
    name : str
        Name of the stage.
    description : str
        What it does, reads and writes.
    options : type
        The class of its options.
    given : type, optional
        A class with what the stage is given in addition to its section of the config.
    sets_aside : bool, optional
        Whether the stage sets aside what it fails on; otherwise a failure ends it with an error.
    """

    def __init__(
        self,
        name: str,
        description: str,
        options: type = NoOptions,
        given: type = NoOptions,
        *,
        sets_aside: bool = True,
    ) -> None:
        self.name = name
        self._sets_aside = sets_aside
        self.parser = argparse.ArgumentParser(
            prog=f"{name}.py",
            description=description,
            allow_abbrev=False,
            fromfile_prefix_chars="@",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        self._reads = self.parser.add_argument_group("reads")
        self._writes = self.parser.add_argument_group("writes")
        group = self.parser.add_argument_group("options (defaults: config/config.yaml)")
        self.inputs: list[str] = []
        self.outputs: list[str] = []
        self._original = False
        self._lenient: set[str] = set()
        self._classes = {cls: stage_options(cls) for cls in (options, given)}
        for option in (option for options in self._classes.values() for option in options):
            group.add_argument(
                flag(option.name),
                type=partial(_parse, option),
                required=True,
                metavar=_metavar(option),
                help=full_meaning(option).replace("%", "%%"),
            )

    def reads(self, name: str, help: str, *, many: bool = False, optional: bool = False, lenient: bool = False) -> None:
        """Declare an input file, or several.

        Parameters
        ----------
        name : str
            Its name, as a flag and in what the work function gets.
        help : str
            What it holds.
        many : bool, optional
            Whether there are several: one or more.
        optional : bool, optional
            Whether there may be none of the several.
        lenient : bool, optional
            Whether a file that is missing or damaged has no checksum among the facts, instead of ending the stage.
        """
        self.inputs.append(name)
        self._lenient |= {name} if lenient else set()
        nargs = ("*" if optional else "+") if many else None
        self._reads.add_argument(flag(name), type=Path, required=True, nargs=nargs, metavar="FILE", help=help)

    def reads_original(self, help: str) -> None:
        """Declare the original file of a recording as the input `source`, beside the folder that its links may not lead out of.

        What cannot be read or is to be left alone has no checksum; the work function checks it (source_file.check).

        Parameters
        ----------
        help : str
            What it holds.
        """
        self.reads("source", help)
        self._reads.add_argument(
            "--within",
            type=_folder_or_none,
            required=True,
            metavar="FOLDER|none",
            help="the folder that links to the original may not lead out of; none where they may",
        )
        self._original = True

    def writes(self, name: str, help: str, *, many: bool = False) -> None:
        """Declare an output file, or any number of them.

        Parameters
        ----------
        name : str
            Its name, as a flag and in what the work function gets.
        help : str
            What it holds.
        many : bool, optional
            Whether there are any number.
        """
        self.outputs.append(name)
        nargs = "*" if many else None
        self._writes.add_argument(flag(name), type=Path, required=True, nargs=nargs, metavar="FILE", help=help)

    def keeps_outputs(self) -> None:
        """Declare that the outputs are kept where they were made from the same inputs, with the same options and code."""
        text = "hash of the code: where it, the inputs and the options are those of the last time, the outputs are kept"
        self.parser.add_argument("--code", required=True, metavar="TEXT", help=text)

    def run(
        self,
        work: Callable[[Any], str | None],
        argv: Sequence[str] | None = None,
        *,
        set_aside: Callable[[Any, SetAside], None] | None = None,
        script: Path | None = None,
        checksums: Checksums = inputs.checksums,
    ) -> None:
        """Parse the flags, work, log one line of result.

        Parameters
        ----------
        work : callable
            What the stage does; it returns the line of result.
        argv : sequence of str, optional
            The arguments, in place of the command line's.
        set_aside : callable, optional
            How to write the outputs of a recording that was set aside, where a note in their place will not do.
        script : Path, optional
            The script of the stage, where `argv` are arguments for it: log and records then name it, whatever command this process is.
        checksums : callable, optional
            Computes the checksums of inputs (inputs.checksums).

        Raises
        ------
        SystemExit
            With the status 1 where an output cannot be written, and where the stage fails and sets nothing aside.
        """
        logging.basicConfig(stream=sys.stderr, level=logging.INFO, format="%(levelname)s %(message)s")
        arguments = vars(self.parser.parse_args(argv))
        words = sys.argv if argv is None else [str(script) if script else sys.argv[0], *argv]
        command = [sys.executable, *words]
        log.info("%s", shlex.join(command))
        run = StageRun(
            self.name,
            self.inputs,
            self.outputs,
            arguments,
            [cls(**{option.name: arguments[option.name] for option in own}) for cls, own in self._classes.items()],
            command=command if argv is None or script else (),
            lenient=self._lenient,
            original=self._original,
            sets_aside=self._sets_aside,
            checksums=checksums,
        )
        try:
            run.run(work, set_aside=set_aside)
        except NotWritten as error:
            log.error("%s: %s", self.name, error)
            raise SystemExit(1) from error


def _parse(option: Option, words: str) -> Any:
    """Read an option; a value that cannot be used is an error of the command line."""
    try:
        return parse(option, words)
    except BadOptions as problem:
        raise argparse.ArgumentTypeError(str(problem)) from problem


def _folder_or_none(words: str) -> Path | None:
    """A folder, or that there is none."""
    return None if words == "none" else Path(words)


def _metavar(option: Option) -> str:
    """What stands for a value in the help."""
    kinds = {int: "INT", float: "FLOAT", bool: "true|false", str: "TEXT"}
    kind, *others = get_args(option.kind) if type(None) in get_args(option.kind) else (option.kind,)
    kind, _ = peel(kind)
    if get_origin(kind) is Literal:
        return "|".join(get_args(kind))
    return kinds.get(kind, "JSON") + ("|none" if others else "")
