"""What cleaning did to a recording, in numbers: what was missing, found, changed and left.

A sample is one marker at one frame. It counts as *changed* where what was written differs from what was measured, bit
for bit: a value that was replaced, a gap that was filled, or a value that was taken away because no repair was reliable.
Samples of origin `measured` must never be among them; a recording in which they are carries a warning.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from markermend.core.changes import Change, Outcome
from markermend.core.events import Event
from markermend.core.recording import ORIGINS, Recording, Restored, changed, gaps
from markermend.report.sample_statistics import (
    DIGITS,
    extent,
    finite,
    inconsistent_origins,
    largest_change,
    longest_gaps,
    share,
)


def summarize(
    *,
    before: Recording,
    after: Restored,
    found: Mapping[str, Sequence[Event]],
    changes: Sequence[Change],
    left: Sequence[Change],
    warnings: Sequence[str],
    unjudged: Sequence[str] = (),
) -> dict[str, Any]:
    """Summarize one recording; `attention.with_attention` adds the score of its need of attention.

    Parameters
    ----------
    before, after : Recording
        The recording as ingested, and after repair and filling; NaN = missing.
    found : Mapping[str, Sequence[Event]]
        Events by class, for the detectors that ran.
    changes, left : sequence of Change
        What was changed and what was not; an artifact that a person left is not open.
    warnings : sequence of str
        What the stages warned of.
    unjudged : sequence of str
        The markers that no detector could judge.

    Returns
    -------
    dict of str to Any
        JSON values.
    """
    differs = changed(before, after)
    longest = [max((stop - start for _, start, stop in gaps(own)), default=0) for own in (before, after)]
    gaps_left = [finding for finding in left if finding.is_gap]
    return {
        **identity(before.facts),
        "status": status(before.facts, differs),
        "stage": None,
        "reason": before.facts.get("kind_reason") if before.facts.get("kind") == "static" else None,
        **size(before),
        "markers_never_seen": int(before.missing.all(axis=0).sum()),
        "missing_share_before": share(before.missing),
        "missing_share_after": share(after.missing),
        **longest_gaps(longest[0], longest[1], before.rate),
        "findings": {stage: extent(events, before) for stage, events in found.items()},
        "changed_samples": int(differs.sum()),
        "changed_share": share(differs),
        "origins": {name: int((after.origin == code).sum()) for code, name in enumerate(ORIGINS)},
        **outcomes(changes),
        "findings_open": totals([finding for finding in left if not finding.is_gap and not finding.decisions]),
        "gaps_open": {
            **totals(gaps_left),
            "reasons": dict(Counter(finding.reason.text for finding in gaps_left if finding.reason)),
        },
        "largest_change_mm": largest_change(before, after),
        **expected_errors(after, differs & ~after.missing),
        "unjudged": list(unjudged),
        "warnings": [*warnings, *inconsistent_origins(before, after)],
    }


def size(recording: Recording) -> dict[str, float]:
    """State the size of a recording.

    Parameters
    ----------
    recording : Recording
        The recording.

    Returns
    -------
    dict of str to float
        Number of frames, number of the first frame, rate in Hz, duration in s, and number of markers.
    """
    return {
        "frames": recording.frames,
        "first_frame": recording.first_frame,
        "rate": recording.rate,
        "duration_s": round(recording.frames / recording.rate, DIGITS),
        "markers": len(recording.markers),
    }


def expected_errors(after: Restored, written: np.ndarray) -> dict[str, float | None]:
    """State the errors to be expected of the samples that were written.

    Parameters
    ----------
    after : Restored
        The recording after repair and filling.
    written : ndarray of bool, shape (frames, markers)
        The samples that were replaced or filled.

    Returns
    -------
    dict of str to float or None
        Median and largest radius for probability 0.68, and the largest for 0.95, in mm; None where nothing was written.
    """
    return {
        "expected_error_median_mm": finite(np.median, after.error[written]),
        "expected_error_max_mm": finite(np.max, after.error[written]),
        "expected_error95_max_mm": finite(np.max, after.error95[written]),
    }


def set_aside(facts: Mapping[str, Any], stage: str, reason: str) -> dict[str, Any]:
    """Summarize a recording that was set aside.

    Parameters
    ----------
    facts : mapping of str to Any
        What ingest found out about it, if it got that far.
    stage, reason : str
        The stage that set it aside, and why.

    Returns
    -------
    dict of str to Any
        JSON values.
    """
    return {
        **identity(facts),
        "status": "set aside",
        "stage": stage,
        "reason": reason,
        "frames": facts.get("frames"),
        "rate": facts.get("rate"),
        "markers": len(facts["markers"]) if "markers" in facts else None,
        "warnings": list(facts.get("warnings", ())),
    }


def identity(facts: Mapping[str, Any]) -> dict[str, Any]:
    """Name a recording.

    Parameters
    ----------
    facts : mapping of str to Any
        Of the recording.

    Returns
    -------
    dict of str to Any
        Names of recording, subject and file, and the kind of recording.
    """
    return {
        "recording": facts.get("recording"),
        "subject": facts.get("subject"),
        "source": facts.get("source", {}).get("name"),
        "kind": facts.get("kind"),
    }


def status(facts: Mapping[str, Any], differs: np.ndarray) -> str:
    """Give the status of a recording that was not set aside.

    Parameters
    ----------
    facts : mapping of str to Any
        Of the recording.
    differs : ndarray of bool
        Which samples were changed.

    Returns
    -------
    str
        static, cleaned or unchanged.
    """
    if facts.get("kind") == "static":
        return "static"
    return "cleaned" if differs.any() else "unchanged"


def outcomes(changes: Sequence[Change]) -> dict[str, dict[str, int]]:
    """Count changes by what was done.

    Parameters
    ----------
    changes : sequence of Change
        What was changed.

    Returns
    -------
    dict[str, dict[str, int]]
        Under `filled` gaps, under `repaired` and `blanked` artifacts that were repaired or taken away.
    """
    return {
        "filled": totals([change for change in changes if change.is_gap]),
        "repaired": totals([change for change in changes if not change.is_gap and change.outcome != Outcome.BLANKED]),
        "blanked": totals([change for change in changes if change.outcome == Outcome.BLANKED]),
    }


def totals(findings: Sequence[Change]) -> dict[str, int]:
    """Count findings and the samples that they hold.

    Parameters
    ----------
    findings : sequence of Change
        The findings.

    Returns
    -------
    dict of str to int
        Under the keys `events` and `samples`.
    """
    return {"events": len(findings), "samples": sum(finding.samples for finding in findings)}
