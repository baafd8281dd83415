"""What a person decided about a recording.

Frames are rows counted from 0, half-open; only the table of decisions uses the capture program's numbering.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Any

from markermend.core.artifacts import BY_NAME
from markermend.core.reasons import Cause, Reason

VERBS = ("accept", "reject", "protect", "class", "method", "missing")
"""What a person can decide: that a finding is one, that it is none, that samples stay as they are, that a stretch is an
artifact of a class, how to repair or fill, and that samples count as missing."""

LEAVE = "leave"
"""The method that leaves everything as it is."""

EVER = 2**62
"""A frame before (negative) or after every recording's."""


@dataclass(frozen=True, order=True)
class Decision:
    """One decision of a person on a stretch of one or more markers.

    Attributes
    ----------
    marker : str
        Name of the marker, or a pattern with * and ?.
    start, stop : int
        First frame, and the frame after the last, as rows counted from 0.
    verb : str
        One of VERBS.
    value : str
        A class (`swap:PARTNER` for an exchange of labels that was not found) or a method.
    note : str
        The person's reason.
    by : str
        The person's name or initials.
    date : str
        The day of the decision, as in 2026-03-31.
    person : bool
        False where an option of the config says so and not a person.
    """

    marker: str
    start: int
    stop: int
    verb: str
    value: str = ""
    note: str = ""
    by: str = ""
    date: str = ""
    person: bool = True

    @property
    def text(self) -> str:
        """The decision in the words of the table, without what is remarked on it."""
        return f"{self.verb} {self.value}".rstrip()

    @property
    def words(self) -> str:
        """The decision with what is remarked on it: why, by whom and when."""
        signature = ", ".join(part for part in (self.by, self.date) if part)
        remarks = [remark for remark in (self.note, signature) if remark]
        return f"{self.text} ({'; '.join(remarks)})" if remarks else self.text

    @property
    def reason(self) -> Reason:
        """The reason of a stretch that stays as it is because of this decision."""
        if self.person:
            return Reason(Cause.DECIDED, f"a person decided: {self.text}")
        return Reason(Cause.PROTECTED, "protected")

    @property
    def kinds(self) -> frozenset[str]:
        """The classes that it is about: all but gaps where it names none."""
        return frozenset([self.value.partition(":")[0]] if self.value else BY_NAME)

    @property
    def partner(self) -> str | None:
        """The other marker of an exchange of labels that was not found."""
        return self.value.partition(":")[2] or None

    def matches(self, marker: str) -> bool:
        """Check whether the decision is about a marker.

        Parameters
        ----------
        marker : str
            Name of the marker.

        Returns
        -------
        bool
            Whether the name fits.
        """
        return marker == self.marker or fnmatchcase(marker, self.marker.replace("[", "[[]"))

    def on(self, markers: Iterable[str], start: int, stop: int) -> bool:
        """Check whether the decision is about a stretch of one of several markers.

        Parameters
        ----------
        markers : iterable of str
            Names of the markers.
        start, stop : int
            First frame, and the frame after the last.

        Returns
        -------
        bool
            Whether any of the names fits and any frame is shared.
        """
        return start < self.stop and self.start < stop and any(map(self.matches, markers))


def read(entries: Iterable[Mapping[str, Any]], first_frame: int) -> list[Decision]:
    """Make the decisions on one recording from their JSON values.

    Parameters
    ----------
    entries : iterable of mapping
        The decisions, with frames in the capture program's numbering, both part of the stretch.
    first_frame : int
        The capture program's number of row 0.

    Returns
    -------
    list of Decision
        The decisions in the same order.
    """
    return [
        Decision(
            entry["marker"],
            entry["first_frame"] - first_frame if "first_frame" in entry else -EVER,
            entry["last_frame"] - first_frame + 1 if "last_frame" in entry else EVER,
            entry["decision"],
            *(entry.get(name, "") for name in ("value", "note", "by", "date")),
        )
        for entry in entries
    ]


def protecting(patterns: Iterable[str]) -> list[Decision]:
    """Make the decisions that stand for the option `protect`.

    Parameters
    ----------
    patterns : iterable of str
        Names of markers that are never touched, with * and ?.

    Returns
    -------
    list of Decision
        One for each pattern, about all frames.
    """
    return [Decision(pattern, -EVER, EVER, "protect", person=False) for pattern in patterns]


def accepting(kinds: Iterable[str]) -> list[Decision]:
    """Make the decisions that stand for an option by which findings are repaired that are else only reported.

    Parameters
    ----------
    kinds : iterable of str
        The classes.

    Returns
    -------
    list of Decision
        One for each class, about all markers and frames.
    """
    return [Decision("*", -EVER, EVER, "accept", kind, person=False) for kind in kinds]
