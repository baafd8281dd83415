"""The table of a person's decisions: read, held against the recordings, and handed out to them.

A table with a line that cannot be understood is refused as a whole, with file, line and column of every problem.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from markermend.planning.contradictions import Line, find_contradictions
from markermend.planning.decision_cells import parse
from markermend.planning.recordings import BadDataSet, Entry
from markermend.planning.tables import Problem, read_table, suggestion
from markermend.storage import tab_separated
from markermend.storage.folder_names import readable

COLUMNS = ("recording", "marker", "first_frame", "last_frame", "decision", "value", "note", "subject", "by", "date")
"""Columns of the table, of which the first four are those of changes.tsv; recording, marker and decision are required."""

LARGEST = 100_000
"""Bytes that the decisions on one recording may take: a command line has room for 131,072."""

NONE = tab_separated.table(COLUMNS, ())
"""A table without decisions."""

Folders = tuple[str, str]
"""Names of the folders of a subject and a recording."""


def load(
    path: str, entries: Sequence[Entry], methods: Collection[str]
) -> tuple[dict[Folders, list[dict[str, Any]]], list[str]]:
    """Read the decisions on each recording.

    Parameters
    ----------
    path : str
        The table.
    entries : sequence of Entry
        The recordings.
    methods : Collection[str]
        Names that the decision `method` may give.

    Returns
    -------
    decided : dict of (str, str) to list of dict
        The decisions on each recording as the stages read them, by the names of its folders; the same whatever the
        order of the lines.
    warnings : list of str
        Lines on recordings that are not there: the table may be about more.

    Raises
    ------
    BadDataSet
        Naming every problem: cells that mean nothing, a recording that could be several, decisions that contradict
        each other.
    """
    lines: dict[Folders, list[Line]] = {}
    problems, warnings = [], []
    for number, row in read_table(
        path, what="decisions", columns=COLUMNS, required=("recording", "marker", "decision")
    ):
        try:
            line = Line(number, dict(parse(row, methods)))
            found = _recording_of(row, entries)
        except Problem as problem:
            problems.append(f"line {number}, {problem}")
            continue
        if found is None:
            warnings.append(f"decisions: {path} line {number}: {_absent(row, entries)}")
        else:
            lines.setdefault(found.folders, []).append(line)
    for several in lines.values():
        problems += find_contradictions(several)
    decided = {folders: in_order(several) for folders, several in lines.items()}
    problems += [
        f"{len(objects)} lines on {readable(*folders)} are too many; use patterns and longer stretches"
        for folders, objects in decided.items()
        if len(json.dumps(objects)) > LARGEST
    ]
    if problems:
        raise BadDataSet("\n".join([f"decisions: {path} cannot be used (config/README.md)", *problems]))
    return decided, warnings


def standard_form(path: str, methods: Collection[str]) -> str:
    """Write the table as the report reads it, in which all tables that say the same are equal.

    Parameters
    ----------
    path : str
        The table, which `load` understands.
    methods : Collection[str]
        Names that the decision `method` may give.

    Returns
    -------
    str
        All of its lines in their order, those on recordings that are not there, too: every column, cells by their meaning.
    """
    rows = read_table(path, what="decisions", columns=COLUMNS, required=("recording", "marker", "decision"))
    lines = [dict(dict.fromkeys(COLUMNS, "") | row | {"value": ""} | dict(parse(row, methods))) for _, row in rows]
    return tab_separated.table(COLUMNS, lines)


def _recording_of(row: Mapping[str, str], entries: Sequence[Entry]) -> Entry | None:
    """The recording that a line is about; None where there is none. Raises Problem where it could be several."""
    named = [entry for entry in entries if entry.recording == row["recording"]]
    named = [entry for entry in named if row.get("subject", entry.subject) == entry.subject]
    if len(named) > 1:
        subjects = ", ".join(entry.subject for entry in named)
        raise Problem("subject", f"is empty, and {row['recording']!r} is a recording of {subjects}")
    return named[0] if named else None


def _absent(row: Mapping[str, str], entries: Sequence[Entry]) -> str:
    """Say that there is no such recording, and which may have been meant."""
    subjects = [entry.subject for entry in entries if entry.recording == row["recording"]]
    if subjects:
        return f"subject {row['subject']!r} has no recording {row['recording']!r}, but {', '.join(subjects)} has"
    close = suggestion(row["recording"], {entry.recording for entry in entries})
    return f"no recording {row['recording']!r} among the recordings{close}"


def in_order(lines: Sequence[Line]) -> list[dict[str, Any]]:
    """Put the decisions on a recording in order.

    Parameters
    ----------
    lines
        The lines on the recording.

    Returns
    -------
    list of dict
        The decisions as the stages read them, each once, by marker and frame.
    """
    unique = {line.decision: dict(line.entry) for line in lines}
    return [unique[decision] for decision in sorted(unique)]
