"""The strings among the parameters of a C3D file as ezc3d reads them, to compare ours with."""

import ezc3d

CHARACTERS = -1
"""The type of a parameter that holds characters."""


def strings_by_ezc3d(path):
    """The strings by group and name, both in capitals, without trailing blanks; Latin-1 where they are not UTF-8."""
    groups = ezc3d.c3d(str(path))["parameters"]
    return {
        group.upper(): {
            name.upper(): [_text(value) for value in parameter["value"]]
            for name, parameter in groups[group].items()
            if isinstance(parameter, dict) and parameter.get("type") == CHARACTERS
        }
        for group in groups
    }


def _text(value):
    """Undo ezc3d's guess at the encoding where it failed."""
    raw = value.encode("utf-8", "surrogateescape")
    try:
        return raw.decode().rstrip(" \0")
    except UnicodeDecodeError:
        return raw.decode("latin-1").rstrip(" \0")
