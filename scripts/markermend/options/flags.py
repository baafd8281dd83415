"""The flags of a stage: which of its options are passed to its command, and how."""

from __future__ import annotations

import shlex
from typing import Any

from markermend.options.declaration import Planned
from markermend.options.description import Option, describe, marked
from markermend.options.values import plain, text


def stage_options(cls: type) -> tuple[Option, ...]:
    """List the options that are passed to a stage.

    Parameters
    ----------
    cls : type
        The class of the stage's options.

    Returns
    -------
    tuple of Option
        Its fields, without those that are read when a run is planned.
    """
    return tuple(option for option in describe(cls) if marked(option.marks, Planned) is None)


def passed(options: Any) -> dict[str, Any]:
    """Write the options that are passed to a stage.

    Parameters
    ----------
    options : Any
        An instance of the class of the stage's options.

    Returns
    -------
    dict
        Plain values by name; of what the stage shares with others, only the parts that it reads.
    """
    written = {option.name: plain(getattr(options, option.name)) for option in stage_options(type(options))}
    for option in stage_options(type(options)):
        if option.shared is not None and option.shared.parts:
            written[option.name] = {part: written[option.name][part] for part in option.shared.parts}
    return written


def flag(name: str) -> str:
    """Name the flag of an option or a file.

    Parameters
    ----------
    name : str
        Its name.

    Returns
    -------
    str
        The flag.
    """
    return "--" + name.replace("_", "-")


def flags(options: Any) -> list[str]:
    """Write options as flags.

    Parameters
    ----------
    options : Any
        An instance of a class of options.

    Returns
    -------
    list of str
        `--name=value` for each, so that a leading dash or `@` means nothing; lists and mappings are JSON.
    """
    return [f"{flag(name)}={text(value)}" for name, value in passed(options).items()]


def write_flags(options: Any) -> str:
    """Write options as flags, quoted for a shell.

    Parameters
    ----------
    options : Any
        An instance of a class of options.

    Returns
    -------
    str
        The flags.
    """
    return shlex.join(flags(options))
