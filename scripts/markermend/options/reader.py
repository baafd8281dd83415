"""Reading of options: from what a person wrote to the fields of a class, with all problems at once."""

from __future__ import annotations

import difflib
import json
import types
from collections.abc import Callable, Collection, Mapping
from dataclasses import MISSING, is_dataclass
from typing import Any, Literal, Union, get_args, get_origin

from markermend.options.declaration import Changes, Distinct, Keys, NotEmpty
from markermend.options.description import Option, describe, marked, peel
from markermend.options.scalars import read_scalar, wrong_type
from markermend.options.values import text


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
        value, problems = read_scalar(kind, marks, value, place, example)
        self.problems += problems
        return value

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

    def _list(self, kind: Any, marks: tuple[Any, ...], value: Any, place: str, example: Any) -> Any:
        """A list of values."""
        if not isinstance(value, list | tuple):
            self.problems.append(wrong_type(kind, marks, value, place, example))
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
            self.problems.append(wrong_type(kind, marks, value, place, example))
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
