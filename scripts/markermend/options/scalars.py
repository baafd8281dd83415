"""Numbers, texts and names as options: what a person wrote, brought into its type and checked against its bounds."""

from __future__ import annotations

import math
import re
from typing import Any, Literal, get_args, get_origin

from markermend.options.declaration import Bound, NotEmpty, RegularExpression, Unit
from markermend.options.description import marked, peel
from markermend.options.type_words import spell
from markermend.options.values import plain, text

EXAMPLES = {bool: True, int: 3, float: 0.5, str: "name"}
"""Values that stand for a type where an option has no default to show."""


def read_scalar(
    kind: Any, marks: tuple[Any, ...], value: Any, place: str, example: Any = None
) -> tuple[Any, list[str]]:
    """Read a number, a text or one of several names.

    Parameters
    ----------
    kind : Any
        Its type; a value of the type Any stays as it is.
    marks : tuple
        What is annotated: bounds, unit, and what a text must be.
    value : Any
        As it was written.
    place : str
        The keys that lead to it.
    example : Any, optional
        A value that would do.

    Returns
    -------
    value : Any
        The value in its type; anything where there is a problem.
    problems : list of str
        Why it cannot be used.
    """
    if kind is Any:
        return value, []
    if get_origin(kind) is Literal:
        names = get_args(kind)
        return value, [] if value in names else [f"{place}: {value!r} is none of {', '.join(names)}"]
    if kind is int and isinstance(value, float) and value.is_integer():
        value = int(value)
    accepted = (int, float) if kind is float else (kind,)
    if not isinstance(value, accepted) or (isinstance(value, bool) and kind is not bool):
        return value, [wrong_type(kind, marks, value, place, example)]
    if kind is float:
        value = float(value)
        if not math.isfinite(value):
            return value, [f"{place}: {value} is not a finite number"]
    return value, [f"{place}: {problem}" for problem in _objections(marks, value)]


def _objections(marks: tuple[Any, ...], value: Any) -> list[str]:
    """What speaks against a value of the right type: its bounds, and what a text must be."""
    unit = marked(marks, Unit)
    symbol = f" {unit.symbol}" if unit else ""
    problems = [
        f"{text(value)} is out of bounds; it must be {bound.words} {text(bound.limit)}{symbol}"
        for bound in marks
        if isinstance(bound, Bound) and not bound.holds(value)
    ]
    if marked(marks, NotEmpty) is not None and not value:
        problems.append("it must not be empty")
    if marked(marks, RegularExpression) is not None:
        try:
            re.compile(value)
        except re.error as error:
            problems.append(f"{value!r} is not a regular expression ({error})")
    return problems


def wrong_type(kind: Any, marks: tuple[Any, ...], value: Any, place: str, example: Any = None) -> str:
    """Say that a value is of another type.

    Parameters
    ----------
    kind : Any
        The type that it should have.
    marks : tuple
        What is annotated.
    value : Any
        As it was written.
    place : str
        The keys that lead to it.
    example : Any, optional
        A value that would do.

    Returns
    -------
    str
        The problem, with an example and, for texts that should be numbers, how to write them.
    """
    example = EXAMPLES.get(kind) if example is None else example
    if get_origin(kind) is tuple and peel(get_args(kind)[0])[0] is str and isinstance(value, str):
        example = [value]
    such = f", such as {text(plain(example))}" if example or example == 0 else ""
    return f"{place}: {value!r} is not {spell(kind, marks)}{such}{_without_quotes(kind, value)}"


def _without_quotes(kind: Any, value: Any) -> str:
    """What to write in place of a number, or of true or false, that came as a text; nothing for other values."""
    try:
        meant = text(float(value)) if kind in (int, float) else {"true": "true", "false": "false"}[value]
    except (KeyError, TypeError, ValueError):
        return ""
    if not isinstance(value, str):
        return ""
    return f"; write {meant} without quotes, and in a file: --config SECTION='{{...}}' makes texts of numbers"
