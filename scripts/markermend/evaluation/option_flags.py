"""Options of the experiments as a flag of a command: JSON with those that the command reads."""

from __future__ import annotations

import json
from typing import Any, TypeVar

from markermend.options.reader import BadOptions, Reader
from markermend.options.values import plain

Section = TypeVar("Section")


def write_flag(options: Any, *names: str) -> str:
    """Write options for the command of a job, which sees only those that it reads.

    Parameters
    ----------
    options : Any
        An instance of a class of options.
    *names : str
        The options that the command reads.

    Returns
    -------
    str
        JSON.
    """
    return json.dumps({name: plain(getattr(options, name)) for name in names}, sort_keys=True)


def read_flag(cls: type[Section], words: str) -> Section:
    """Read what write_flag wrote.

    Parameters
    ----------
    cls : type
        The class of options.
    words : str
        JSON.

    Returns
    -------
    object
        An instance; options that are not there have their defaults.

    Raises
    ------
    BadOptions
        With all that cannot be used.
    """
    try:
        value = json.loads(words)
    except json.JSONDecodeError as error:
        raise BadOptions(f"--options: {error}") from error
    reader = Reader()
    read: Section = reader.read_class(cls, value, "")
    reader.finish()
    return read
