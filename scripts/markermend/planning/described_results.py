"""The results that are described to be published: those of the recordings of the last run, each file as it was written.

Reads: report/provenance.json, the lists of the last run, of each recording certificate.json, and the recorded checksums.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from markermend.planning.result_files import CERTIFICATE, ResultFiles
from markermend.storage import last_run, output_checksums
from markermend.storage.atomic import sha256
from markermend.storage.folder_names import CLEANED, readable


class NotDescribed(Exception):
    """Results that cannot be described: of no finished run, or not as they were written; the message says why and what to do."""


@dataclass(frozen=True)
class DescribedResults:
    """The results of the last run.

    Attributes
    ----------
    results : Path
        The folder of results, an absolute path.
    facts : mapping of str to Any
        The facts of the run, see `run_facts.run_facts`.
    certificates : mapping of Path to mapping
        The certificate of each recording, by its folder.
    """

    results: Path
    facts: Mapping[str, Any]
    certificates: Mapping[Path, Mapping[str, Any]]
    _recorded: dict[Path, str] = field(repr=False)

    def cleaned(self, folder: Path) -> Path:
        """Name the cleaned file of a recording.

        Parameters
        ----------
        folder : Path
            The folder of the recording.

        Returns
        -------
        Path
            The file.
        """
        return _beside(folder, self.certificates[folder]["cleaned"])

    def besides(self, folder: Path) -> list[Path]:
        """Name the other files among the cleaned ones that were written for a recording, such as its copy as TRC.

        Parameters
        ----------
        folder : Path
            The folder of the recording.

        Returns
        -------
        list of Path
            The files.
        """
        record = output_checksums.read(folder, "export")
        paths = [_beside(folder, name) for name in record.outputs] if record else []
        return [path for path in paths if path.parent != folder and path != self.cleaned(folder)]

    def checksum(self, path: Path) -> str:
        """Give the checksum of a file, which must be as it was written.

        Parameters
        ----------
        path : Path
            The file.

        Returns
        -------
        str
            Its sha256.

        Raises
        ------
        NotDescribed
            Where it is not as it was written, or not there.
        """
        return _checksum(path, self._recorded.get(path), self.results)

    @cached_property
    def left_over(self) -> list[str]:
        """What is of no recording of the last run, by paths from the folder of results: folders, and cleaned files."""
        former = last_run.former_recordings(self.results)
        current = {folder.parent for folder in self.certificates}
        places = [folder if folder.parent in current else folder.parent for folder in former]
        last = last_run.read(self.results)
        batches = last_run.folders(self.results / "report" / last_run.BATCHES)
        places += [folder for folder in batches if last and folder.name not in last.batches]
        own = {path for folder in self.certificates for path in (self.cleaned(folder), *self.besides(folder))}
        cleaned = (self.results / CLEANED).rglob("*")
        places += sorted(
            path for path in cleaned if path.is_file() and path not in own and not path.name.startswith(".")
        )
        return [path.relative_to(self.results).as_posix() for path in dict.fromkeys(places)]


def read(results: Path) -> DescribedResults:
    """Read what the last run left.

    Parameters
    ----------
    results : Path
        The folder of results.

    Returns
    -------
    DescribedResults
        Its results.

    Raises
    ------
    NotDescribed
        Where the folder holds no results of a finished run, or a certificate is not as it was written.
    """
    results, last = Path(os.path.abspath(results)), last_run.read(results)
    try:
        facts: dict[str, Any] = json.loads(Path(ResultFiles(str(results)).provenance).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        last = None
    if last is None:
        raise NotDescribed(f"{results} holds no results of a finished run: name the folder of results of a run")
    if last.unfinished:
        more = f" and {len(last.unfinished) - 1} more" if len(last.unfinished) > 1 else ""
        raise NotDescribed(
            f"The last run did not finish {readable(*last.unfinished[0].split('/'))}{more}: run the cleaning again"
        )
    folders = [results / name for name in sorted(last.finished)]
    recorded: dict[Path, str] = {}
    for folder in (results / "report", *folders):
        for record in output_checksums.records(folder):
            recorded |= {_beside(folder, name): checksum for name, checksum in record.outputs.items()}
    certificates = {folder: _certificate(folder / CERTIFICATE, recorded, results) for folder in folders}
    recorded |= {_beside(folder, own["cleaned"]): own["cleaned_sha256"] for folder, own in certificates.items()}
    return DescribedResults(results, facts, certificates, recorded)


def _certificate(path: Path, recorded: Mapping[Path, str], results: Path) -> dict[str, Any]:
    """The certificate of a recording, which must be as it was written."""
    _checksum(path, recorded.get(path), results)
    try:
        stated: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        if not {"source", "original_sha256", "cleaned", "cleaned_sha256", "changed_samples"} <= stated.keys():
            raise ValueError
    except (ValueError, AttributeError) as error:
        raise _damaged(path, results) from error
    return stated


def _checksum(path: Path, expected: str | None, results: Path) -> str:
    """The checksum of a file, which is not looked at further where none was recorded."""
    try:
        found = sha256(path)
    except OSError as error:
        raise NotDescribed(f"{path} cannot be read ({error.strerror}): run the cleaning again") from error
    if expected not in (None, found):
        raise _damaged(path, results)
    return found


def _damaged(path: Path, results: Path) -> NotDescribed:
    """The refusal of a file that is not as it was written."""
    return NotDescribed(
        f"{path} is not as it was written: check the results with markermend verify {results} --remake, and run the cleaning again"
    )


def _beside(folder: Path, name: str) -> Path:
    """The path of a file by that from a folder."""
    return Path(os.path.normpath(folder / name))
