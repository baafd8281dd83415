"""What cleaning did to a recording, in numbers: what was missing, found, changed and left, and how much attention it wants.

A sample is one marker at one frame. It counts as *changed* where what was written differs from what was measured, bit
for bit: a value that was replaced, a gap that was filled, or a value that was taken away because no repair could be
trusted. Samples of origin `measured` must never be among them; a recording in which they are says so as a warning.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from markermend.core.changes import Change, Outcome
from markermend.core.events import Event, mask
from markermend.core.recording import FILLED, MEASURED, MISSING, ORIGINS, Recording, Restored, changed, gaps

DIGITS = 6
"""Decimals of shares and times, fixed so that equal recordings give equal bytes."""


def largest_change(before: Recording, after: Recording) -> float | None:
    """Largest distance in mm between a measured sample and what replaced it; None where none was replaced."""
    both = changed(before, after) & ~before.missing & ~after.missing
    if not both.any():
        return None
    return round(float(np.linalg.norm(after.positions[both] - before.positions[both], axis=1).max()), 3)


def broken_promises(before: Recording, after: Restored) -> list[str]:
    """Warn where the story of the samples does not fit their values."""
    touched = changed(before, after)
    lied = int((touched & (after.origin == MEASURED)).sum())
    hidden = int(((after.origin == MISSING) != after.missing).sum())
    warnings = []
    if lied:
        warnings.append(f"{lied} samples are marked as measured but differ from the original: do not use this result")
    if hidden:
        warnings.append(f"{hidden} samples are marked as missing but are not, or the other way round")
    return warnings


def per_marker(before: Recording, after: Restored) -> list[dict[str, Any]]:
    """Count for each marker, in the order of the recording, what was missing, what still is, and what was changed.

    Longest gaps in s. Samples by origin: `filled` and `repaired`.
    """
    longest = [dict.fromkeys(before.markers, 0) for _ in range(2)]
    number = Counter(before.markers[m] for m, _, _ in gaps(before))
    for state, recording in zip(longest, (before, after), strict=True):
        for m, start, stop in gaps(recording):
            state[recording.markers[m]] = max(state[recording.markers[m]], stop - start)
    repaired = (after.origin != MEASURED) & (after.origin != MISSING) & (after.origin != FILLED)
    return [
        {
            "marker": marker,
            "gaps": number[marker],
            "missing_share_before": share(before.missing[:, m]),
            "missing_share_after": share(after.missing[:, m]),
            "longest_gap_before_s": round(longest[0][marker] / before.rate, DIGITS),
            "longest_gap_after_s": round(longest[1][marker] / before.rate, DIGITS),
            "filled": int((after.origin[:, m] == FILLED).sum()),
            "repaired": int(repaired[:, m].sum()),
        }
        for m, marker in enumerate(before.markers)
    ]


def summarize(
    *,
    before: Recording,
    after: Restored,
    found: Mapping[str, Sequence[Event]],
    changes: Sequence[Change],
    left: Sequence[Change],
    warnings: Sequence[str],
    weights: Mapping[str, float],
) -> dict[str, Any]:
    """Sum up one recording as JSON values.

    before, after: as ingested, and after repair and filling. found: events by class, for the detectors that ran.
    changes, left: what was changed and what was not; an artifact that a person left is not open. weights: see
    `attention`. NaN samples are missing ones.
    """
    touched = changed(before, after)
    errors = after.error[touched & ~after.missing]
    errors95 = after.error95[touched & ~after.missing]
    gaps_left = [finding for finding in left if finding.is_gap]
    summary: dict[str, Any] = {
        **identity(before.facts),
        "status": status(before.facts, touched),
        "stage": None,
        "reason": None,
        "frames": before.frames,
        "first_frame": before.first_frame,
        "rate": before.rate,
        "duration_s": round(before.frames / before.rate, DIGITS),
        "markers": len(before.markers),
        "missing_share_before": share(before.missing),
        "missing_share_after": share(after.missing),
        "findings": {stage: extent(events, before) for stage, events in found.items()},
        "changed_samples": int(touched.sum()),
        "changed_share": share(touched),
        "origins": {name: int((after.origin == code).sum()) for code, name in enumerate(ORIGINS)},
        **outcomes(changes),
        "findings_open": totals([finding for finding in left if not finding.is_gap and not finding.decisions]),
        "gaps_open": {
            **totals(gaps_left),
            "reasons": dict(Counter(finding.reason.text for finding in gaps_left if finding.reason)),
        },
        "largest_change_mm": largest_change(before, after),
        "expected_error_median_mm": finite(np.median, errors),
        "expected_error_max_mm": finite(np.max, errors),
        "expected_error95_max_mm": finite(np.max, errors95),
        "warnings": [*warnings, *broken_promises(before, after)],
    }
    parts = attention(summary, weights)
    return {**summary, "attention": round(sum(parts.values()), 3), "attention_parts": parts}


def set_aside(facts: Mapping[str, Any], stage: str, reason: str) -> dict[str, Any]:
    """Sum up a recording that was set aside; facts: what ingest found out about it, if it got that far."""
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


def attention(summary: Mapping[str, Any], weights: Mapping[str, float]) -> dict[str, float]:
    """Score how much a recording wants a person's look: points by what they are for, which add up to the score.

    weights: points per percent of the samples changed (`changed_percent`), per percent still missing
    (`missing_percent`), per mm of the largest expected error (`error_mm`), per artifact found but not repaired (`open`)
    and per warning (`warning`). A complete recording that nothing was done to scores 0.
    """
    points = {
        "changed": weights["changed_percent"] * 100 * summary["changed_share"],
        "missing": weights["missing_percent"] * 100 * summary["missing_share_after"],
        "expected error": weights["error_mm"] * (summary["expected_error_max_mm"] or 0.0),
        "artifacts left": weights["open"] * summary["findings_open"]["events"],
        "warnings": weights["warning"] * len(summary["warnings"]),
    }
    return {name: round(value, 3) for name, value in points.items()}


def identity(facts: Mapping[str, Any]) -> dict[str, Any]:
    """Name a recording: its own name, its subject's, its file's, and what kind of recording it is."""
    return {
        "recording": facts.get("recording"),
        "subject": facts.get("subject"),
        "source": facts.get("source", {}).get("name"),
        "kind": facts.get("kind"),
    }


def status(facts: Mapping[str, Any], touched: np.ndarray) -> str:
    """What became of a recording that went through: static, cleaned or unchanged."""
    if facts.get("kind") == "static":
        return "static"
    return "cleaned" if touched.any() else "unchanged"


def extent(events: Sequence[Event], recording: Recording) -> dict[str, int]:
    """How many events there are, and how many samples they cover."""
    return {"events": len(events), "samples": int(mask(events, recording.frames, recording.markers).sum())}


def outcomes(changes: Sequence[Change]) -> dict[str, dict[str, int]]:
    """Count the changes by what was done: gaps `filled`, artifacts `repaired` or `blanked` (taken away)."""
    return {
        "filled": totals([change for change in changes if change.is_gap]),
        "repaired": totals([change for change in changes if not change.is_gap and change.outcome != Outcome.BLANKED]),
        "blanked": totals([change for change in changes if change.outcome == Outcome.BLANKED]),
    }


def totals(findings: Sequence[Change]) -> dict[str, int]:
    """How many findings there are, and how many samples they hold."""
    return {"events": len(findings), "samples": sum(finding.samples for finding in findings)}


def share(where: np.ndarray) -> float:
    """The share of True, 0 where there is nothing to count."""
    return round(float(where.mean()), DIGITS) if where.size else 0.0


def finite(statistic: Any, values: np.ndarray) -> float | None:
    """A statistic of the finite values, to 0.001; None where there are none."""
    kept = values[np.isfinite(values)]
    return round(float(statistic(kept)), 3) if kept.size else None
