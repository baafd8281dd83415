"""A person's decisions and what they came to, for that person: what each did, which did nothing, and lines for new ones."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from markermend.core.changes import GAP, Change
from markermend.core.decisions import EVER, Decision, read
from markermend.core.recording import Recording


@dataclass(frozen=True)
class DecisionOutcome:
    """What a decision came to: its place and words as the table has them, and how many findings and gaps it settled.

    warning: what is wrong with it, None where nothing is.
    """

    place: str
    text: str
    settled: int
    warning: str | None


def outcomes(
    entries: Iterable[Mapping[str, Any]], result: Recording, changes: Sequence[Change]
) -> list[DecisionOutcome]:
    """Say what came of each decision on a recording.

    entries: as decision_table.load gives them. result: the recording after repair and filling. changes: what these did.
    """
    decided = read(entries, result.first_frame)
    return [_outcome(decision, result, changes) for decision in decided]


def _outcome(decision: Decision, result: Recording, changes: Sequence[Change]) -> DecisionOutcome:
    """Say what came of one decision."""
    settled = sum(
        decision.text in change.decisions
        and decision.on({change.marker, change.partner or change.marker}, change.start, change.stop)
        for change in changes
    )
    place = _place(decision, result.first_frame)
    wrong = None if settled else _nothing(decision, result)
    return DecisionOutcome(place, decision.text, settled, wrong and f"decision {decision.text!r} on {place}: {wrong}")


def _nothing(decision: Decision, result: Recording) -> str | None:
    """Why a decision did nothing; None for a protection, which need not do anything."""
    if not any(map(decision.matches, result.markers)):
        close = get_close_matches(decision.marker, result.markers, n=1)
        return "no such marker" + (f"; did you mean {close[0]}?" if close else "")
    if decision.stop <= 0 or decision.start >= result.frames:
        last = result.first_frame + result.frames - 1
        return f"the recording has frames {result.first_frame} to {last}"
    if decision.verb == "protect":
        return None
    if result.facts.get("kind") == "static":
        return "nothing is done to a static recording"
    if decision.partner and decision.partner not in result.markers:
        return f"no such marker: {decision.partner}"
    return "there is no finding or gap that it changes"


def _place(decision: Decision, first_frame: int) -> str:
    """Where a decision stands, in the capture program's numbering."""
    if decision.start == -EVER:
        return decision.marker
    return f"{decision.marker}, frames {decision.start + first_frame} to {decision.stop + first_frame - 1}"


def drafts(findings: Sequence[Change], recording: Recording) -> str:
    """Lines for the table of decisions, one for each finding, in which the decision is still to be written."""
    text = io.StringIO()
    writer = csv.writer(text, delimiter="\t", lineterminator="\n")
    name, subject = recording.facts.get("recording", ""), recording.facts.get("subject", "")
    for finding in findings:
        first, last = finding.start + recording.first_frame, finding.stop + recording.first_frame - 1
        value = GAP if finding.is_gap else ""
        writer.writerow([name, finding.marker, first, last, "", value, "", subject])
    return text.getvalue()
