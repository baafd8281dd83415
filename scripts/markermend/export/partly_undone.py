"""Cleaned files in which some changes were taken back: recognised by what is kept of the original and of what was written."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np

from markermend.storage.atomic import sha256
from markermend.storage.original_bytes import OriginalBytes


def recognise(path: Path, stored: OriginalBytes, expected: str) -> tuple[np.ndarray, np.ndarray] | None:
    """Recognise a cleaned file, as it was written or with some of its changes taken back.

    Parameters
    ----------
    path : Path
        The file.
    stored : OriginalBytes
        What the original and the cleaned file have in place of the changed samples.
    expected : str
        Checksum of the cleaned file as it was written.

    Returns
    -------
    content : ndarray of uint8
        The cleaned file as it was written.
    original : ndarray of bool, shape (n,)
        The stretches of bytes in which the file has those of the original. None in place of both for any other file.

    Raises
    ------
    OSError
        Where the file cannot be read.
    """
    if sha256(path) == expected:
        return file_bytes(path), np.zeros(len(stored.start), bool)
    state = stored.as_written(file_bytes(path))
    if state is None or hashlib.sha256(state[0]).hexdigest() != expected:
        return None
    return np.frombuffer(state[0], np.uint8), state[1]


def file_bytes(path: Path) -> np.ndarray:
    """Map the bytes of a file into memory.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    ndarray of uint8
        Its bytes, which may be none.
    """
    return np.memmap(path, np.uint8, "r") if path.stat().st_size else np.zeros(0, np.uint8)
