"""The summaries of all recordings of a data set put together: table, order, totals, methods texts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from markermend.planning.counts import counted
from markermend.planning.run_summary import STATUSES
from markermend.report.exclusion import exclusion_codes
from markermend.report.methods_counts import sentence
from markermend.storage import tab_separated

COLUMNS = (
    "recording", "subject", "status", "stage", "reason", "source", "kind", "frames", "rate", "duration_s", "markers",
    "missing_share_before", "missing_share_after", "longest_gap_before_s", "longest_gap_after_s", "changed_samples", "changed_share", "repaired", "blanked",
    "findings_open", "filled", "gaps_open", "largest_change_mm", "expected_error_median_mm", "expected_error_max_mm",
    "expected_error95_max_mm", "unjudged", "warnings", "attention", "exclusion", "original_sha256", "cleaned_sha256", "page",
)  # fmt: skip
"""The columns of summary.tsv."""

COUNTED = ("repaired", "blanked", "findings_open", "filled", "gaps_open")
"""The keys of a summary that hold a number of findings."""


def table(summaries: Sequence[Mapping[str, Any]]) -> str:
    """Write summary.tsv.

    Parameters
    ----------
    summaries : Sequence[Mapping[str, Any]]
        Of the recordings, in any order.

    Returns
    -------
    str
        One row per recording, worst first; counts in place of lists, empty cells for what is unknown.
    """
    rows = [
        {column: cell(summary.get(column)) for column in COLUMNS} | {"exclusion": " ".join(exclusion_codes(summary))}
        for summary in ordered(summaries)
    ]
    return tab_separated.table(COLUMNS, rows)


def cell(value: Any) -> str:
    """Write one value as a cell on one line.

    Parameters
    ----------
    value : Any
        Of a summary.

    Returns
    -------
    str
        The cell.
    """
    if isinstance(value, Mapping):
        value = value["events"]
    elif isinstance(value, list):
        value = len(value)
    return "" if value is None else " ".join(str(value).split())


def ordered(summaries: Sequence[Mapping[str, Any]]) -> list[Mapping[str, Any]]:
    """Sort recordings, those set aside first, then by attention.

    Parameters
    ----------
    summaries : Sequence[Mapping[str, Any]]
        Of the recordings.

    Returns
    -------
    list[Mapping[str, Any]]
        The same, worst first.
    """
    return sorted(summaries, key=lambda s: (-s.get("attention", float("inf")), s["subject"], s["recording"]))


def totals(entries: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Add up recordings.

    Parameters
    ----------
    entries : Sequence[Mapping[str, Any]]
        Their summaries.

    Returns
    -------
    dict of str to Any
        Numbers of recordings by status, numbers of samples and changes, and shares missing.
    """
    done = [entry for entry in entries if entry["status"] != "set aside"]
    sizes = [entry["frames"] * entry["markers"] for entry in done]
    samples = sum(sizes)

    def share(key: str) -> float:
        return sum(e[key] * size for e, size in zip(done, sizes, strict=True)) / samples if samples else 0.0

    return {
        **{status: sum(entry["status"] == status for entry in entries) for status in STATUSES},
        "recordings": len(entries),
        "samples": samples,
        "changed_samples": sum(entry["changed_samples"] for entry in done),
        "changed_share": share("changed_share"),
        "missing_share_before": share("missing_share_before"),
        "missing_share_after": share("missing_share_after"),
        **{key: sum(entry[key]["events"] for entry in done) for key in COUNTED},
    }


ADVICE = "record a range-of-motion trial or supply a mesh"
"""What to do about a subject who moved too little for the segments to be inferred."""


def motion_advice(entries: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """Advise on the subjects who moved too little for their body mesh, where it matters.

    Parameters
    ----------
    entries : Sequence[Mapping[str, Any]]
        Summaries of recordings.

    Returns
    -------
    dict of str to str
        By subject what the motion lacks and what to do about it, for subjects in whose recordings anything was found, is
        missing, or could not be judged.
    """
    lacks: dict[str, dict[str, None]] = {}
    for entry in entries:
        judged = entry["status"] not in ("set aside", "static")
        if judged and (entry["missing_share_before"] or entry["unjudged"] or _found(entry)):
            lacks.setdefault(entry["subject"], {}).update(dict.fromkeys(entry["motion_lacks"]))
    return {subject: f"{', '.join(own)}: {ADVICE}" for subject, own in sorted(lacks.items()) if own}


def _found(entry: Mapping[str, Any]) -> bool:
    """Whether a detector found anything in a recording."""
    return any(findings["events"] for findings in entry["findings"].values())


NAMED = 3
"""Largest number of recordings that the heading of their methods text names."""


def distinct_methods(entries: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """List the distinct methods texts.

    Parameters
    ----------
    entries : Sequence[Mapping[str, Any]]
        Summaries of recordings.

    Returns
    -------
    list[dict[str, Any]]
        Each text once, with the number of recordings that it holds for, a heading that says which they are where they are few, and what was
        done in them, in a sentence; most first.
    """
    texts = {entry["methods"]["text"]: entry["methods"] for entry in entries if "methods" in entry}
    own: dict[str, list[Mapping[str, Any]]] = {}
    for entry in entries:
        if "methods" in entry:
            own.setdefault(entry["methods"]["text"], []).append(entry)
    counts = {text: len(alike) for text, alike in own.items()}
    order = sorted(texts, key=lambda text: (-counts[text], text))
    return [
        {**texts[text], "recordings": counts[text], "heading": _heading(own[text]), "counts": sentence(own[text])}
        for text in order
    ]


def _heading(entries: Sequence[Mapping[str, Any]]) -> str:
    """How many recordings there are, and which where they are few."""
    names = sorted(f"{entry['subject']}/{entry['recording']}" for entry in entries)
    return counted(len(names), "recording") + (f": {', '.join(names)}" if len(names) <= NAMED else "")
