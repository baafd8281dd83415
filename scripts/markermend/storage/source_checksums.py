"""The checksums of the original files: their content decides what is made again, whatever their dates and names.

An original is read only where path, size, inode or either time differ from those of the last time, or a stage that reads it has failed since.
"""

from __future__ import annotations

import json
import os
import stat
import time
from collections.abc import Mapping
from pathlib import Path
from typing import NotRequired, TypedDict

from markermend.storage.atomic import sha256, write_text

SETTLED_NS = 2_000_000_000
"""Age from which a file gets another time when it is written to: file systems count in up to two seconds."""

ABSENT = "not there"
"""Stands for the checksum of a file that is not there or cannot be read, that is no file or is too large."""

LARGEST = 16 * 2**30
"""Bytes of an original: it is held in memory as a whole, and a sparse file may claim any size."""


class SourceRecord(TypedDict):
    """What is recorded of an original: its path, its checksum, and what the file of this checksum is recognised by, if it is.

    Attributes
    ----------
    path : str
        Absolute path.
    sha256 : str
        Checksum of its bytes, or `not there`.
    file : list of int, optional
        Size, inode, time of the last change of the content and of anything, in ns.
    failures : int, optional
        How often the stages that read it had failed.
    """

    path: str
    sha256: str
    file: NotRequired[list[int]]
    failures: NotRequired[int]


class SourceChecksums:
    """The checksums of the original files of recordings, recorded from one run to the next.

    Parameters
    ----------
    path : Path
        The file that records them.
    failures : mapping of str to int, optional
        How often the stages that read the original of a recording have failed so far. What they read may not be what was recorded:
        some file systems keep no time of the last change, and the record may be damaged.
    """

    def __init__(self, path: Path, failures: Mapping[str, int] | None = None) -> None:
        self._path, self._failures = path, failures or {}
        self._recorded: dict[str, SourceRecord] | None = None
        self._current: dict[str, SourceRecord] = {}

    @property
    def recorded(self) -> dict[str, SourceRecord]:
        """What was recorded before, by recording; nothing where there is no file that can be read, or it is damaged there."""
        if self._recorded is None:
            try:
                found = dict(json.loads(self._path.read_text(encoding="utf-8")))
                self._recorded = {name: record for name, record in found.items() if _is_record(record)}
            except (OSError, ValueError, TypeError):
                self._recorded = {}
        return self._recorded

    def of(self, recording: str, source: str) -> str:
        """Give the checksum of an original, the same throughout a run.

        Parameters
        ----------
        recording : str
            The folders of the recording, `SUBJECT/RECORDING`.
        source : str
            Absolute path of its original.

        Returns
        -------
        str
            The sha256 of its bytes; `not there` where there is no file that can be read.
        """
        if recording not in self._current:
            self._current[recording] = self._look(recording, source)
        return self._current[recording]["sha256"]

    def save(self) -> None:
        """Record the checksums given so far, where any is new. Where nothing can be written, files are read again next time."""
        if self._current.items() <= self.recorded.items():
            return
        try:
            write_text(self._path, json.dumps({**self.recorded, **self._current}, indent=0, sort_keys=True) + "\n")
        except OSError:
            return

    def _look(self, recording: str, source: str) -> SourceRecord:
        """The record of a file as it is: as recorded, or read."""
        recorded, failures = self.recorded.get(recording), self._failures.get(recording, 0)
        try:
            before = _recognise(source)
            known = recorded and (recorded["path"], recorded.get("file"), recorded.get("failures", 0))
            if recorded and known == (source, before, failures):
                return recorded
            checksum, now = sha256(Path(source)), time.time_ns()
            # Else it may be written to once more without getting another time.
            if before == _recognise(source) and now - max(before[2:]) > SETTLED_NS:
                found: SourceRecord = {"path": source, "sha256": checksum, "file": before}
                return {**found, "failures": failures} if failures else found
            return {"path": source, "sha256": checksum}
        except OSError:
            return {"path": source, "sha256": ABSENT}


def _is_record(found: object) -> bool:
    """Whether something is a record of an original."""
    return isinstance(found, dict) and all(isinstance(found.get(key), str) for key in ("path", "sha256"))


def _recognise(source: str) -> list[int]:
    """What a file is recognised by: size, inode, time of the last change of the content and of anything, in ns."""
    found = os.stat(source)
    if not stat.S_ISREG(found.st_mode) or found.st_size > LARGEST:
        raise OSError(f"{source} is no file, or too large")
    return [found.st_size, found.st_ino, found.st_mtime_ns, found.st_ctime_ns]
