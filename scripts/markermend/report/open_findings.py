"""What became of everything that was found: stretches of one marker that were changed, and those that were left as they are.

Frames are rows counted from 0, half-open; only the change log uses the capture program's numbers.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from markermend.core.artifacts import ARTIFACTS
from markermend.core.events import Event
from markermend.core.recording import Recording, gaps

KINDS = {**{artifact.stage: artifact.name for artifact in ARTIFACTS}, "filled": "gap"}
"""What a finding is called where it differs from the name of its stage or origin."""

BLANKED = "blanked"
"""The method of a change that took samples away, since no repair could be trusted."""

UNSTATED = "no reason recorded"
"""The reason of a gap or finding of which no stage said why it stayed."""


@dataclass(frozen=True)
class Finding:
    """One stretch of one marker over [start, stop): a gap or an artifact, and what was done about it.

    kind: "gap" or the class of the artifact. score: in units of the detector's threshold. method: what replaced the
    samples; None where nothing did, and then reason says why. largest_change_mm, expected_error_mm: None where unknown.
    decision: what a person decided about it, empty where nobody did.
    """

    kind: str
    marker: str
    start: int
    stop: int
    score: float | None = None
    axes: str = ""
    partner: str | None = None
    method: str | None = None
    reason: str | None = None
    samples: int = 0
    largest_change_mm: float | None = None
    expected_error_mm: float | None = None
    decision: str = ""

    @property
    def concern_mm(self) -> float:
        """How far in mm the change may be from the truth or from what was measured: what changes are ranked by."""
        return max(self.largest_change_mm or 0.0, self.expected_error_mm or 0.0)


def read_changes(text: str, filled: Recording) -> list[Finding]:
    """Read a change log (the text of changes.tsv), worst first.

    filled: the final trajectories, whose fact `repairs_left` says why an artifact became a gap. Raises KeyError for a
    missing column.
    """
    blanked = [_unrepaired(entry, {}) for entry in filled.facts.get("repairs_left", ()) if entry.get("blanked")]
    rows = csv.DictReader(io.StringIO(text, newline=""), delimiter="\t")
    changes = []
    for row in rows:
        change = _change(row, filled.first_frame)
        why = [f"{old.kind}: {old.reason}" for old in blanked if old.marker == change.marker and overlap(old, change)]
        changes.append(replace(change, reason="; ".join(dict.fromkeys(why)) or None))
    return sorted(changes, key=_worst_first)


def left_open(filled: Recording, found: Mapping[str, Sequence[Event]], changes: Sequence[Finding]) -> list[Finding]:
    """List what was left as it is: artifacts that were not repaired, then gaps that were not filled, worst first.

    filled: the final trajectories, with the facts `repairs_left` and `gaps_left`. found: events by class. A finding that
    no stage accounts for is listed too; one whose samples were taken away is a change, and a gap if it was not filled.
    """
    entries = filled.facts.get("repairs_left", ())
    left = [_unrepaired(entry, found) for entry in entries if not entry.get("blanked")]
    known = _by_marker([*changes, *(_unrepaired(entry, {}) for entry in entries)])
    for stage, events in found.items():
        for event in events:
            if not any(overlap(other, event) for other in known.get(event.marker, ())):
                left.append(_finding(stage, event, UNSTATED))
    left.sort(key=lambda finding: (-(finding.score or 0.0), *_place(finding)))
    return left + open_gaps(filled)


def open_gaps(filled: Recording) -> list[Finding]:
    """List the gaps that are left, longest first, with the reason that the stages gave."""
    reasons: dict[str, list[Mapping[str, Any]]] = {}
    for entry in filled.facts.get("gaps_left", ()):
        reasons.setdefault(entry["marker"], []).append(entry)
    found = []
    for m, start, stop in gaps(filled):
        marker = filled.markers[m]
        why = [e["reason"] for e in reasons.get(marker, ()) if e["start"] < stop and start < e["stop"]]
        found.append(Finding("gap", marker, start, stop, reason=why[0] if why else UNSTATED, samples=stop - start))
    return sorted(found, key=lambda finding: (-finding.samples, *_place(finding)))


def overlap(one: Finding, other: Finding | Event) -> bool:
    """Tell whether two stretches share a frame."""
    return one.start < other.stop and other.start < one.stop


def _change(row: Mapping[str, str], first_frame: int) -> Finding:
    """Read one row of the change log."""
    return Finding(
        kind=KINDS.get(row["class"], row["class"]),
        marker=row["marker"],
        start=int(row["first_frame"]) - first_frame,
        stop=int(row["last_frame"]) - first_frame + 1,
        score=_number(row["score"]),
        axes=row["axes"],
        partner=row["partner"] or None,
        method=row["method"],
        samples=int(row["samples"]),
        largest_change_mm=_number(row["largest_change_mm"]),
        expected_error_mm=_number(row["expected_error_mm"]),
        decision=row["decision"],
    )


def _unrepaired(entry: Mapping[str, Any], found: Mapping[str, Iterable[Event]]) -> Finding:
    """Make a finding of an artifact that was left, with the evidence of the event that found it."""
    place = (entry["marker"], entry["start"], entry["stop"])
    kinds = [KINDS.get(kind, kind) for kind in entry["class"].split("+")]
    bare = Finding(
        "+".join(kinds),
        *place,
        score=entry.get("score"),
        reason=entry["reason"],
        samples=entry["stop"] - entry["start"],
        decision="; ".join(entry.get("decisions", ())),
    )
    for stage, events in found.items():
        for event in events:
            if KINDS.get(stage, stage) in kinds and event.marker == bare.marker and overlap(bare, event):
                return replace(bare, score=event.score, axes=event.axes, partner=event.partner)
    return bare


def _by_marker(findings: Iterable[Finding]) -> dict[str, list[Finding]]:
    """Sort findings into lists by marker."""
    lists: dict[str, list[Finding]] = {}
    for finding in findings:
        lists.setdefault(finding.marker, []).append(finding)
    return lists


def _finding(stage: str, event: Event, reason: str) -> Finding:
    """Make a finding of an event that led to no change."""
    kind, samples = KINDS.get(stage, stage), event.stop - event.start
    place = (event.marker, event.start, event.stop)
    return Finding(kind, *place, event.score, event.axes, event.partner, reason=reason, samples=samples)


def _number(text: str) -> float | None:
    """Read a number; an empty cell or `nan` is None."""
    value = float(text) if text else float("nan")
    return None if value != value else value


def _place(finding: Finding) -> tuple[str, int]:
    """Where a finding is: what ties are broken by."""
    return finding.marker, finding.start


def _worst_first(finding: Finding) -> tuple[float, str, int]:
    """Sort key of changes."""
    return (-finding.concern_mm, *_place(finding))
