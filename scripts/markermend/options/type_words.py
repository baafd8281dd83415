"""The types of options in words, for messages and tables."""

from __future__ import annotations

import types
from collections.abc import Mapping
from typing import Any, Literal, Union, get_args, get_origin

from markermend.options.declaration import Changes, Unit
from markermend.options.description import marked, peel


def spell(kind: Any, marks: tuple[Any, ...] = (), *, many: bool = False) -> str:
    """Write a type in words.

    Parameters
    ----------
    kind : Any
        The type.
    marks : tuple, optional
        What is annotated.
    many : bool, optional
        Whether there are several.

    Returns
    -------
    str
        Such as "a number of seconds".
    """
    kind, more = peel(kind)
    marks = (*marks, *more)
    if get_origin(kind) in (Union, types.UnionType):
        return spell(next(part for part in get_args(kind) if part is not type(None)), marks, many=many)
    if get_origin(kind) is Literal:
        return f"one of {', '.join(get_args(kind))}"
    unit = marked(marks, Unit)
    if kind in (int, float):
        noun = ("whole " if kind is int else "") + ("numbers" if many else "number")
        return f"{'' if many else 'a '}{noun}{f' of {unit.plural}' if unit else ''}"
    if get_origin(kind) is tuple:
        return f"{'lists' if many else 'a list'} of {spell(get_args(kind)[0], many=True)}"
    if get_origin(kind) is Mapping and marked(marks, Changes) is None:
        return f"{'mappings' if many else 'a mapping'} of names to {spell(get_args(kind)[1], many=True)}"
    words = {bool: "true or false", str: "texts" if many else "a text"}
    return words.get(kind, "mappings" if many else "a mapping")
