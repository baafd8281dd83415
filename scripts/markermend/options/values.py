"""Values of options: from what a person wrote to the fields of a class, and back to plain text and JSON."""

from __future__ import annotations

import difflib
import json
import math
import re
import types
from collections.abc import Callable, Collection, Mapping
from dataclasses import MISSING, is_dataclass
from typing import Any, Literal, Union, get_args, get_origin

from markermend.options.declaration import (
    Bound,
    Changes,
    Distinct,
    Keys,
    NotEmpty,
    Option,
    RegularExpression,
    Unit,
    describe,
    marked,
    peel,
)

EXAMPLES = {bool: True, int: 3, float: 0.5, str: "name"}
"""Values that stand for a type where an option has no default to show."""


class BadOptions(ValueError):
    """What a person wrote cannot be used; the message has one line for each problem."""


class Reader:
    """Reads values, and collects all problems instead of stopping at the first.

    Parameters
    ----------
    elsewhere : callable, optional
        Given the place and the value of an unknown key, the problems to report in place of a guess; none if empty.

    Attributes
    ----------
    problems : list of str
        What cannot be used, each with its place and what would do.
    """

    def __init__(self, elsewhere: Callable[[str, Any], list[str]] | None = None) -> None:
        self.problems: list[str] = []
        self._elsewhere = elsewhere or (lambda place, value: [])

    def read(self, hint: Any, value: Any, place: str, example: Any = None) -> Any:
        """Read a value.

        Parameters
        ----------
        hint : Any
            Its type, annotated or not.
        value : Any
            As it was written: text, numbers, lists and mappings.
        place : str
            The keys that lead to it.
        example : Any, optional
            A value that would do.

        Returns
        -------
        Any
            The value in its type; anything where there was a problem.
        """
        kind, marks = peel(hint)
        if get_origin(kind) in (Union, types.UnionType):
            (inner,) = (part for part in get_args(kind) if part is not type(None))
            if value is None:
                return None
            return self.read(inner, value, place, example)
        read = {tuple: self._list, Mapping: self._mapping}.get(get_origin(kind) or kind)
        if is_dataclass(kind):
            return self.read_class(kind, {} if value is None else value, place, example)
        if (changes := marked(marks, Changes)) is not None:
            return self._changes(changes.of, value, place)
        if read is not None:
            return read(kind, marks, value, place, example)
        return self._scalar(kind, marks, value, place, example)

    def read_class(self, cls: Any, value: Any, place: str, example: Any = None) -> Any:
        """Read the options of a class.

        Parameters
        ----------
        cls : type
            The class.
        value : mapping
            Values by the names of fields; what is not there has its default.
        place : str
            The keys that lead to it; empty for none.
        example : Any, optional
            An instance with the defaults, where they differ from the class's own.

        Returns
        -------
        Any
            The instance, or None where there was a problem.
        """
        if not isinstance(value, Mapping):
            self.problems.append(f"{place}: {value!r} is not a mapping of keys to values")
            return None
        options = {option.name: option for option in describe(cls)}
        before = len(self.problems)
        values: dict[str, Any] = {}
        for name, option in options.items():
            default = option.default if example is None else getattr(example, name)
            if name in value:
                values[name] = self.read_option(option, value[name], inside(place, name), default)
            elif default is not MISSING:
                values[name] = default
            else:
                self.problems.append(f"{inside(place, name)}: missing")
        for key in value:
            if key not in options:
                self.unknown(inside(place, key), value[key], options)
        return self.make(cls, values, place) if len(self.problems) == before else None

    def read_option(self, option: Option, value: Any, place: str, default: Any = MISSING) -> Any:
        """Read the value of an option.

        Parameters
        ----------
        option : Option
            The option.
        value : Any
            As it was written.
        place : str
            The keys that lead to it.
        default : Any, optional
            Its default, where it differs from the option's own.

        Returns
        -------
        Any
            The value in its type; anything where there was a problem.
        """
        default = option.default if default is MISSING else default
        return self.read(option.hint, value, place, None if default is MISSING else default)

    def make(self, cls: Any, values: Mapping[str, Any], place: str) -> Any:
        """Make an instance.

        Parameters
        ----------
        cls : type
            A class of options.
        values : mapping
            The values of its fields.
        place : str
            The keys that lead to it.

        Returns
        -------
        Any
            The instance, or None where the class refuses the values, or a least value exceeds the largest of its kind.
        """
        for name in (name for name in values if name.startswith("min_")):
            least, largest = values[name], values.get(f"max_{name[4:]}")
            if least is not None and largest is not None and least > largest:
                self.problems.append(f"{place}: {name} {text(least)} is above max_{name[4:]} {text(largest)}")
        try:
            return cls(**values)
        except ValueError as error:
            self.problems.append(f"{place}: {error}")
            return None

    def unknown(self, place: str, value: Any, known: Collection[str]) -> None:
        """Report a key that is not known.

        Parameters
        ----------
        place : str
            The keys that lead to it, itself the last.
        value : Any
            Its value.
        known : collection of str
            The keys beside it that are known.
        """
        if moved := self._elsewhere(place, value):
            self.problems += moved
            return
        key = place.rpartition(".")[2]
        close = difflib.get_close_matches(key, known, n=1) or [name for name in known if name.endswith(f"_{key}")]
        advice = f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}" if known else ""
        self.problems.append(f"{place}: there is no such key{'; ' if advice else ''}{advice}")

    def finish(self) -> None:
        """End the reading.

        Raises
        ------
        BadOptions
            If there was any problem.
        """
        if self.problems:
            raise BadOptions("\n".join(self.problems))

    def _scalar(self, kind: Any, marks: tuple[Any, ...], value: Any, place: str, example: Any) -> Any:
        """A number, text or one of several names; a value of any type as it is."""
        if kind is Any:
            return value
        if get_origin(kind) is Literal:
            if value not in get_args(kind):
                self.problems.append(f"{place}: {value!r} is none of {', '.join(get_args(kind))}")
            return value
        if kind is int and isinstance(value, float) and value.is_integer():
            value = int(value)
        accepted = (int, float) if kind is float else (kind,)
        if not isinstance(value, accepted) or (isinstance(value, bool) and kind is not bool):
            self._wrong(kind, marks, value, place, example)
            return value
        if kind is float:
            value = float(value)
            if not math.isfinite(value):
                self.problems.append(f"{place}: {value} is not a finite number")
                return value
        unit = marked(marks, Unit)
        for bound in (mark for mark in marks if isinstance(mark, Bound)):
            if not bound.holds(value):
                limit = f"{text(bound.limit)}{f' {unit.symbol}' if unit else ''}"
                self.problems.append(f"{place}: {text(value)} is out of bounds; it must be {bound.words} {limit}")
        if marked(marks, NotEmpty) is not None and not value:
            self.problems.append(f"{place}: it must not be empty")
        if marked(marks, RegularExpression) is not None:
            try:
                re.compile(value)
            except re.error as error:
                self.problems.append(f"{place}: {value!r} is not a regular expression ({error})")
        return value

    def _list(self, kind: Any, marks: tuple[Any, ...], value: Any, place: str, example: Any) -> Any:
        """A list of values."""
        if not isinstance(value, list | tuple):
            self._wrong(kind, marks, value, place, example)
            return value
        if marked(marks, NotEmpty) is not None and not value:
            self.problems.append(f"{place}: it must not be empty")
        item, first = get_args(kind)[0], example[0] if example else None
        values = tuple(self.read(item, own, f"{place}[{n}]", first) for n, own in enumerate(value))
        if marked(marks, Distinct) is not None:
            twice = dict.fromkeys(own for own in values if values.count(own) > 1)
            self.problems += [f"{place}: {own!r} is there twice" for own in twice]
        return values

    def _mapping(self, kind: Any, marks: tuple[Any, ...], value: Any, place: str, example: Any) -> Any:
        """A mapping of names to values."""
        if not isinstance(value, Mapping):
            self._wrong(kind, marks, value, place, example)
            return value
        keys = marked(marks, Keys)
        for key in value:
            if keys is not None and key not in keys.names:
                self.unknown(inside(place, str(key)), value[key], keys.names)
        first = next(iter(example.values()), None) if example else None
        inner = get_args(kind)[1]
        read = {str(key): self.read(inner, own, inside(place, str(key)), first) for key, own in value.items()}
        return {**example, **read} if keys is not None and example else read

    def _changes(self, cls: type, value: Any, place: str) -> Any:
        """Some options of a class."""
        if not isinstance(value, Mapping):
            self.problems.append(f"{place}: {value!r} is not a mapping of keys to values")
            return value
        options = {option.name: option for option in describe(cls)}
        for key in value:
            if key not in options:
                self.unknown(inside(place, key), value[key], options)
        known = {key: own for key, own in value.items() if key in options}
        return {key: self.read_option(options[key], own, inside(place, key)) for key, own in known.items()}

    def _wrong(self, kind: Any, marks: tuple[Any, ...], value: Any, place: str, example: Any) -> None:
        """Report a value of another type."""
        example = EXAMPLES.get(kind) if example is None else example
        if get_origin(kind) is tuple and peel(get_args(kind)[0])[0] is str and isinstance(value, str):
            example = [value]
        such = f", such as {text(plain(example))}" if example or example == 0 else ""
        self.problems.append(f"{place}: {value!r} is not {spell(kind, marks)}{such}{_without_quotes(kind, value)}")


