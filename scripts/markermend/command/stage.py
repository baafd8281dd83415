"""What every stage's command shares: its flags, its log, its facts, and what happens when a recording cannot be worked on.

A stage that fails on a recording sets that recording aside: each of its outputs is written as a note with the reason,
later stages pass the note on, the report lists it, and the run goes on. A BadRecording stays bad until the file, the
code or an option changes. Any other failure may pass (a disk that went away, memory that ran out), so it is counted in
failures.tsv, and the next run tries the stage again. A stage that cannot write its outputs, and one that is about no recording,
ends with an error: nobody may take what is missing for done.
"""

from __future__ import annotations

import argparse
import logging
import shlex
import sys
import time
import traceback
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal, get_args, get_origin

from markermend.command import inputs
from markermend.command.failures import describe
from markermend.command.kept_outputs import are_current, dependencies_hash
from markermend.core.recording import BadRecording, SetAside
from markermend.options.description import Option, full_meaning, peel
from markermend.options.flags import flag, passed, stage_options
from markermend.options.reader import BadOptions, parse
from markermend.options.reporting import NoOptions
from markermend.storage import output_checksums, stage_files
from markermend.storage.atomic import NotWritten
from markermend.storage.failure_counts import count_failure
from markermend.storage.folder_names import printable

log = logging.getLogger("markermend")

Checksums = Callable[..., str | list[str]]
"""Computes the checksums of inputs, as inputs.checksums does."""


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
        try:
            self._run(work, argv, set_aside, script, checksums)
        except NotWritten as error:
            log.error("%s: %s", self.name, error)
            raise SystemExit(1) from error

    def _run(
        self,
        work: Callable[[Any], str | None],
        argv: Sequence[str] | None,
        set_aside: Callable[[Any, SetAside], None] | None,
        script: Path | None,
        checksums: Checksums,
    ) -> None:
        """As `run`; NotWritten where an output cannot be written."""
        arguments = vars(self.parser.parse_args(argv))
        words = sys.argv if argv is None else [str(script) if script else sys.argv[0], *argv]
        command = [sys.executable, *words]
        log.info("%s", shlex.join(command))
        made = [
            cls(**{option.name: arguments[option.name] for option in options}) for cls, options in self._classes.items()
        ]
        call = SimpleNamespace(
            **{name: arguments[name] for name in self.inputs + self.outputs}, options=made[0], dependencies=None
        )
        vars(call).update(vars(made[-1]) if len(made) > 1 else {})
        vars(call).update({"within": arguments["within"]} if self._original else {})
        started = time.perf_counter()

        def prepare_and_work() -> str | None:
            call.facts = self._facts(arguments, made, checksums)
            return self._work_or_keep(work, call, arguments.get("code"))

        result, failure = self._attempt(prepare_and_work, call, arguments)
        if failure is not None:
            if not self._sets_aside:
                log.error("%s", failure.reason)
                raise SystemExit(1)
            if set_aside is not None:
                set_aside(call, failure)
            else:
                for name in self.outputs:
                    stage_files.set_aside(getattr(call, name), failure.stage, failure.reason)
        known = command if argv is None or script else []
        output_checksums.write(self.name, self._written(call), command=known, dependencies=call.dependencies)
        log.info("%s: %s (%.2f s)", self.name, result or "done", time.perf_counter() - started)

    def _work_or_keep(self, work: Callable[[Any], str | None], call: Any, code: str | None) -> str | None:
        """Work, unless the outputs are kept and those that the work would give."""
        dependencies = None if code is None else dependencies_hash({**call.facts, "code": code})
        if dependencies and are_current(self.name, self._written(call), dependencies):
            result: str | None = "the outputs are kept: inputs, options and code are those that they were made from"
        else:
            # A record of earlier outputs says nothing of what is written now, should this process be killed.
            output_checksums.remove(getattr(call, self.outputs[0]).parent, self.name)
            result = work(call)
        call.dependencies = dependencies
        return result

    def _written(self, call: Any) -> list[Path]:
        """The outputs that there are."""
        named = [getattr(call, name) for name in self.outputs]
        paths = [path for given in named for path in ([given] if isinstance(given, Path) else given)]
        return [path for path in paths if path.is_file()]

    def _facts(self, arguments: dict[str, Any], options: Sequence[Any], checksums: Checksums) -> dict[str, Any]:
        """What the outputs store: the stage, its options, and the checksums of its inputs."""
        return {
            "stage": self.name,
            "options": {name: own for each in options for name, own in passed(each).items()},
            "inputs": {name: self._checksum(name, arguments, checksums) for name in self.inputs},
        }

    def _checksum(self, name: str, arguments: dict[str, Any], checksums: Checksums) -> Any:
        """The checksums of an input."""
        own = arguments[self.outputs[0]].parent
        if self._original and name == "source":
            return inputs.original_checksum(arguments[name], within=arguments["within"])
        if name in self._lenient:
            return inputs.checksums_or_none(arguments[name], own=own)
        return checksums(arguments[name], own=own)

    def _attempt(
        self, work: Callable[[], str | None], call: Any, arguments: dict[str, Any]
    ) -> tuple[str | None, SetAside | None]:
        """The line of result, and why the recording is set aside; None where it is not."""
        try:
            return work(), None
        except SetAside as note:
            return f"set aside by {note.stage}: {note.reason}", note
        except BadRecording as bad:
            return f"set aside: {bad}", SetAside(self.name, printable(str(bad)))
        except NotWritten:
            raise
        except Exception as error:
            log.error("%s", traceback.format_exc())
            text = printable(self._without_folders(describe(error), arguments))
            failure = SetAside(self.name, f"{self.name} failed: {text}")
            if self._sets_aside:
                count_failure(getattr(call, self.outputs[0]).parent, self.name, failure.reason)
            return f"set aside: {failure.reason}", failure

    def _without_folders(self, text: str, arguments: dict[str, Any]) -> str:
        """A message with the stage's files by their names alone: results hold no absolute path."""
        for name in self.inputs + self.outputs:
            paths = [arguments[name]] if isinstance(arguments[name], Path) else arguments[name]
            for path in sorted(paths, key=lambda path: -len(str(path))):
                text = text.replace(str(path), path.name)
        return text


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
