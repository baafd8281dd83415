"""The table changes.tsv: all changes for people, one row each, without most of what was left.

It is only written: programs read the files of changes, which have that, too.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from markermend.core.changes import DECIMALS, Change, Outcome
from markermend.core.recording import Recording
from markermend.core.written import is_reported
from markermend.storage import tab_separated

COLUMNS = (
    "recording", "marker", "first_frame", "last_frame", "start_s", "stop_s", "class", "score", "axes", "partner",
    "method", "samples", "largest_change_mm", "expected_error_mm", "expected_error95_mm", "decision", "alternatives",
    "group", "reason",
)  # fmt: skip
"""The columns of changes.tsv; frames are numbered as in the capture program and both are part of the change."""

FILLED_GAP = "filled"
"""What the column `class` says of a gap that was filled."""


REFUSED = "refused"
"""What the column `method` says of a change that the number format of the file cannot hold: its samples stay as measured."""

REPORTED = "reported"
"""What it says of a finding of a class that is only reported: its samples stay as measured, and the column `reason` says why."""


def change_table(changes: Iterable[Change], recording: Recording) -> str:
    """Write the table of changes.

    Parameters
    ----------
    changes : sequence of Change
        The changes in the order of the rows, as applied or, with the outcome `left`, refused by the file's format or reported.
    recording : Recording
        The recording, whose name, rate and numbering of frames the table uses.

    Returns
    -------
    str
        Tab-separated text with a header. The column `decision` has what a person decided, `alternatives` what each
        method was expected to err by at worst, by name.
    """
    return tab_separated.table(COLUMNS, (_row(change, recording) for change in changes))


def _row(change: Change, recording: Recording) -> dict[str, Any]:
    """One row of the table. Axes and partner are stated of repairs alone: what was taken away concerns all axes."""
    repaired = change.outcome in (Outcome.REPAIRED, Outcome.EXCHANGED, Outcome.ADOPTED, Outcome.LEFT)
    alternatives = sorted(change.alternatives, key=lambda other: other.method)
    return {
        "recording": recording.facts.get("recording", ""),
        "marker": change.marker,
        "first_frame": recording.first_frame + change.start,
        "last_frame": recording.first_frame + change.stop - 1,
        "start_s": round(change.start / recording.rate, 4),
        "stop_s": round(change.stop / recording.rate, 4),
        "class": FILLED_GAP if change.is_gap else change.kind,
        "score": _figure(change.score),
        "axes": change.axes if repaired else "",
        "partner": (change.partner or "") if repaired else "",
        "method": _method(change),
        "samples": change.samples,
        "largest_change_mm": _figure(change.largest_change_mm),
        "expected_error_mm": _figure(change.expected_error_mm),
        "expected_error95_mm": _figure(change.expected_error95_mm),
        "decision": "; ".join(change.decisions),
        "alternatives": "; ".join(f"{other.method} {other.expected_error_mm:.1f} mm" for other in alternatives),
        "group": change.group or "",
        "reason": change.reason.text if change.reason and is_reported(change) else "",
    }


def _method(change: Change) -> str:
    """What replaced the samples, or why none did."""
    if change.outcome is Outcome.LEFT:
        return REPORTED if is_reported(change) else REFUSED
    return change.method or change.outcome


def _figure(value: float | None) -> float | str:
    """A figure for people, empty where there is none."""
    return "" if value is None else round(value, DECIMALS)
