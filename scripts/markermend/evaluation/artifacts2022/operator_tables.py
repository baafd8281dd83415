"""What persons found in recordings: tables of decisions, or of findings (skurowski2022, E2)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from markermend import api
from markermend.core.artifacts import BY_NAME
from markermend.core.changes import GAP
from markermend.core.decisions import EVER
from markermend.core.events import Event
from markermend.core.recording import Recording
from markermend.export.change_table import COLUMNS as COLUMNS_OF_CHANGES
from markermend.planning.decision_cells import read_class, read_frames
from markermend.planning.decision_table import COLUMNS as COLUMNS_OF_DECISIONS
from markermend.planning.recordings import BadDataSet
from markermend.planning.tables import Problem, read_table
from markermend.storage.folder_names import encode

REQUIRED = ("recording", "marker", "decision")
"""The columns that a table of decisions must have."""

REQUIRED_OF_FINDINGS = ("recording", "marker", "first_frame", "last_frame", "class")
"""The columns that a table of findings must have."""


def read_operator(path: Path, name: str, recording: Recording) -> dict[str, list[Event]]:
    """Read what a person found.

    Parameters
    ----------
    path : Path
        Either a table of decisions (config/README.md), of which the lines `accept` and `class` with a class are what was found, or a table of
        findings: the columns `recording`, `marker`, `first_frame`, `last_frame` and `class`, and those of changes.tsv. In either, the column
        `subject` distinguishes recordings of one name.
    name : str
        The recording as the experiments call it; see experiments.Experiments.named.
    recording : Recording
        The recording.

    Returns
    -------
    dict of str to list of Event
        The findings by detector. Gaps that were filled, lines without a class, decisions without frames, and what begins behind the end of
        the recording, of which only the beginning may be used, are left out.

    Raises
    ------
    BadOptions or BadDataSet
        With lines that mean nothing or contradict each other.
    """
    header = path.read_text(encoding="utf-8-sig").partition("\n")[0]
    columns = [column.strip() for column in re.split("[\t,;]", header)]
    read = _read_findings if "class" in columns else _read_decisions
    found: dict[str, list[Event]] = {}
    for stage, event in read(path, name, recording):
        if event.start < recording.frames:
            found.setdefault(stage, []).append(event)
    return found


def _is_about(row: Mapping[str, str], name: str) -> bool:
    """Whether a line of a table is about a recording, by the name of its folder or with the subject's before it."""
    own = row.get("recording", "")
    folder = encode(own) if own else ""
    return name in (own, folder, f"{encode(row['subject'])}_{folder}" if "subject" in row else folder)


def _read_decisions(path: Path, name: str, recording: Recording) -> Iterator[tuple[str, Event]]:
    """The findings in a table of decisions."""
    rows = read_table(str(path), what="decisions", columns=COLUMNS_OF_DECISIONS, required=REQUIRED)
    lines = [
        {column: text for column, text in row.items() if column not in ("recording", "subject")}
        for _, row in rows
        if _is_about(row, name)
    ]
    for decision in api.read_decisions(lines, recording):
        artifact = BY_NAME.get(decision.value.partition(":")[0])
        if decision.verb not in ("accept", "class") or artifact is None or abs(decision.start) == EVER:
            continue
        for marker in recording.markers:
            if decision.matches(marker):
                yield artifact.stage, Event(marker, decision.start, decision.stop, 1.0)


def _read_findings(path: Path, name: str, recording: Recording) -> Iterator[tuple[str, Event]]:
    """The findings in a table of findings; what is no artifact, such as a filled gap, is left out."""
    columns = (*COLUMNS_OF_CHANGES, "subject")
    for number, row in read_table(str(path), what="findings", columns=columns, required=REQUIRED_OF_FINDINGS):
        try:
            if _is_about(row, name) and (kind := read_class(row)) not in ("", GAP):
                yield BY_NAME[kind].stage, _finding(row, recording)
        except Problem as problem:
            raise BadDataSet(f"findings: {path} line {number}, {problem}") from None


def _finding(row: Mapping[str, str], recording: Recording) -> Event:
    """The finding in a line of a table. Raises Problem."""
    first, last = (frame - recording.first_frame for frame in read_frames(row, required=True).values())
    marker = row.get("marker", "")
    if first < recording.frames and marker not in recording.markers:
        raise Problem("marker", f"{marker!r} is none of the recording" if marker else "is empty")
    if first < 0:
        raise Problem("first_frame", f"the recording begins at {recording.first_frame}")
    return Event(marker, first, last + 1, 1.0)
