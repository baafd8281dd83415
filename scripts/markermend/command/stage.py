"""What every stage's command shares: its flags, its log, its facts, and what happens when a recording cannot be worked on.

A stage that fails on a recording sets that recording aside: each of its outputs is written as a note with the reason,
later stages pass the note on, the report lists it, and the run goes on. A BadRecording stays bad until the file, the
code or an option changes. Any other failure may pass (a disk that went away, memory that ran out), so it is counted in
failures.tsv, and the next run tries the stage again.
"""

from __future__ import annotations

import argparse
import json
import logging
import shlex
import sys
import time
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from markermend.core.recording import BadRecording, SetAside
from markermend.storage import atomic, stage_files
from markermend.storage.folder_names import printable

log = logging.getLogger("markermend")


def boolean(text: str) -> bool:
    """Parse `true` or `false`."""
    return {"true": True, "false": False}[text.lower()]


def optional(parse: Callable[[str], Any]) -> Callable[[str], Any]:
    """Make a parser that also takes `none`."""

    def parse_or_none(text: str) -> Any:
        return None if text == "none" else parse(text)

    parse_or_none.__name__ = f"{parse.__name__} or none"
    return parse_or_none


def listing(parse: Callable[[str], Any]) -> Callable[[str], list[Any]]:
    """Make a parser of a JSON list, each of whose values `parse` reads."""

    def parse_list(text: str) -> list[Any]:
        values = json.loads(text)
        if not isinstance(values, list):
            raise ValueError(f"not a JSON list: {text}")
        return [parse(str(value)) for value in values]

    parse_list.__name__ = "json-list"
    return parse_list


def mapping(text: str) -> dict[str, Any]:
    """Parse a JSON object."""
    value = json.loads(text)
    if not isinstance(value, dict):
        raise ValueError(f"not a JSON object: {text}")
    return value


def objects(text: str) -> list[dict[str, Any]]:
    """Parse a JSON list of objects."""
    values = json.loads(text)
    if not isinstance(values, list) or not all(isinstance(value, dict) for value in values):
        raise ValueError(f"not a JSON list of objects: {text}")
    return values


class Stage:
    """One stage as a command: every flag is required, none may be abbreviated.

    `@FILE` stands for the arguments in a file, one a line: a command line has room for about a thousand paths.

    The work function gets one argument, a namespace with a path (or list of paths) per file, `options` (a dictionary),
    and `facts` (what to store in the outputs: stage, options, sha256 of the inputs, by their flag).
    """

    def __init__(self, name: str, description: str) -> None:
        self.name = name
        self.parser = argparse.ArgumentParser(
            prog=f"{name}.py",
            description=description,
            allow_abbrev=False,
            fromfile_prefix_chars="@",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        self._reads = self.parser.add_argument_group("reads")
        self._writes = self.parser.add_argument_group("writes")
        self._options = self.parser.add_argument_group("options (defaults: config/config.yaml)")
        self.inputs: list[str] = []
        self.outputs: list[str] = []
        self.options: list[str] = []

    def reads(self, name: str, help: str, *, many: bool = False, optional: bool = False) -> None:
        """Declare an input file, or several (`many`: one or more; with `optional`, none at all)."""
        self.inputs.append(name)
        nargs = ("*" if optional else "+") if many else None
        self._reads.add_argument(flag(name), type=Path, required=True, nargs=nargs, metavar="FILE", help=help)

    def writes(self, name: str, help: str, *, many: bool = False) -> None:
        """Declare an output file, or any number of them."""
        self.outputs.append(name)
        nargs = "*" if many else None
        self._writes.add_argument(flag(name), type=Path, required=True, nargs=nargs, metavar="FILE", help=help)

    def option(self, name: str, parse: Callable[[str], Any], help: str, *, many: bool = False, **more: Any) -> None:
        """Declare an option, or a list of them as JSON; its value reaches the work function as `options[name]`."""
        self.options.append(name)
        parse = listing(parse) if many else parse
        if "choices" not in more:
            more["metavar"] = parse.__name__.upper().replace(" OR NONE", "|none")
        self._options.add_argument(flag(name), type=parse, required=True, help=help.replace("%", "%%"), **more)

    def run(
        self,
        work: Callable[[Any], str | None],
        argv: Sequence[str] | None = None,
        *,
        set_aside: Callable[[Any, SetAside], None] | None = None,
    ) -> None:
        """Parse the flags, work, log one line of result (what `work` returns).

        set_aside: how to write the outputs of a recording that was set aside, where a note in their place will not do.
        """
        logging.basicConfig(stream=sys.stderr, level=logging.INFO, format="%(levelname)s %(message)s")
        arguments = vars(self.parser.parse_args(argv))
        log.info("%s", shlex.join([sys.executable, *([sys.argv[0], *argv] if argv is not None else sys.argv)]))
        call = SimpleNamespace(**{name: arguments[name] for name in self.inputs + self.outputs})
        call.options = {name: arguments[name] for name in self.options}
        started = time.perf_counter()
        failure: SetAside | None = None
        try:
            call.facts = {
                "stage": self.name,
                "options": call.options,
                "inputs": {name: hashes(arguments[name]) for name in self.inputs},
            }
            result = work(call)
        except SetAside as note:
            failure, result = note, f"set aside by {note.stage}: {note.reason}"
        except BadRecording as bad:
            failure, result = SetAside(self.name, printable(str(bad))), f"set aside: {bad}"
        except Exception as error:
            log.error("%s", traceback.format_exc())
            text = printable(self._without_folders(str(error), arguments))
            reason = f"{self.name} failed: {type(error).__name__}: {text}"
            failure, result = SetAside(self.name, reason), f"set aside: {reason}"
            self._count_failure(call, failure)
        if failure is not None:
            if set_aside is not None:
                set_aside(call, failure)
            else:
                for name in self.outputs:
                    stage_files.set_aside(getattr(call, name), failure.stage, failure.reason)
        log.info("%s: %s (%.2f s)", self.name, result or "done", time.perf_counter() - started)

    def _without_folders(self, text: str, arguments: dict[str, Any]) -> str:
        """A message with the stage's files by their names alone: results hold no absolute path."""
        for name in self.inputs + self.outputs:
            paths = [arguments[name]] if isinstance(arguments[name], Path) else arguments[name]
            for path in sorted(paths, key=lambda path: -len(str(path))):
                text = text.replace(str(path), path.name)
        return text

    def _count_failure(self, call: Any, failure: SetAside) -> None:
        """Append the failure to failures.tsv beside the first output; the workflow reads how many there were."""
        first = getattr(call, self.outputs[0])
        first.parent.mkdir(parents=True, exist_ok=True)
        with open(first.parent / "failures.tsv", "a", encoding="utf-8") as file:
            file.write(f"{self.name}\t{' '.join(failure.reason.split())}\n")


def flag(name: str) -> str:
    """The command-line flag of a name."""
    return "--" + name.replace("_", "-")


def hashes(paths: Path | Sequence[Path]) -> str | list[str]:
    """The sha256 of one file, or of each of several. Raises BadRecording where one is not there."""
    try:
        return atomic.sha256(paths) if isinstance(paths, Path) else [atomic.sha256(path) for path in paths]
    except FileNotFoundError as error:
        raise BadRecording(
            f"{Path(error.filename).name} is not there: is it a broken link, or was it moved?"
        ) from error
