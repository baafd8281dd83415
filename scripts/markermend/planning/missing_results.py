"""Cleaned files that were written and are gone: Snakemake makes no file anew on which nothing that must be made depends."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from markermend.planning.discovery import Folders
from markermend.planning.recordings import Entry
from markermend.planning.result_files import ResultFiles
from markermend.storage.failure_counts import count_failure

STAGE = "export"
"""The stage that writes cleaned files."""


def find_missing(files: ResultFiles, entries: Mapping[Folders, Entry]) -> list[Folders]:
    """Find the recordings whose cleaned file is gone.

    Parameters
    ----------
    files : ResultFiles
        Names of the result files.
    entries : mapping of Folders to Entry
        The recordings, by the names of their folders.

    Returns
    -------
    list of Folders
        Those that have a certificate, which is written last, and no cleaned file.
    """
    missing = []
    for (subject, recording), entry in entries.items():
        folder = files.recording.format(subject=subject, recording=recording)
        written = os.path.exists(files.certificate.format(subject=subject, recording=recording))
        if written and not os.path.exists(f"{folder}/cleaned.{entry.format}"):
            missing.append((subject, recording))
    return missing


def count_missing(files: ResultFiles, missing: Iterable[Folders]) -> None:
    """Count a failure of export for each recording whose cleaned file is gone, so that it is written anew.

    Parameters
    ----------
    files : ResultFiles
        Names of the result files.
    missing : iterable of Folders
        What `find_missing` found.

    Raises
    ------
    NotWritten
        Where a failure cannot be counted.
    """
    for subject, recording in missing:
        folder = Path(files.recording.format(subject=subject, recording=recording))
        count_failure(folder, STAGE, "the cleaned file is gone")
