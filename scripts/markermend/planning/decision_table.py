"""The table of a person's decisions: read, held against the recordings, and handed out to them.

A table that cannot mean what somebody wanted is refused as a whole, with file, line and column of every problem.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from itertools import combinations
from typing import Any

from markermend.core.artifacts import ARTIFACTS, STAGE_OF
from markermend.core.changes import GAP
from markermend.core.decisions import LEAVE, VERBS, Decision, read
from markermend.planning.recordings import BadDataSet, Entry, read_table

COLUMNS = ("recording", "marker", "first_frame", "last_frame", "decision", "value", "note", "subject")
"""Columns of the table, of which the first four are those of changes.tsv; recording, marker and decision are required."""

METHOD_NAMES = {"swap": "exchange"}
"""Methods that changes.tsv calls otherwise than the config."""

NAMES = {**{artifact.stage: artifact.name for artifact in ARTIFACTS}, "filled": GAP}
"""Classes by the names of their detectors, and what changes.tsv calls a gap that was filled."""

LARGEST = 100_000
"""Bytes that the decisions on one recording may take: a command line has room for 131,072."""

Folders = tuple[str, str]
"""Names of the folders of a subject and a recording."""


class Problem(Exception):
    """What is wrong with a line; raised with its column and what is wrong there."""


@dataclass(frozen=True)
class Line:
    """A line of the table: its number, and the decision as the stages read it."""

    number: int
    entry: Mapping[str, Any]

    @property
    def decision(self) -> Decision:
        """What it decides, over the capture program's frames."""
        return read([self.entry], first_frame=0)[0]


def load(
    path: str, entries: Sequence[Entry], methods: Collection[str]
) -> tuple[dict[Folders, list[dict[str, Any]]], list[str]]:
    """Read the decisions on each recording, by its folders, and what to warn of.

    entries: the recordings. methods: the names that `method` may give. The result is the same whatever the order of the
    lines. Raises BadDataSet naming every problem: cells that mean nothing, a recording that could be several,
    decisions that contradict each other. A recording that is not there is a warning: the table may be about more.
    """
    lines: dict[Folders, list[Line]] = {}
    problems, warnings = [], []
    for number, row in read_table(
        path, what="decisions", columns=COLUMNS, required=("recording", "marker", "decision")
    ):
        try:
            line = Line(number, dict(parse(row, methods)))
            found = recordings_of(row, entries)
        except Problem as problem:
            column, text = problem.args
            problems.append(f"line {number}, column {column}: {text}")
            continue
        if found is None:
            warnings.append(f"decisions: {path} line {number}: {absent(row, entries)}")
        else:
            lines.setdefault(found.folders, []).append(line)
    for several in lines.values():
        problems += contradictions(several)
    decided = {folders: in_order(several) for folders, several in lines.items()}
    problems += [
        f"{len(objects)} lines on {'/'.join(folders)} are too many; use patterns and longer stretches"
        for folders, objects in decided.items()
        if len(json.dumps(objects)) > LARGEST
    ]
    if problems:
        raise BadDataSet("\n".join([f"decisions: {path} cannot be used (config/README.md)", *problems]))
    return decided, warnings


def parse(row: Mapping[str, str], methods: Collection[str]) -> Iterator[tuple[str, Any]]:
    """The parts of a decision as the stages read it, without those that say nothing. Raises Problem."""
    for column in ("recording", "marker", "decision"):
        if column not in row:
            raise Problem(column, "is empty")
    if row["decision"] not in VERBS:
        raise Problem("decision", unknown(row["decision"], VERBS))
    yield "marker", row["marker"]
    yield "decision", row["decision"]
    frames = {column: whole(column, row[column]) for column in ("first_frame", "last_frame") if column in row}
    if len(frames) == 1:
        (column,) = {"first_frame", "last_frame"} - set(frames)
        raise Problem(column, "is empty: give both frames, or neither for the whole recording")
    if frames and frames["first_frame"] > frames["last_frame"]:
        raise Problem("last_frame", f"{frames['last_frame']} comes before the first, {frames['first_frame']}")
    if row["decision"] == "class" and not frames:
        raise Problem("first_frame", "is empty: an artifact has a first and a last frame")
    yield from frames.items()
    if value := value_of(row, methods):
        yield "value", value
    if "note" in row:
        yield "note", " ".join(row["note"].split())


