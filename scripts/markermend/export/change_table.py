"""changes.tsv: the list of changes for a person, one row each."""

from __future__ import annotations

import csv
import io
from typing import Any

import numpy as np

from markermend.core.recording import FILLED, Recording, Restored, changed
from markermend.numerics.intervals import runs

COLUMNS = (
    "recording", "marker", "first_frame", "last_frame", "start_s", "stop_s", "class", "score", "axes", "partner",
    "method", "samples", "largest_change_mm", "expected_error_mm", "decision", "alternatives",
)  # fmt: skip
"""The columns of changes.tsv; frames are numbered as in the capture program and both are part of the change."""


def list_changes(measured: Recording, restored: Restored) -> list[dict[str, Any]]:
    """One row per change (COLUMNS), by marker and frame: repairs and fills, what was blanked, and their figures.

    The facts of the restored recording name the changes (`repairs`, `repairs_left`, `fills`). Where measured samples
    were blanked and then filled, the row has the class and evidence of the finding and the method of the fill. The
    column decision has what a person decided about it, alternatives what each method was expected to err by at worst.
    """
    differs, facts = changed(measured, restored), restored.facts
    filled = restored.origin == FILLED
    blanked = [left for left in facts.get("repairs_left", []) if left.get("blanked")]
    rows = []
    for repair in [*facts.get("repairs", []), *({**left, "method": "blanked"} for left in blanked)]:
        m, span = restored.markers.index(repair["marker"]), slice(repair["start"], repair["stop"])
        own = np.zeros(restored.frames, bool)
        own[span] = differs[span, m] & ~filled[span, m]
        if own.any():
            rows.append(_row(measured, restored, repair, m, repair["start"], repair["stop"], own))
    for fill in facts.get("fills", []):
        m = restored.markers.index(fill["marker"])
        for was_seen in (False, True):
            own = np.zeros(restored.frames, bool)
            own[fill["start"] : fill["stop"]] = True
            own &= differs[:, m] & filled[:, m] & (measured.missing[:, m] != was_seen)
            for start, stop in runs(own):
                found = _finding(blanked, fill["marker"], start) if was_seen else {"class": "filled"}
                told = [*found.get("decisions", ()), *fill.get("decisions", ())]
                change = {**fill, **found, "decisions": list(dict.fromkeys(told))}
                rows.append(_row(measured, restored, change, m, start, stop, own))
    return sorted(rows, key=lambda row: (row["marker"], row["first_frame"], row["class"]))


def _finding(blanked: list[dict[str, Any]], marker: str, frame: int) -> dict[str, Any]:
    """Class, score, decisions and offered repairs of the finding for which a measured sample was blanked."""
    covering = (left for left in blanked if left["marker"] == marker and left["start"] <= frame < left["stop"])
    return {
        key: value for key, value in next(covering).items() if key in ("class", "score", "decisions", "alternatives")
    }


def _row(
    measured: Recording, restored: Restored, change: dict[str, Any], m: int, start: int, stop: int, own: np.ndarray
) -> dict[str, Any]:
    """One row of changes.tsv, its figures over the samples `own` (frames,) in [start, stop)."""
    span = np.flatnonzero(own[start:stop]) + start
    moved = np.linalg.norm(restored.positions[span, m] - measured.positions[span, m], axis=1)
    error = restored.error[span, m]
    return {
        "recording": restored.facts.get("recording", ""),
        "marker": change["marker"],
        "first_frame": restored.first_frame + start,
        "last_frame": restored.first_frame + stop - 1,
        "start_s": round(start / restored.rate, 4),
        "stop_s": round(stop / restored.rate, 4),
        "class": change["class"],
        "score": _rounded(change.get("score")),
        "axes": change.get("axes") or "",
        "partner": change.get("partner") or "",
        "method": change["method"],
        "samples": len(span),
        "largest_change_mm": _rounded(np.nanmax(moved) if np.isfinite(moved).any() else None),
        "expected_error_mm": _rounded(np.nanmax(error) if np.isfinite(error).any() else None),
        "decision": "; ".join(change.get("decisions", ())),
        "alternatives": "; ".join(f"{name} {mm:.1f} mm" for name, mm in change.get("alternatives", {}).items()),
    }


def _rounded(value: float | None) -> float | str:
    """A figure for a person, blank where there is none."""
    return "" if value is None else round(float(value), 3)


def changes_table(rows: list[dict[str, Any]]) -> str:
    """The rows of changes as tab-separated text with a header."""
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, delimiter="\t", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()
