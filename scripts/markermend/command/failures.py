"""The failures that may pass: what a person reads of one, and their count beside the results, by which the next run tries again."""

from __future__ import annotations

import os
from pathlib import Path

from markermend.core.recording import SourceChanged
from markermend.storage.atomic import NotWritten, not_written


def describe(error: Exception) -> str:
    """Say in one line what went wrong and, where that is known, what to do.

    Parameters
    ----------
    error : Exception
        What a stage failed with.

    Returns
    -------
    str
        The line.
    """
    text = " ".join(str(error).split())
    if isinstance(error, SourceChanged):
        return text
    if isinstance(error, MemoryError):
        wanted = f" ({text})" if text else ""
        return f"not enough memory{wanted}: run fewer recordings at once (--cores), or on a machine with more"
    if isinstance(error, PermissionError) and error.filename:
        return f"{os.fsdecode(error.filename)} cannot be read: permission denied. Allow reading it, and run again"
    return f"{type(error).__name__}: {text}"


def count_failure(folder: Path, stage: str, reason: str) -> None:
    """Append a failure to failures.tsv; the workflow reads how many there are.

    Parameters
    ----------
    folder : Path
        The folder of the stage's outputs.
    stage : str
        Its name.
    reason : str
        Why it failed.

    Raises
    ------
    NotWritten
        Where it cannot be counted.
    """
    path = folder / "failures.tsv"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with open(path, "a", encoding="utf-8") as file:
            file.write(f"{stage}\t{' '.join(reason.split())}\n")
    except OSError as error:
        raise NotWritten(not_written(path, error)) from error