def value_of(row: Mapping[str, str], methods: Collection[str]) -> str:
    """What the column value says to this decision. Raises Problem."""
    verb, value = row["decision"], row.get("value", "")
    value = METHOD_NAMES.get(value, value) if verb == "method" else NAMES.get(value, value)
    if verb in ("protect", "missing") and value:
        raise Problem("value", f"{value!r}: {verb} takes no value")
    if verb in ("accept", "reject") and value and value not in (*STAGE_OF, GAP):
        raise Problem("value", unknown(value, (*STAGE_OF, GAP)))
    if verb == "method" and value not in (LEAVE, *methods):
        raise Problem("value", unknown(value, (LEAVE, *methods)))
    if verb == "class":
        kind, _, partner = value.partition(":")
        if (kind, partner) == ("swap", "") or (kind == "swap" and set("*?") & set(row["marker"])):
            raise Problem(
                "value", f"{value!r}: a swap is between two markers, write one as the marker and swap:OTHER here"
            )
        if kind not in STAGE_OF or (partner and kind != "swap"):
            raise Problem("value", unknown(value, [kind for kind in STAGE_OF if kind != "swap"] + ["swap:OTHER"]))
        if partner == row["marker"]:
            raise Problem("value", f"{value!r}: the other marker is the same")
    return value


def whole(column: str, text: str) -> int:
    """Read a whole number. Raises Problem."""
    try:
        return int(text)
    except ValueError:
        raise Problem(column, f"{text!r} is not a frame number") from None


def unknown(word: str, known: Collection[str]) -> str:
    """Say that a word is none of those known, and which was meant."""
    return f"{word!r} is none of {', '.join(known)}{suggestion(word, known)}"


def suggestion(word: str, known: Collection[str]) -> str:
    """Ask whether a similar word was meant, if there is one."""
    close = get_close_matches(word, sorted(known), n=1)
    return f"; did you mean {close[0]!r}?" if close else ""


def recordings_of(row: Mapping[str, str], entries: Sequence[Entry]) -> Entry | None:
    """The recording that a line is about; None where there is none. Raises Problem where it could be several."""
    named = [entry for entry in entries if entry.recording == row["recording"]]
    named = [entry for entry in named if row.get("subject", entry.subject) == entry.subject]
    if len(named) > 1:
        subjects = ", ".join(entry.subject for entry in named)
        raise Problem("subject", f"is empty, and {row['recording']!r} is a recording of {subjects}")
    return named[0] if named else None


def absent(row: Mapping[str, str], entries: Sequence[Entry]) -> str:
    """Say that there is no such recording, and which may have been meant."""
    subjects = [entry.subject for entry in entries if entry.recording == row["recording"]]
    if subjects:
        return f"subject {row['subject']!r} has no recording {row['recording']!r}, but {', '.join(subjects)} has"
    close = suggestion(row["recording"], {entry.recording for entry in entries})
    return f"no recording {row['recording']!r} among the recordings{close}"


def in_order(lines: Sequence[Line]) -> list[dict[str, Any]]:
    """The decisions on a recording, each once, by marker and frame."""
    unique = {line.decision: dict(line.entry) for line in lines}
    return [unique[decision] for decision in sorted(unique)]


def contradictions(lines: Sequence[Line]) -> Iterator[str]:
    """Say which lines on one recording contradict each other."""
    numbered = [(line.number, line.decision) for line in lines]
    for (one, a), (other, b) in combinations(numbered, 2):
        if a.start < b.stop and b.start < a.stop and clash(a, b) and meet(a.marker, b.marker):
            yield f"lines {one} and {other} contradict each other: {a.marker} {a.text}, {b.marker} {b.text}"


def clash(one: Decision, other: Decision) -> bool:
    """Whether two decisions on the same samples cannot both be followed; protect wins, so it never clashes."""
    verbs = {one.verb, other.verb}
    if "protect" in verbs:
        return False
    if len(verbs) == 1:
        return verbs <= {"class", "method"} and one.value != other.value
    if "method" in verbs:
        return LEAVE in (one.value, other.value) and not verbs.isdisjoint({"accept", "class"})
    return not one.kinds.isdisjoint(other.kinds)


@cache
def meet(one: str, other: str) -> bool:
    """Whether some name fits both patterns with * and ?."""
    if not one and not other:
        return True
    if other.startswith("*") and not one.startswith("*"):
        one, other = other, one
    if one.startswith("*"):
        return meet(one[1:], other) or (other != "" and meet(one, other[1:]))
    alike = one != "" and other != "" and (one[0] == other[0] or "?" in (one[0], other[0]))
    return alike and meet(one[1:], other[1:])
