"""Why a recording may have to be left out of an analysis: a short list of codes, for the table of a data set."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

CODES = {
    "set_aside": "nothing was done: the column `reason` says why, and the cleaned file is the original",
    "static": "a static trial, which is checked and not cleaned",
    "missing_marker": "a marker is missing from the first frame to the last",
    "gaps_left": "gaps were left, which the page lists with the reason of each",
    "artifacts_left": "artifacts were found and neither repaired nor taken away, which the page lists with the reason of each",
    "not_judged": "no detector could judge some of the markers, which the page names",
    "refused": "the number format of the file cannot hold some samples, which stay as they were",
}
"""What speaks against a recording, by code; a recording of which nothing does has none."""


def exclusion_codes(summary: Mapping[str, Any]) -> list[str]:
    """List what speaks against a recording.

    Parameters
    ----------
    summary : mapping of str to Any
        Of the recording.

    Returns
    -------
    list of str
        Keys of CODES, in their order. Whether any of them is a reason to leave the recording out depends on the analysis.
    """
    if summary["status"] == "set aside":
        return ["set_aside"]
    found = {
        "static": summary["status"] == "static",
        "missing_marker": bool(summary.get("markers_never_seen")),
        "gaps_left": bool(summary["gaps_open"]["events"]),
        "artifacts_left": bool(summary["findings_open"]["events"]),
        "not_judged": bool(summary["unjudged"]),
        "refused": bool(summary.get("refused_samples")),
    }
    return [code for code in CODES if found.get(code)]
