"""One run of a stage's command: its log, its facts, and what happens when a recording cannot be worked on.

A stage that fails on a recording sets that recording aside: each of its outputs is written as a note with the reason,
later stages pass the note on, the report lists it, and the run goes on. A BadRecording stays bad until the file, the
code or an option changes. Any other failure may pass (a disk that went away, memory that ran out), so it is counted in
failures.tsv, and the next run tries the stage again. A stage that cannot write its outputs, and one that is about no recording,
ends with an error: nobody may take what is missing for done.
"""

from __future__ import annotations

import logging
import time
import traceback
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from markermend.command import inputs as input_checksums
from markermend.command.failures import describe
from markermend.command.kept_outputs import are_current, dependencies_hash
from markermend.core.recording import BadRecording, SetAside
from markermend.options.flags import passed
from markermend.storage import output_checksums, stage_files
from markermend.storage.atomic import NotWritten
from markermend.storage.failure_counts import count_failure
from markermend.storage.folder_names import printable

log = logging.getLogger("markermend")

Checksums = Callable[..., str | list[str]]
"""Computes the checksums of inputs, as inputs.checksums does."""


@dataclass(frozen=True)
class StageRun:
    """A stage, and what it is run on.

    Parameters
    ----------
    stage : str
        Its name.
    inputs, outputs : sequence of str
        Names of its files.
    arguments : mapping of str to Any
        The values of its flags: a path or paths for each file.
    options : sequence
        Its options, and what it is given beside them: instances of classes of options.
    command : sequence of str, optional
        The command line, for the record of the outputs; empty where they cannot be made anew by it.
    lenient : collection of str, optional
        The inputs of which those that are missing or damaged have no checksum.
    original : bool, optional
        Whether the input `source` is an original.
    sets_aside : bool, optional
        Whether what it fails on is set aside; otherwise a failure ends it with an error.
    checksums : callable, optional
        Computes the checksums of inputs.
    """

    stage: str
    inputs: Sequence[str]
    outputs: Sequence[str]
    arguments: Mapping[str, Any]
    options: Sequence[Any]
    command: Sequence[str] = ()
    lenient: Collection[str] = ()
    original: bool = False
    sets_aside: bool = True
    checksums: Checksums = input_checksums.checksums

    def run(
        self, work: Callable[[Any], str | None], *, set_aside: Callable[[Any, SetAside], None] | None = None
    ) -> None:
        """Work, record the outputs, log one line of result.

        Parameters
        ----------
        work : callable
            What the stage does; it returns the line of result.
        set_aside : callable, optional
            How to write the outputs of a recording that was set aside, where a note in their place will not do.

        Raises
        ------
        NotWritten
            Where an output cannot be written.
        SystemExit
            With the status 1 where the stage fails and sets nothing aside.
        """
        started = time.perf_counter()
        call = self._call()
        result, failure = self._attempt(work, call)
        if failure is not None:
            if not self.sets_aside:
                log.error("%s", failure.reason)
                raise SystemExit(1)
            if set_aside is not None:
                set_aside(call, failure)
            else:
                for name in self.outputs:
                    stage_files.set_aside(getattr(call, name), failure.stage, failure.reason)
        output_checksums.write(
            self.stage, self._written(), folder=self._folder, command=self.command, dependencies=call.dependencies
        )
        log.info("%s: %s (%.2f s)", self.stage, result or "done", time.perf_counter() - started)

    def _call(self) -> Any:
        """What the work function gets, but for the facts, and what the outputs depend on, which is known after the work."""
        own, *given = self.options
        files = {name: self.arguments[name] for name in (*self.inputs, *self.outputs)}
        call = SimpleNamespace(**files, options=own, dependencies=None)
        for each in given:
            vars(call).update(vars(each))
        vars(call).update({"within": self.arguments["within"]} if self.original else {})
        return call

    @property
    def _folder(self) -> Path:
        """The folder that the outputs belong to: that of the first."""
        first: Path = self.arguments[self.outputs[0]]
        return first.parent

    def _attempt(self, work: Callable[[Any], str | None], call: Any) -> tuple[str | None, SetAside | None]:
        """The line of result, and why the recording is set aside; None where it is not."""
        try:
            call.facts = self._facts()
            return self._work_or_keep(work, call), None
        except SetAside as note:
            return f"set aside by {note.stage}: {note.reason}", note
        except BadRecording as bad:
            return f"set aside: {bad}", SetAside(self.stage, printable(str(bad)))
        except NotWritten:
            raise
        except Exception as error:
            log.error("%s", traceback.format_exc())
            failure = SetAside(self.stage, f"{self.stage} failed: {printable(self._without_folders(describe(error)))}")
            if self.sets_aside:
                count_failure(self._folder, self.stage, failure.reason)
            return f"set aside: {failure.reason}", failure

    def _work_or_keep(self, work: Callable[[Any], str | None], call: Any) -> str | None:
        """Work, unless the outputs are kept and those that the work would give."""
        code = self.arguments.get("code")
        dependencies = None if code is None else dependencies_hash({**call.facts, "code": code})
        if dependencies and are_current(self.stage, self._written(), self._folder, dependencies):
            result: str | None = "the outputs are kept: inputs, options and code are those that they were made from"
        else:
            # A record of earlier outputs says nothing of what is written now, should this process be killed.
            output_checksums.remove(self._folder, self.stage)
            result = work(call)
        call.dependencies = dependencies
        return result

    def _written(self) -> list[Path]:
        """The outputs that there are."""
        named = [self.arguments[name] for name in self.outputs]
        paths = [path for given in named for path in ([given] if isinstance(given, Path) else given)]
        return [path for path in paths if path.is_file()]

    def _facts(self) -> dict[str, Any]:
        """What the outputs store: the stage, its options, and the checksums of its inputs."""
        return {
            "stage": self.stage,
            "options": {name: own for each in self.options for name, own in passed(each).items()},
            "inputs": {name: self._checksum(name) for name in self.inputs},
        }

    def _checksum(self, name: str) -> Any:
        """The checksums of an input."""
        given = self.arguments[name]
        if self.original and name == "source":
            return input_checksums.original_checksum(given, within=self.arguments["within"])
        if name in self.lenient:
            return input_checksums.checksums_or_none(given, own=self._folder)
        return self.checksums(given, own=self._folder)

    def _without_folders(self, text: str) -> str:
        """A message with the stage's files by their names alone: results hold no absolute path."""
        for name in (*self.inputs, *self.outputs):
            paths = [self.arguments[name]] if isinstance(self.arguments[name], Path) else self.arguments[name]
            for path in sorted(paths, key=lambda path: -len(str(path))):
                text = text.replace(str(path), path.name)
        return text
