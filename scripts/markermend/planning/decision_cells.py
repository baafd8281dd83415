"""One line of the table of decisions: its cells read as the stages take them, or what is wrong with them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from datetime import date
from typing import Any

from markermend.core.artifacts import ARTIFACTS, BY_NAME
from markermend.core.changes import GAP
from markermend.core.decisions import LEAVE, VERBS
from markermend.planning.tables import Problem, unknown_word

STAGES = Counter(artifact.stage for artifact in ARTIFACTS)
"""How many classes each detector finds."""

NAMES = {**{artifact.stage: artifact.name for artifact in ARTIFACTS if STAGES[artifact.stage] == 1}, "filled": GAP}
"""Classes by the names of the detectors that find no other, and what changes.tsv calls a gap that was filled."""

STATED = tuple(name for name, own in BY_NAME.items() if name != "swap" and own.origin != "adopted")
"""The classes that a person can state; as a swap also `swap:OTHER`, between two markers."""

METHOD_NAMES = {"swap": "exchange"}
"""Methods that changes.tsv calls otherwise than the config."""


def parse(row: Mapping[str, str], methods: Collection[str]) -> Iterator[tuple[str, Any]]:
    """Read a decision.

    Parameters
    ----------
    row : mapping of str to str
        The cells that are not empty, by their columns.
    methods : Collection[str]
        Names that the decision `method` may give.

    Yields
    ------
    tuple of (str, Any)
        The parts of the decision as the stages read it, by name; those without a value are left out.

    Raises
    ------
    Problem
        For a cell that means nothing, or that is empty where it must not be.
    """
    for column in ("recording", "marker", "decision"):
        if column not in row:
            raise Problem(column, "is empty")
    if row["decision"] not in VERBS:
        raise Problem("decision", unknown_word(row["decision"], VERBS))
    yield "marker", row["marker"]
    yield "decision", row["decision"]
    yield from read_frames(row, required=row["decision"] == "class").items()
    if value := _value_of(row, methods):
        yield "value", value
    for column in ("note", "by"):
        if column in row:
            yield column, " ".join(row[column].split())
    if "date" in row:
        yield "date", _day(row["date"])


def read_frames(row: Mapping[str, str], *, required: bool) -> dict[str, int]:
    """Read the first and the last frame.

    Parameters
    ----------
    row : mapping of str to str
        The cells that are not empty, by their columns.
    required : bool
        Whether there must be frames; else there may be none, for the whole recording.

    Returns
    -------
    dict of str to int
        The frames by their columns, as the capture program numbers them; both, or none.

    Raises
    ------
    Problem
        For a cell that is no number, or that is empty where it must not be, and for a last frame before the first.
    """
    frames = {column: _whole(column, row[column]) for column in ("first_frame", "last_frame") if column in row}
    if len(frames) == 1:
        (column,) = {"first_frame", "last_frame"} - set(frames)
        raise Problem(column, "is empty: give both frames, or neither for the whole recording")
    if frames and frames["first_frame"] > frames["last_frame"]:
        raise Problem("last_frame", f"{frames['last_frame']} comes before the first, {frames['first_frame']}")
    if required and not frames:
        raise Problem("first_frame", "is empty: an artifact has a first and a last frame")
    return frames


def read_class(row: Mapping[str, str]) -> str:
    """Read the class of a finding.

    Parameters
    ----------
    row : mapping of str to str
        The cells that are not empty, by their columns.

    Returns
    -------
    str
        The class, also where its detector is named; GAP for a gap that was filled; empty where there is none.

    Raises
    ------
    Problem
        For what is no class.
    """
    kind = NAMES.get(row.get("class", ""), row.get("class", ""))
    if kind and kind not in (*BY_NAME, GAP):
        raise Problem("class", unknown_word(kind, (*BY_NAME, GAP)))
    return kind


def _value_of(row: Mapping[str, str], methods: Collection[str]) -> str:
    """Read the value of a decision. Raises Problem."""
    verb, value = row["decision"], row.get("value", "")
    value = METHOD_NAMES.get(value, value) if verb == "method" else NAMES.get(value, value)
    if verb in ("protect", "missing") and value:
        raise Problem("value", f"{value!r}: {verb} takes no value")
    if verb in ("accept", "reject") and value and value not in (*BY_NAME, GAP):
        raise Problem("value", unknown_word(value, (*BY_NAME, GAP)))
    if verb == "method" and value not in (LEAVE, *methods):
        raise Problem("value", unknown_word(value, (LEAVE, *methods)))
    if verb == "class":
        kind, _, partner = value.partition(":")
        if (kind, partner) == ("swap", "") or (kind == "swap" and set("*?") & set(row["marker"])):
            raise Problem(
                "value", f"{value!r}: a swap is between two markers, write one as the marker and swap:OTHER here"
            )
        if kind not in (*STATED, "swap") or (partner and kind != "swap"):
            raise Problem("value", unknown_word(value, [*STATED, "swap:OTHER"]))
        if partner == row["marker"]:
            raise Problem("value", f"{value!r}: the other marker is the same")
    return value


def _whole(column: str, text: str) -> int:
    """Read a whole number. Raises Problem."""
    try:
        return int(text)
    except ValueError:
        raise Problem(column, f"{text!r} is not a frame number") from None


def _day(text: str) -> str:
    """Read a day. Raises Problem."""
    try:
        return date.fromisoformat(text).isoformat()
    except ValueError:
        raise Problem(
            "date", f"{text!r} is no day as in 2026-03-31 (in a spreadsheet: the format YYYY-MM-DD)"
        ) from None
