"""One line for each finding of a recording: its number, the values before and after, and what a person may decide about it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend.core.artifacts import BY_NAME
from markermend.core.changes import DECLARED_MISSING, GAP, Change
from markermend.core.decisions import LEAVE
from markermend.core.recording import Recording, Restored
from markermend.planning.decision_cells import STATED
from markermend.report.open_findings import markers_of

BLANK = "blank"
"""The method that takes samples away, to be filled as a gap; it can be used on any artifact but labels."""

LABELS = "labels"
"""The stage that finds samples under wrong labels, which nothing but an exchange repairs."""


@dataclass(frozen=True)
class FindingLine:
    """A finding as the page of a recording lists it.

    Attributes
    ----------
    number : int
        Its number on the page, from 0.
    change : Change
        What was found, and what was done about it.
    plotted : bool
        Whether the page has a plot of it.
    row : int or None
        Where its values are stated, as a row counted from 0: at the largest change, else at the largest expected error, else halfway; None
        for a gap that stayed.
    before, after : tuple of float, or None
        Position of the marker there before and after cleaning, mm; None where it is missing.
    """

    number: int
    change: Change
    plotted: bool
    row: int | None
    before: tuple[float, ...] | None
    after: tuple[float, ...] | None

    @property
    def name(self) -> str:
        """Its name in links and in the data of the page."""
        return f"finding-{self.number}"


def finding_lines(
    changes: Sequence[Change], left: Sequence[Change], before: Recording, after: Restored, *, plots: int
) -> tuple[list[FindingLine], list[FindingLine]]:
    """Make the lines of all findings.

    Parameters
    ----------
    changes, left : sequence of Change
        What was changed and what was left, worst first.
    before, after : Recording
        The recording as ingested and as cleaned.
    plots : int
        How many of each have a plot, at most; gaps that stayed have none.

    Returns
    -------
    changed, left : list of FindingLine
        The lines, numbered through.
    """

    def line(number: int, change: Change, plotted: bool) -> FindingLine:
        row = stated_row(change, before, after)
        values = [_position(recording, change.marker, row) for recording in (before, after)]
        return FindingLine(number, change, plotted, row, values[0], values[1])

    changed = [line(number, change, number < plots) for number, change in enumerate(changes)]
    artifacts = [change for change in left if not change.is_gap][:plots]
    stayed = [
        line(len(changes) + number, change, number < len(artifacts) and not change.is_gap)
        for number, change in enumerate(left)
    ]
    return changed, stayed


def stated_row(change: Change, before: Recording, after: Restored) -> int | None:
    """Choose where the values of a finding are stated.

    Parameters
    ----------
    change : Change
        The finding.
    before, after : Recording
        The recording as ingested and as cleaned.

    Returns
    -------
    int or None
        See `FindingLine.row`.
    """
    span, m = slice(change.start, change.stop), before.markers.index(change.marker)
    distance = np.linalg.norm(after.positions[span, m] - before.positions[span, m], axis=1)
    error = np.where(after.missing[span, m], np.nan, after.error[span, m])
    for values in (distance, error):
        if np.nanmax(values, initial=0.0) > 0:
            return change.start + int(np.nanargmax(values))
    seen = np.flatnonzero(~before.missing[span, m])
    return change.start + int(seen[len(seen) // 2]) if len(seen) else None


def _position(recording: Recording, marker: str, row: int | None) -> tuple[float, ...] | None:
    """Position of a marker in a row, mm; None where it is missing."""
    if row is None:
        return None
    values = recording.positions[row, recording.markers.index(marker)]
    return None if np.isnan(values).any() else tuple(map(float, values))


def decidable(
    lines: Iterable[FindingLine],
    recording: Recording,
    record: Sequence[Change],
    stages: Mapping[str, Mapping[str, Any]],
) -> dict[str, Any]:
    """State what a person may decide about each finding, for the page to offer it.

    Parameters
    ----------
    lines : iterable of FindingLine
        The findings, by their numbers.
    recording : Recording
        The recording that they are in.
    record : sequence of Change
        What repair and filling did to each stretch.
    stages : mapping of str to mapping
        The options of the stages, which name the usual methods.

    Returns
    -------
    dict of str to Any
        JSON values: the `markers` and the first and last of all `frames` of the recording; the `classes` that a person can state; `findings`, for
        each its `marker`, all `markers` as the table names them, `first_frame`, `last_frame`, `classes`, the `value` with which the table accepts or
        rejects it (None where it cannot), and the `errors` (68 %, mm) of methods that were tried; `methods`, the usual methods by class.
    """
    found, first_frame = [line.change for line in lines], recording.first_frame
    return {
        "markers": list(recording.markers),
        "frames": [first_frame, first_frame + recording.frames - 1],
        "classes": list(STATED),
        "findings": [
            {
                "marker": change.marker,
                "markers": _pattern(markers_of(change, record), recording),
                "first_frame": change.start + first_frame,
                "last_frame": change.stop + first_frame - 1,
                "classes": list(change.classes),
                "value": _value(change.classes),
                "errors": {other.method: other.expected_error_mm for other in change.alternatives},
            }
            for change in found
        ],
        "methods": {
            name: _methods(name, stages) for name in sorted({name for change in found for name in change.classes})
        },
    }


def _pattern(markers: list[str], recording: Recording) -> list[str]:
    """The markers of a finding, or the pattern of all."""
    return ["*"] if len(markers) == len(recording.markers) > 1 else markers


def _value(classes: Sequence[str]) -> str | None:
    """The class that the table names; none for a finding of several, nor for samples that a person declared missing."""
    if DECLARED_MISSING in classes:
        return None
    return classes[0] if len(classes) == 1 else ""


def _methods(name: str, stages: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """The methods that a person may name for findings of a class, gaps, or samples that were declared missing."""
    if name in (GAP, DECLARED_MISSING):
        return [*stages.get("fill", {}).get("members", ()), LEAVE]
    artifact = BY_NAME[name]
    usual = stages.get("repair", {}).get("methods", {}).get(artifact.stage, ())
    if artifact.reported or artifact.stage == LABELS:
        return [*(() if artifact.reported else usual), LEAVE]
    return [*dict.fromkeys((*usual, BLANK)), LEAVE]
