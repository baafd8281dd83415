"""How an option is declared: a field of a frozen dataclass with its type, unit, bounds, default and text.

The type of a field is `Annotated` with its unit and bounds, and the docstring below the field is its text: a paragraph
on what it means, then, where there is something to say, a paragraph that begins with "Change it when".
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar


@dataclass(frozen=True)
class Unit:
    """Unit of a number.

    Attributes
    ----------
    symbol : str
        As it stands behind a number, such as `s`.
    plural : str
        In words, such as `seconds`.
    """

    symbol: str
    plural: str


@dataclass(frozen=True)
class Bound(ABC):
    """Bound of a number.

    Attributes
    ----------
    limit : float
        The bound.
    """

    limit: float
    words: ClassVar[str]
    keyword: ClassVar[str]

    @abstractmethod
    def holds(self, value: float) -> bool:
        """Say whether a number is within the bound.

        Parameters
        ----------
        value : float
            The number.

        Returns
        -------
        bool
            Whether it is.
        """


class Above(Bound):
    """A number is greater than this."""

    words, keyword = "above", "exclusiveMinimum"

    def holds(self, value: float) -> bool:
        """See `Bound.holds`."""
        return value > self.limit


class AtLeast(Bound):
    """A number is this or greater."""

    words, keyword = "at least", "minimum"

    def holds(self, value: float) -> bool:
        """See `Bound.holds`."""
        return value >= self.limit


class Below(Bound):
    """A number is less than this."""

    words, keyword = "below", "exclusiveMaximum"

    def holds(self, value: float) -> bool:
        """See `Bound.holds`."""
        return value < self.limit


class AtMost(Bound):
    """A number is this or less."""

    words, keyword = "at most", "maximum"

    def holds(self, value: float) -> bool:
        """See `Bound.holds`."""
        return value <= self.limit


class Laboratory:
    """Marks an option that a laboratory sets; every other one is advanced."""


class Planned:
    """Marks an option that is read when a run is planned, and that no stage is given."""


class NotEmpty:
    """Marks a text or list that has at least one character or value."""


class Distinct:
    """Marks a list whose values are all different."""


class RegularExpression:
    """Marks a text that is a regular expression."""


@dataclass(frozen=True)
class Keys:
    """Marks a mapping that has these keys and no other.

    Attributes
    ----------
    names : tuple of str
        The keys.
    """

    names: tuple[str, ...]


@dataclass(frozen=True)
class Changes:
    """Marks a mapping that changes some options of a class.

    Attributes
    ----------
    of : type
        The class, whose fields are the possible keys.
    """

    of: type


@dataclass(frozen=True)
class Shared:
    """Marks a field whose value is set elsewhere: in the section, or under the top-level key, of the field's name.

    Attributes
    ----------
    parts : tuple of str
        The fields of that section that are read; all of them if empty.
    """

    parts: tuple[str, ...] = ()


Seconds = Annotated[float, Unit("s", "seconds"), AtLeast(0)]
PositiveSeconds = Annotated[float, Unit("s", "seconds"), Above(0)]
Millimetres = Annotated[float, Unit("mm", "millimetres"), AtLeast(0)]
PositiveMillimetres = Annotated[float, Unit("mm", "millimetres"), Above(0)]
Share = Annotated[float, AtLeast(0), AtMost(1)]
Factor = Annotated[float, AtLeast(1)]
NotNegative = Annotated[float, AtLeast(0)]
Positive = Annotated[float, Above(0)]
PositiveHertz = Annotated[float, Unit("Hz", "hertz"), Above(0)]

Count = Annotated[int, AtLeast(1)]
CountOrNone = Annotated[int, AtLeast(0)]
