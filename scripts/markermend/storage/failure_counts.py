"""The failures that may pass, counted beside the results: one more, and the next run tries the stage again."""

from __future__ import annotations

from pathlib import Path

from markermend.storage.atomic import NotWritten, not_written


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
