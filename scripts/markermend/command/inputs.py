"""The inputs of a stage: their checksums, and what becomes of one that is not as it was written.

A stage reads no damaged file. It makes a file anew by the command that wrote it, which gives the same bytes. Where that
fails, or the file belongs to more than the recording, so that others may make it at the same time, the recording is set aside,
and a failure is counted of the stage that wrote the file, so that the next run makes it anew.
"""

from __future__ import annotations

import importlib.util
import logging
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from markermend.core.recording import BadRecording, SetAside
from markermend.storage import output_checksums, source_file
from markermend.storage.atomic import sha256
from markermend.storage.failure_counts import count_failure
from markermend.storage.folder_names import CLEANED
from markermend.storage.installation import workflow_folder

log = logging.getLogger("markermend")

LONGEST_S = 3600
"""Seconds after which a command that makes a file anew is given up: the longest `runtime` of a stage's rule."""


def checksums(paths: Path | Sequence[Path], *, own: Path) -> str | list[str]:
    """Compute the checksums of inputs, which are then as they were written.

    Parameters
    ----------
    paths : Path or sequence of Path
        One input or several.
    own : Path
        The folder of what the stage is about: a recording, a subject, or all. What lies in a folder above is not made anew.

    Returns
    -------
    str or list of str
        Their sha256.

    Raises
    ------
    BadRecording
        Where one is not there.
    SetAside
        Where one is damaged, and could not be made anew.
    """
    return _checksum(paths, own) if isinstance(paths, Path) else [_checksum(path, own) for path in paths]


def checksums_or_none(paths: Sequence[Path], *, own: Path) -> list[str | None]:
    """Compute the checksums of inputs of which some may be missing or damaged.

    Parameters
    ----------
    paths : sequence of Path
        The inputs.
    own : Path
        See `checksums`.

    Returns
    -------
    list of str or None
        Their sha256; None where one is missing, or damaged and could not be made anew.
    """
    found: list[str | None] = []
    for path in paths:
        try:
            found.append(_checksum(path, own))
        except (BadRecording, SetAside):
            found.append(None)
    return found


def undamaged(paths: Sequence[Path], checksums: Sequence[str | None], *, output: Path, stage: str) -> list[Path]:
    """Choose the recordings of a subject that are there as they were written; a failure is counted where any is not.

    The next run makes that recording anew, and what the subject shares with it.

    Parameters
    ----------
    paths : sequence of Path
        A file of each recording.
    checksums : sequence of str or None
        What `checksums_or_none` gives.
    output : Path
        What is made of them.
    stage : str
        The stage that makes it.

    Returns
    -------
    list of Path
        Those that have a checksum.

    Raises
    ------
    BadRecording
        Where there are none.
    """
    found = [path for path, checksum in zip(paths, checksums, strict=True) if checksum is not None]
    if len(found) < len(paths):
        count_failure(output.parent, stage, f"{len(paths) - len(found)} of {len(paths)} recordings are damaged")
    if not found:
        raise BadRecording("no recording of the subject is as it was written; the next run makes them anew")
    return found


def original_checksum(path: Path, *, within: Path | None) -> str | None:
    """Compute the checksum of an original, of which no stage of ours has a record.

    Parameters
    ----------
    path : Path
        The original.
    within : Path or None
        The folder that links may not lead out of.

    Returns
    -------
    str or None
        Its sha256; None where it is not to be opened (source_file.check).
    """
    try:
        source_file.check(path, within=within)
    except BadRecording:
        return None
    return sha256(path)


def _checksum(path: Path, own: Path) -> str:
    """The checksum of one input."""
    try:
        checksum = sha256(path)
    except FileNotFoundError as error:
        raise BadRecording(f"{path.name} is not there: is it a broken link, or was it moved?") from error
    record = output_checksums.find(path)
    if record is None:
        _check_records(path)
        return checksum
    if record.outputs[path.name] == checksum:
        return checksum
    # What belongs to a folder above is read by others, too, and might be made many times at once; results that were moved would be
    # made where they were.
    if path.parent not in own.parents and str(path) in record.command and _make_anew(path, record):
        return record.outputs[path.name]
    reason = f"{path.name} is not as {record.stage} wrote it: the file is damaged; the next run makes it anew"
    count_failure(path.parent, record.stage, reason)
    raise SetAside(record.stage, reason)


def _check_records(path: Path) -> None:
    """Check that no record which may be that of a file cannot be read."""
    damaged = output_checksums.unreadable(path.parent)
    reason = f"{path.name} has no record that can be read; the next run makes it anew"
    for stage in damaged:
        count_failure(path.parent, stage, reason)
    if damaged:
        raise SetAside(damaged[0], reason)


def _make_anew(path: Path, record: output_checksums.OutputRecord) -> bool:
    """Run the command that wrote a file once more, and say whether the file is as it was."""
    # Results may come from elsewhere, and a record may name any command: none but the stage's own is run, which writes there alone.
    script = workflow_folder() / "scripts" / f"{record.stage}.py"
    if len(record.command) < 2 or Path(record.command[1]).resolve() != script.resolve():
        return False
    outputs = _outputs(script, record.command[2:])
    if not outputs or not all(_belongs(output, path.parent) for output in outputs):
        return False
    log.warning("%s is damaged: running %s once more, which wrote it", path.name, record.stage)
    try:
        subprocess.run([sys.executable, str(script), *record.command[2:]], check=True, timeout=LONGEST_S)
        return sha256(path) == record.outputs[path.name]
    except (OSError, subprocess.SubprocessError):
        return False


def _belongs(output: Path, folder: Path) -> bool:
    """Whether an output lies in the folder of its recording, or among the cleaned files beside the subjects."""
    cleaned = folder.parent.parent / CLEANED
    return output.parent == folder or (cleaned in output.parents and ".." not in output.parts)


def _outputs(script: Path, words: Sequence[str]) -> list[Path]:
    """The files that the command of a stage would write; none where its arguments are not of this version."""
    found = importlib.util.spec_from_file_location(script.stem, script)
    assert found is not None and found.loader is not None
    module: Any = importlib.util.module_from_spec(found)
    found.loader.exec_module(module)
    try:
        arguments = vars(module.STAGE.parser.parse_args(words))
    except SystemExit:
        return []
    named = [arguments[name] for name in module.STAGE.outputs]
    return [path for given in named for path in ([given] if isinstance(given, Path) else given)]
