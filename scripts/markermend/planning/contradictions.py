"""Decisions on the same samples that cannot both be followed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from typing import Any

from markermend.core.decisions import LEAVE, Decision, read


@dataclass(frozen=True)
class Line:
    """A line of the table of decisions.

    Attributes
    ----------
    number : int
        Its number in the file.
    entry : mapping of str to Any
        The decision as the stages read it.
    """

    number: int
    entry: Mapping[str, Any]

    @property
    def decision(self) -> Decision:
        """The decision, on frames as the capture program numbers them."""
        return read([self.entry], first_frame=0)[0]


def find_contradictions(lines: Sequence[Line]) -> Iterator[str]:
    """Find lines on one recording that contradict each other.

    Parameters
    ----------
    lines : sequence of Line
        The lines on the recording.

    Yields
    ------
    str
        Which two lines contradict each other, and what they decide.
    """
    numbered = [(line.number, line.decision) for line in lines]
    for (one, a), (other, b) in combinations(numbered, 2):
        if a.start < b.stop and b.start < a.stop and exclude_each_other(a, b) and patterns_overlap(a.marker, b.marker):
            yield f"lines {one} and {other} contradict each other: {a.marker} {a.words}, {b.marker} {b.words}"


def exclude_each_other(one: Decision, other: Decision) -> bool:
    """Judge whether two decisions on the same samples exclude each other.

    Parameters
    ----------
    one, other : Decision
        The decisions.

    Returns
    -------
    bool
        True where only one of them can be followed. `protect` wins over all others, and so never excludes one.
    """
    verbs = {one.verb, other.verb}
    if "protect" in verbs:
        return False
    if len(verbs) == 1:
        return verbs <= {"class", "method"} and one.value != other.value
    if "method" in verbs:
        return LEAVE in (one.value, other.value) and not verbs.isdisjoint({"accept", "class"})
    return not one.kinds.isdisjoint(other.kinds)


@cache
def patterns_overlap(one: str, other: str) -> bool:
    """Judge whether some name fits both of two patterns.

    Parameters
    ----------
    one, other : str
        Patterns with `*` and `?`.

    Returns
    -------
    bool
        True where there is such a name.
    """
    if not one and not other:
        return True
    if other.startswith("*") and not one.startswith("*"):
        one, other = other, one
    if one.startswith("*"):
        return patterns_overlap(one[1:], other) or (other != "" and patterns_overlap(one, other[1:]))
    fits = one != "" and other != "" and (one[0] == other[0] or "?" in (one[0], other[0]))
    return fits and patterns_overlap(one[1:], other[1:])
