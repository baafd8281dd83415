"""The outcomes of a person's decisions: what each did, which did nothing, and lines for new ones."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from typing import Any

from markermend.core.changes import GAP, Change
from markermend.core.decisions import EVER, Decision, read
from markermend.core.recording import Recording
from markermend.storage import tab_separated


@dataclass(frozen=True)
class DecisionOutcome:
    """The outcome of a decision.

    Attributes
    ----------
    place : str
        Marker and frames as in the table of decisions.
    text : str
        The decision in the words of the table, and why.
    by, date : str
        By whom it was made, and on which day; empty where nobody says so.
    settled : int
        How many findings and gaps it settled.
    warning : str or None
        What is wrong with it, None where nothing is.
    """

    place: str
    text: str
    by: str
    date: str
    settled: int
    warning: str | None


def outcomes(
    entries: Iterable[Mapping[str, Any]], result: Recording, changes: Sequence[Change]
) -> list[DecisionOutcome]:
    """Give the outcome of each decision on a recording.

    Parameters
    ----------
    entries : Iterable[Mapping[str, Any]]
        As decision_table.load gives them.
    result : Recording
        The recording after repair and filling.
    changes : sequence of Change
        What these did.

    Returns
    -------
    list of DecisionOutcome
        One for each decision.
    """
    decided = read(entries, result.first_frame)
    return [_outcome(decision, result, changes) for decision in decided]


def _outcome(decision: Decision, result: Recording, changes: Sequence[Change]) -> DecisionOutcome:
    """The outcome of one decision."""
    settled = sum(
        decision.words in change.decisions
        and decision.on({change.marker, change.partner or change.marker}, change.start, change.stop)
        for change in changes
    )
    place = _place(decision, result.first_frame)
    wrong = None if settled else _nothing(decision, result)
    warning = wrong and f"decision {decision.text!r} on {place}: {wrong}"
    text = replace(decision, by="", date="").words
    return DecisionOutcome(place, text, decision.by, decision.date, settled, warning)


def judged(decided: Iterable[DecisionOutcome], findings: Iterable[Change]) -> dict[str, Any]:
    """Say how much persons judged, and who.

    Parameters
    ----------
    decided : iterable of DecisionOutcome
        The outcomes of the decisions.
    findings : iterable of Change
        What was changed and what was left, a joint finding as one.

    Returns
    -------
    dict of str to Any
        `events`, the number of findings and gaps on which any decision bears; the names `by` whom, and the `dates` on which, those decisions
        were made that settled any.
    """
    settling = [outcome for outcome in decided if outcome.settled]
    return {
        "events": sum(bool(finding.decisions) for finding in findings),
        "by": sorted({outcome.by for outcome in settling} - {""}),
        "dates": sorted({outcome.date for outcome in settling} - {""}),
    }


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
    """Marker and frames of a decision, in the capture program's numbering."""
    if decision.start == -EVER:
        return decision.marker
    return f"{decision.marker}, frames {decision.start + first_frame} to {decision.stop + first_frame - 1}"


def drafts(findings: Sequence[Change], recording: Recording) -> str:
    """Write lines for the table of decisions, in which the decisions are still to be written.

    Parameters
    ----------
    findings : sequence of Change
        The findings.
    recording : Recording
        The recording that they are in.

    Returns
    -------
    str
        One line for each finding, in the format of the table.
    """
    rows = []
    name, subject = recording.facts.get("recording", ""), recording.facts.get("subject", "")
    for finding in findings:
        first, last = finding.start + recording.first_frame, finding.stop + recording.first_frame - 1
        value = GAP if finding.is_gap else ""
        rows.append([name, finding.marker, first, last, "", value, "", subject, "", ""])
    return tab_separated.lines(rows)
