"""Values of options as plain text and JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import is_dataclass
from typing import Any

from markermend.options.description import describe


def plain(value: Any) -> Any:
    """Write a value with what JSON and YAML know.

    Parameters
    ----------
    value : Any
        A value of an option, or an instance of a class of options.

    Returns
    -------
    Any
        The same in dictionaries, lists, texts and numbers.
    """
    if is_dataclass(value) and not isinstance(value, type):
        return {option.name: plain(getattr(value, option.name)) for option in describe(type(value))}
    if isinstance(value, Mapping):
        return {key: plain(own) for key, own in value.items()}
    if isinstance(value, list | tuple):
        return [plain(own) for own in value]
    return value


def text(value: Any) -> str:
    """Write a plain value as a flag or a message has it.

    Parameters
    ----------
    value : Any
        As `plain` gives it.

    Returns
    -------
    str
        `none`, `true`, `false`, a number as YAML 1.1 reads it (`1.0e-06`), a text as it is, or JSON.
    """
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict | list):
        return json.dumps(_shortest(value), sort_keys=True, ensure_ascii=False)
    if isinstance(value, float):
        if value.is_integer() and abs(value) < 1e15:
            return str(int(value))
        mantissa, mark, exponent = repr(value).partition("e")
        return f"{mantissa}{'.0' if mark and '.' not in mantissa else ''}{mark}{exponent}"
    return str(value)


def _shortest(value: Any) -> Any:
    """A plain value with whole numbers as such, so that 1 and 1.0 give the same text, and the same run."""
    if isinstance(value, dict):
        return {key: _shortest(own) for key, own in value.items()}
    if isinstance(value, list):
        return [_shortest(own) for own in value]
    return int(value) if isinstance(value, float) and value.is_integer() and abs(value) < 1e15 else value
