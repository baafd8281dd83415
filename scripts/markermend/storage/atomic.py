"""Files written all at once or not at all, and their checksums."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import platform
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Errors of a disk without room."""


class NotWritten(OSError):
    """A file that could not be written; the message says which, why and what to do."""


def sha256(path: Path) -> str:
    """Compute the checksum of a file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    str
        The sha256 of its bytes in hexadecimal digits.
    """
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@contextmanager
def replacing(path: Path, *, source: Path | None = None) -> Iterator[Path]:
    """Replace a file as a whole, or not at all.

    Parameters
    ----------
    path : Path
        The file; its folder is made where it is not there.
    source : Path, optional
        The file that the block reads while it writes.

    Yields
    ------
    Path
        A temporary path beside it to write to, which is renamed when the block succeeds and deleted otherwise.

    Raises
    ------
    NotWritten
        Where the file cannot be written. Other errors of the block, such as those of a file that it reads, are left as they are.
    """
    start = f".{path.name}.{platform.node()}."
    temporary = path.with_name(f"{start}{os.getpid()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        _remove_abandoned(path.parent, start)
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        if isinstance(error, NotWritten) or not _concerns(error, path, temporary, source):
            raise
        raise NotWritten(not_written(path, error)) from error
    finally:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)


def _remove_abandoned(folder: Path, start: str) -> None:
    """Remove the temporary files of processes of this machine that were killed; their names end with the numbers of these."""
    for name in os.listdir(folder):
        if name.startswith(start) and not _is_alive(name.removeprefix(start)):
            with suppress(OSError):
                (folder / name).unlink()


def _is_alive(number: str) -> bool:
    """Whether there is a process of a number, as far as that can be found out."""
    try:
        # Elsewhere this would end the process.
        if os.name == "posix":
            os.kill(int(number), 0)
    except ProcessLookupError:
        return False
    except (OSError, ValueError, OverflowError):
        return True
    return True


def _concerns(error: OSError, path: Path, temporary: Path, source: Path | None) -> bool:
    """Whether an error is one of writing a file. Copying names the file that it reads even where the disk is full."""
    if error.errno in (*FULL, errno.EROFS):
        return True
    if error.filename is None:
        return source is None or _can_be_read(source)
    return Path(os.fsdecode(error.filename)) in (path, temporary, *path.parents)


def _can_be_read(path: Path) -> bool:
    """Whether a file can be read to its end."""
    try:
        sha256(path)
    except OSError:
        return False
    return True


def not_written(path: Path, error: OSError) -> str:
    """Say that a file could not be written, why, and what to do.

    Parameters
    ----------
    path : Path
        The file.
    error : OSError
        What went wrong.

    Returns
    -------
    str
        One sentence.
    """
    if error.errno in FULL:
        why, advice = "there is no room", "make room on the disk or choose another folder for the results"
    elif error.errno in (errno.EROFS, errno.EACCES, errno.EPERM):
        why, advice = "its place is read-only", "choose another folder for the results, or allow writing"
    elif error.errno in (errno.ENOTDIR, errno.EEXIST):
        why, advice = "a file stands where a folder must be", "choose another folder for the results"
    else:
        why, advice = error.strerror or str(error), "see to the disk"
    return f"{path} was not written: {why} ({advice}, and run again)"


def check_writable(folder: Path) -> None:
    """Check that files can be written into a folder, which is made where it is not there.

    Parameters
    ----------
    folder : Path
        The folder.

    Raises
    ------
    NotWritten
        Where none can.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(b" ")
            file.flush()
    except OSError as error:
        raise NotWritten(not_written(folder, error)) from error


def write_text(path: Path, text: str) -> None:
    """Write text in UTF-8 with the line ends that it has.

    Parameters
    ----------
    path : Path
        The file.
    text : str
        Its content.
    """
    with replacing(path) as temporary:
        temporary.write_bytes(text.encode())


def write_list(path: str, files: Iterable[str]) -> None:
    """Write the names of files, one a line.

    Parameters
    ----------
    path : str
        The file.
    files : iterable of str
        The names.
    """
    write_text(Path(path), "".join(f"{file}\n" for file in files))


def write_json(path: Path, value: Any) -> None:
    """Write JSON with sorted keys, so that equal values give equal bytes.

    Parameters
    ----------
    path : Path
        The file.
    value : Any
        JSON values.
    """
    write_text(path, json.dumps(value, indent=1, sort_keys=True, ensure_ascii=False, allow_nan=False) + "\n")
