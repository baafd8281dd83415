"""Files written all at once or not at all, and their checksums."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any


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
def replacing(path: Path) -> Iterator[Path]:
    """Replace a file as a whole, or not at all.

    Parameters
    ----------
    path : Path
        The file; its folder is made where it is not there.

    Yields
    ------
    Path
        A temporary path beside it to write to, which is renamed when the block succeeds and deleted otherwise.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


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
