"""Snakemake's records of what each result was made from, below `.snakemake` in the folder of results.

Snakemake takes a job for done, whatever has changed, if the record of a result is damaged, or it stops with an error.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from markermend.storage.atomic import write_json

FOLDER = ".snakemake/metadata"
"""Their folder in that of results: a file for each result."""


def unreadable(results: Path) -> list[Path]:
    """Find the records that cannot be read.

    Parameters
    ----------
    results : Path
        The folder of results.

    Returns
    -------
    list of Path
        The files that are not JSON objects.
    """
    return [path for path in _files(results) if _read(path) is None]


def renew(results: Path) -> None:
    """Put into the place of records that cannot be read some that state other parameters: the next run repeats these jobs.

    Parameters
    ----------
    results : Path
        The folder of results.
    """
    # Of the same version of Snakemake, which passes over records of other versions.
    intact = next((record for path in _files(results) if (record := _read(path))), None)
    for path in unreadable(results):
        if intact is None:
            path.unlink()
        else:
            write_json(path, {**intact, "params": ["the record could not be read"]})


def _files(results: Path) -> list[Path]:
    """The files of all records."""
    return sorted(path for path in (results / FOLDER).rglob("*") if path.is_file())


def _read(path: Path) -> dict[str, Any] | None:
    """A record; None where it cannot be read."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return record if isinstance(record, dict) else None
