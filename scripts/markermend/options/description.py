"""What is declared of an option, read back from its class: type, unit, bounds, default and text."""

from __future__ import annotations

import ast
import functools
import inspect
import itertools
import textwrap
from collections import ChainMap
from collections.abc import Iterator
from dataclasses import MISSING, dataclass, fields
from typing import Annotated, Any, Literal, TypeVar, get_args, get_origin, get_type_hints

from markermend.options.declaration import Laboratory, Shared, Unit

Mark = TypeVar("Mark")

CHANGE = "Change it when "
"""How the paragraph begins that says when to change an option."""


@dataclass(frozen=True)
class Option:
    """An option as it was declared.

    Attributes
    ----------
    name : str
        Name of the field.
    hint : Any
        Its type, annotated.
    default : Any
        Its default; MISSING where it has none.
    meaning : str
        What it means, a sentence without its full stop.
    change_when : str
        When to change it; empty where there is nothing to say.
    """

    name: str
    hint: Any
    default: Any
    meaning: str
    change_when: str

    @property
    def kind(self) -> Any:
        """Its type, without what is annotated."""
        return peel(self.hint)[0]

    @property
    def marks(self) -> tuple[Any, ...]:
        """What is annotated: unit, bounds, and the other marks of `declaration`."""
        return peel(self.hint)[1]

    @property
    def laboratory(self) -> bool:
        """Whether a laboratory sets it."""
        return marked(self.marks, Laboratory) is not None

    @property
    def shared(self) -> Shared | None:
        """Where the value comes from, if it is set elsewhere."""
        return marked(self.marks, Shared)

    @property
    def nested(self) -> type | None:
        """The class of the options that it holds, if it holds several."""
        return self.kind if isinstance(self.kind, type) and hasattr(self.kind, "__dataclass_fields__") else None


def marked(marks: tuple[Any, ...], kind: type[Mark]) -> Mark | None:
    """Find a mark.

    Parameters
    ----------
    marks : tuple
        What is annotated.
    kind : type
        Class of the mark.

    Returns
    -------
    object or None
        The first mark of this class, given as an instance or as the class itself.
    """
    for mark in marks:
        if isinstance(mark, kind):
            return mark
        if mark is kind:
            return kind()
    return None


def peel(hint: Any) -> tuple[Any, tuple[Any, ...]]:
    """Part a type from what is annotated.

    Parameters
    ----------
    hint : Any
        A type, annotated or not.

    Returns
    -------
    kind : Any
        The type.
    marks : tuple
        What is annotated.
    """
    if get_origin(hint) is Annotated:
        kind, *marks = get_args(hint)
        return kind, tuple(marks)
    return hint, ()


@functools.cache
def describe(cls: type) -> tuple[Option, ...]:
    """Describe the options of a class.

    Parameters
    ----------
    cls : type
        A dataclass of options.

    Returns
    -------
    tuple of Option
        Its fields in their order: those of the class itself, of its bases, and those that are set elsewhere.

    Raises
    ------
    ValueError
        If a field has no text below it.
    """
    hints = get_type_hints(cls, include_extras=True)
    words = ChainMap(*map(_texts, cls.__mro__[:-1]))
    own_first = [name for base in cls.__mro__[:-1] for name in _texts(base)]
    options = []
    for field in sorted(fields(cls), key=lambda field: own_first.index(field.name)):
        meaning, _, change = words[field.name].partition(f"\n\n{CHANGE}")
        meaning, change = (" ".join(part.split()).removesuffix(".") for part in (meaning, change))
        default = field.default_factory() if field.default_factory is not MISSING else field.default
        options.append(Option(field.name, hints[field.name], default, meaning, change))
    return tuple(sorted(options, key=lambda option: option.shared is not None))


def unit(hint: Any) -> str:
    """Find the unit of a type.

    Parameters
    ----------
    hint : Any
        The type, annotated or not; of a list or mapping, that of its values counts.

    Returns
    -------
    str
        Its symbol, or nothing.
    """
    kind, marks = peel(hint)
    found = marked(marks, Unit)
    if found is not None:
        return found.symbol
    return next((symbol for part in get_args(kind) if get_origin(kind) is not Literal and (symbol := unit(part))), "")


def full_meaning(option: Option) -> str:
    """Say what an option means, with its unit.

    Parameters
    ----------
    option : Option
        The option.

    Returns
    -------
    str
        A sentence without its full stop.
    """
    symbol = unit(option.hint)
    first, mark, rest = option.meaning.partition(";")
    return f"{first} [{symbol}]{mark}{rest}" if symbol else option.meaning


def _texts(cls: type) -> dict[str, str]:
    """The docstrings below the fields that a class itself declares."""
    if "__annotations__" not in vars(cls):
        return {}
    body = ast.parse(textwrap.dedent(inspect.getsource(cls))).body[0]
    assert isinstance(body, ast.ClassDef)
    return dict(_pairs(body.body))


def _pairs(statements: list[ast.stmt]) -> Iterator[tuple[str, str]]:
    """Names of fields with the docstrings right below them."""
    for statement, below in itertools.pairwise(statements):
        named = isinstance(statement, ast.AnnAssign) and isinstance(statement.target, ast.Name)
        if named and isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant):
            yield statement.target.id, inspect.cleandoc(str(below.value.value))  # type: ignore[attr-defined]
