"""The files of which the report is made: recordings in numbers, each in a file or several in one."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from markermend.storage.folder_names import readable


def read(paths: Sequence[Path], checksums: Sequence[str | None]) -> tuple[list[dict[str, Any]], list[str]]:
    """Read the summaries of recordings.

    Parameters
    ----------
    paths : sequence of Path
        The files.
    checksums : sequence of str or None
        Their checksums; None for those that are missing or damaged.

    Returns
    -------
    summaries : list of dict
        Of the recordings in the other files.
    unusable : list of str
        What those are about that are missing or damaged, see `place`.
    """
    usable = [path for path, checksum in zip(paths, checksums, strict=True) if checksum is not None]
    contents = [json.loads(path.read_text(encoding="utf-8")) for path in usable]
    summaries = [summary for content in contents for summary in (content if isinstance(content, list) else [content])]
    unusable = [place(path) for path, checksum in zip(paths, checksums, strict=True) if checksum is None]
    return summaries, unusable


def place(path: Path) -> str:
    """Name what a file is about.

    Parameters
    ----------
    path : Path
        The file of a recording or a batch.

    Returns
    -------
    str
        The names that its two folders stand for.
    """
    return readable(*path.absolute().parts[-3:-1])