def _without_quotes(kind: Any, value: Any) -> str:
    """What to write in place of a number, or of true or false, that came as a text; nothing for other values."""
    try:
        meant = text(float(value)) if kind in (int, float) else {"true": "true", "false": "false"}[value]
    except (KeyError, TypeError, ValueError):
        return ""
    if not isinstance(value, str):
        return ""
    return f"; write {meant} without quotes, and in a file: --config SECTION='{{...}}' makes texts of numbers"


def inside(place: str, key: Any) -> str:
    """Name the place of a key.

    Parameters
    ----------
    place : str
        The keys that lead to the mapping that it is in; empty for none.
    key : Any
        The key.

    Returns
    -------
    str
        All of them, joined by full stops.
    """
    return f"{place}.{key}" if place else str(key)


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


def parse(option: Option, words: str) -> Any:
    """Read an option from its flag.

    Parameters
    ----------
    option : Option
        The option.
    words : str
        What the flag was given.

    Returns
    -------
    Any
        The value in its type.

    Raises
    ------
    BadOptions
        If it cannot be used.
    """
    arguments = get_args(option.kind)
    if words == "none" and type(None) in arguments:
        return None
    value: Any = words
    if option.kind is not str and get_origin(option.kind) is not Literal:
        try:
            value = json.loads(words)
        except json.JSONDecodeError:
            value = words
    reader = Reader()
    value = reader.read_option(option, value, option.name)
    reader.finish()
    return value
