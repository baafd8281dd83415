"""The recordings that the last run was about, by the lists that it left, and the folders of others that are still among the results.

Reads: report/logs/recordings.txt, which names a file of each recording or of each batch, and then the list of each batch; unfinished.txt.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from markermend.storage.folder_names import RESERVED_SUBJECTS
from markermend.storage.output_checksums import FOLDER as LOGS

FINISHED = "recordings.txt"
"""Name of the list of files that a report is made of."""

UNFINISHED = "unfinished.txt"
"""Name of the list of such files of recordings that the last run did not finish; there is none where it finished all."""

BATCH_QUALITY = "qc.json"
"""Name of the file of a batch in such a list."""

BATCHES = "batches"
"""Name of the folder of the batches in that of the report."""


@dataclass(frozen=True)
class LastRun:
    """The recordings of the last run, each as `SUBJECT/RECORDING` by the names of its folders.

    Attributes
    ----------
    finished : tuple of str
        Those of which it has results.
    unfinished : tuple of str
        The others.
    batches : tuple of str
        Names of the batches of its report.
    """

    finished: tuple[str, ...]
    unfinished: tuple[str, ...] = ()
    batches: tuple[str, ...] = ()


def read(results: Path) -> LastRun | None:
    """Read which recordings the last run was about.

    Parameters
    ----------
    results : Path
        The folder of results.

    Returns
    -------
    LastRun or None
        None where its lists cannot be read.
    """
    report = results / "report"
    try:
        listed = _listed(report / LOGS / FINISHED)
        batches = tuple(path.parent.name for path in listed if path.name == BATCH_QUALITY)
        for name in batches:
            listed += _listed(report / BATCHES / name / LOGS / FINISHED)
        unfinished = _listed(report / LOGS / UNFINISHED) if (report / LOGS / UNFINISHED).exists() else []
    except (OSError, ValueError):
        return None
    finished = [path for path in listed if path.name != BATCH_QUALITY]
    return LastRun(tuple(map(_recording, finished)), tuple(map(_recording, unfinished)), batches)


def subject_folders(results: Path) -> list[Path]:
    """Find the folders of subjects among results.

    Parameters
    ----------
    results : Path
        The folder of results.

    Returns
    -------
    list of Path
        The folder of each subject, of the last run or of one before, in order.
    """
    return [path for path in folders(results) if path.name not in RESERVED_SUBJECTS]


def recording_folders(results: Path) -> list[Path]:
    """Find the folders of recordings among results.

    Parameters
    ----------
    results : Path
        The folder of results.

    Returns
    -------
    list of Path
        The folder of each recording, of the last run or of one before, in order.
    """
    return [path for subject in subject_folders(results) for path in folders(subject) if path.name != LOGS]


def former_recordings(results: Path) -> list[Path]:
    """Find the folders of recordings that are no longer among those of the data set.

    Parameters
    ----------
    results : Path
        The folder of results.

    Returns
    -------
    list of Path
        The folders in order; none where it is not known which recordings the last run was about.
    """
    last = read(results)
    if last is None:
        return []
    current = {*last.finished, *last.unfinished}
    return [path for path in recording_folders(results) if _name(path) not in current]


def folders(path: Path) -> list[Path]:
    """Find the folders in a folder.

    Parameters
    ----------
    path : Path
        The folder.

    Returns
    -------
    list of Path
        Those that are not hidden, in order; none where it is not there.
    """
    inner = path.iterdir() if path.is_dir() else ()
    return sorted(folder for folder in inner if folder.is_dir() and not folder.name.startswith("."))


def _listed(path: Path) -> list[Path]:
    """The files that a list names."""
    return [Path(line) for line in path.read_text(encoding="utf-8").split("\n") if line]


def _recording(path: Path) -> str:
    """The recording of a file."""
    return _name(path.parent)


def _name(folder: Path) -> str:
    """The recording of a folder."""
    return f"{folder.parent.name}/{folder.name}"
