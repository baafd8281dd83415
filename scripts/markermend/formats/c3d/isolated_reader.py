"""The strings among the parameters of a C3D file as ezc3d reads them, in a process of its own.

ezc3d crashes, hangs or exhausts memory on some damaged files.
"""

from __future__ import annotations

import json
import tempfile
from typing import cast

from markermend.formats.c3d.isolated_process import call_isolated

SECONDS = 5
"""Time that reading parameters may take, where it takes milliseconds."""

MEMORY = 256 * 2**20
"""Bytes that reading parameters may take, where it takes little more than the section."""

CHARACTERS = -1
"""The type of a parameter that holds characters."""

Groups = dict[str, dict[str, list[str]]]


def strings_by_ezc3d(content: bytes) -> Groups:
    """Read the strings among the parameters of a C3D file.

    Parameters
    ----------
    content : bytes
        The file.

    Returns
    -------
    dict of str to dict of str to list of str
        Strings by group and name, both in capitals; empty where ezc3d cannot read the file.
    """
    import ezc3d  # noqa: F401  (before the fork, so that it is loaded once)

    with tempfile.NamedTemporaryFile(suffix=".c3d") as file:
        file.write(content)
        file.flush()
        answer = call_isolated(lambda: json.dumps(_read(file.name)).encode(), seconds=SECONDS, memory=MEMORY)
    return cast(Groups, json.loads(answer)) if answer is not None else {}


def _read(path: str) -> Groups:
    """The strings that ezc3d finds, without trailing blanks; Latin-1 where they are not UTF-8."""
    import ezc3d

    groups = ezc3d.c3d(path)["parameters"]
    return {
        group.upper(): {
            name.upper(): [_text(value) for value in parameter["value"]]
            for name, parameter in groups[group].items()
            if isinstance(parameter, dict) and parameter.get("type") == CHARACTERS
        }
        for group in groups
    }


def _text(value: str) -> str:
    """Undo ezc3d's guess at the encoding where it failed."""
    raw = value.encode("utf-8", "surrogateescape")
    try:
        text = raw.decode()
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    return text.rstrip(" \0")
