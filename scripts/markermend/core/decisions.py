"""What a person decided about a recording, and what that comes to for one finding or gap.

No limit holds against a person's decision; `protect` wins over all others, and `reject` over those that change samples.
Frames are rows counted from 0, half-open; only the table of decisions uses the capture program's numbering.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Any

from markermend.core.artifacts import BY_STAGE, STAGE_OF
from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason

VERBS = ("accept", "reject", "protect", "class", "method", "missing")
"""What a person can decide: that a finding is one, that it is none, that samples stay as they are, that a stretch is an
artifact of a class, how to mend or fill, and that samples count as missing."""

LEAVE = "leave"
"""The method that leaves everything as it is."""

EVER = 2**62
"""A frame before (negative) or after every recording's."""


@dataclass(frozen=True, order=True)
class Decision:
    """One decision on the markers of a name, or a pattern with * and ?, over [start, stop).

    verb: one of VERBS. value: a class (`swap:PARTNER` for a swap that was not found) or a method. note: the person's
    reason. person: False where a setting says so and not a person.
    """

    marker: str
    start: int
    stop: int
    verb: str
    value: str = ""
    note: str = ""
    person: bool = True

    @property
    def text(self) -> str:
        """The decision in the words of the table."""
        said = f"{self.verb} {self.value}".rstrip()
        return f"{said} ({self.note})" if self.note else said

    @property
    def reason(self) -> Reason:
        """Why what the decision keeps was kept."""
        if self.person:
            return Reason(Cause.DECIDED, f"a person decided: {self.text}")
        return Reason(Cause.PROTECTED, "protected")

    @property
    def kinds(self) -> frozenset[str]:
        """The classes that it is about; unless it says so, no gap."""
        return frozenset([self.value.partition(":")[0]] if self.value else STAGE_OF)

    @property
    def partner(self) -> str | None:
        """The other marker of a swap that was not found."""
        return self.value.partition(":")[2] or None

    def matches(self, marker: str) -> bool:
        """Whether it is about a marker."""
        return marker == self.marker or fnmatchcase(marker, self.marker.replace("[", "[[]"))

    def on(self, markers: Iterable[str], start: int, stop: int) -> bool:
        """Whether it is about any of these markers in any frame of [start, stop)."""
        return start < self.stop and self.start < stop and any(map(self.matches, markers))


@dataclass(frozen=True)
class Ruling:
    """What the decisions come to for one finding or gap.

    left: why it stays as it is, None where nobody says so. confirmed: the limits do not hold. method: the only one to
    use, None: as usual. texts: the decisions that bear on it.
    """

    left: Reason | None = None
    confirmed: bool = False
    method: str | None = None
    texts: tuple[str, ...] = ()


def read(entries: Iterable[Mapping[str, Any]], first_frame: int) -> list[Decision]:
    """Take the decisions on one recording from the objects of decision_table.read.

    first_frame: the capture program's number of row 0.
    """
    return [
        Decision(
            entry["marker"],
            entry["first_frame"] - first_frame if "first_frame" in entry else -EVER,
            entry["last_frame"] - first_frame + 1 if "last_frame" in entry else EVER,
            entry["decision"],
            entry.get("value", ""),
            entry.get("note", ""),
        )
        for entry in entries
    ]


def protecting(patterns: Iterable[str]) -> list[Decision]:
    """What the setting `protect` decides: markers that are never touched."""
    return [Decision(pattern, -EVER, EVER, "protect", person=False) for pattern in patterns]


def kind_of(stage: str, event: Event) -> str:
    """The class of a finding as people name it."""
    return "swap" if event.partner else BY_STAGE[stage].name


def names(event: Event) -> tuple[str, ...]:
    """The markers of a finding: two where labels are swapped."""
    return (event.marker, event.partner) if event.partner else (event.marker,)


def rule(
    decisions: Iterable[Decision],
    kinds: Collection[str],
    markers: Collection[str],
    start: int,
    stop: int,
    methods: Collection[str] | None = None,
) -> Ruling:
    """Tell what the decisions come to for a finding of these classes, or a gap, over [start, stop).

    markers: the finding's, and its partner. methods: those that can be used here, None = any.
    """
    near = [decision for decision in decisions if decision.on(markers, start, stop)]
    against = [d for d in near if d.verb == "protect"]
    against += [d for d in near if d.verb == "reject" and not d.kinds.isdisjoint(kinds)]
    against += [d for d in near if d.verb == "method" and d.value == LEAVE]
    if against:
        return Ruling(against[0].reason, texts=told(against[:1]))
    how = [d for d in near if d.verb == "method" and (methods is None or d.value in methods)]
    backing = [d for d in near if d.verb in ("accept", "class") and not d.kinds.isdisjoint(kinds)] + how
    return Ruling(None, bool(backing), how[0].value if how else None, told(backing))


def told(decisions: Iterable[Decision]) -> tuple[str, ...]:
    """What persons said, each once."""
    return tuple(dict.fromkeys(decision.text for decision in decisions if decision.person))
