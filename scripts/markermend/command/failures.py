"""The failures that may pass: what a person reads of one."""

from __future__ import annotations

import os

from markermend.core.recording import SourceChanged


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
