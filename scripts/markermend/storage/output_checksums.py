"""The records `logs/STAGE.json`: what each stage wrote into a folder or for it, by checksums, and by which command."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from markermend.storage.atomic import sha256, write_json

FOLDER = "logs"
"""The folder of the records, beside the files."""


@dataclass(frozen=True)
class OutputRecord:
    """What a stage wrote into one folder, and elsewhere for it.

    Attributes
    ----------
    stage : str
        Its name.
    outputs : mapping of str to str
        The sha256 of each file, by its path from the folder: its name where it is there.
    command : tuple of str
        The command line that wrote them; empty where it is not known.
    dependencies : str or None
        Checksum of all that they depend on; None where it is not recorded.
    """

    stage: str
    outputs: Mapping[str, str]
    command: tuple[str, ...] = ()
    dependencies: str | None = None


def write(
    stage: str,
    outputs: Sequence[Path],
    *,
    folder: Path | None = None,
    command: Sequence[str] = (),
    dependencies: str | None = None,
) -> None:
    """Record what a stage wrote.

    Parameters
    ----------
    stage : str
        Its name.
    outputs : sequence of Path
        The files; where there are none, nothing is recorded.
    folder : Path, optional
        The folder that they belong to; that of the first where it is not given.
    command : sequence of str, optional
        The command line that wrote them.
    dependencies : str, optional
        Checksum of all that they depend on.
    """
    if not outputs:
        return
    folder = folder or outputs[0].parent
    content = {"outputs": of(outputs, folder), "command": list(command), "dependencies": dependencies}
    write_json(folder / FOLDER / f"{stage}.json", content)


def remove(folder: Path, stage: str) -> None:
    """Remove the record of what a stage wrote, before it writes anew.

    Parameters
    ----------
    folder : Path
        The folder of its outputs.
    stage : str
        Name of the stage.
    """
    (folder / FOLDER / f"{stage}.json").unlink(missing_ok=True)


def of(outputs: Sequence[Path], folder: Path) -> dict[str, str]:
    """Compute the checksums of files.

    Parameters
    ----------
    outputs : sequence of Path
        The files.
    folder : Path
        The folder that they belong to.

    Returns
    -------
    dict of str to str
        The sha256 of each, by its path from the folder.
    """
    return {Path(os.path.relpath(path, folder)).as_posix(): sha256(path) for path in outputs}


def read(folder: Path, stage: str) -> OutputRecord | None:
    """Read what a stage wrote into a folder.

    Parameters
    ----------
    folder : Path
        The folder of its outputs.
    stage : str
        Name of the stage.

    Returns
    -------
    OutputRecord or None
        None where there is no record that can be read.
    """
    try:
        content: Any = json.loads((folder / FOLDER / f"{stage}.json").read_text(encoding="utf-8"))
        return OutputRecord(stage, dict(content["outputs"]), tuple(content["command"]), content["dependencies"])
    except (OSError, ValueError, TypeError, KeyError):
        return None


def records(folder: Path) -> Iterator[OutputRecord]:
    """Read what all stages wrote into a folder.

    Parameters
    ----------
    folder : Path
        The folder of their outputs.

    Yields
    ------
    OutputRecord
        A record that can be read, in the order of the stages' names.
    """
    for path in sorted((folder / FOLDER).glob("*.json")):
        if record := read(folder, path.stem):
            yield record


def unreadable(folder: Path) -> list[str]:
    """Find the stages whose record cannot be read, as after a loss of power.

    Parameters
    ----------
    folder : Path
        The folder of their outputs.

    Returns
    -------
    list of str
        Names of the files that are no JSON, without their suffix.
    """
    names = []
    for path in sorted((folder / FOLDER).glob("*.json")):
        try:
            json.loads(path.read_text(encoding="utf-8"))
        except (OSError, ValueError):
            names.append(path.stem)
    return names


def find(path: Path) -> OutputRecord | None:
    """Find the record of a file.

    Parameters
    ----------
    path : Path
        The file, which may be missing.

    Returns
    -------
    OutputRecord or None
        What the stage that wrote it wrote into its folder; None where that is not recorded.
    """
    return next((record for record in records(path.parent) if path.name in record.outputs), None)
