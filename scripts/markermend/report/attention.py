"""How much a recording needs a person's attention: points by cause, which order the report."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from markermend.options.reporting import AttentionOptions


def with_attention(summary: Mapping[str, Any], weights: AttentionOptions) -> dict[str, Any]:
    """Add the score of attention to a summary.

    Parameters
    ----------
    summary : mapping of str to Any
        What `markermend.report.summary.summarize` gives.
    weights : AttentionOptions
        Points of attention, see `attention`.

    Returns
    -------
    dict of str to Any
        The summary with the score and its parts by cause.
    """
    parts = attention(summary, weights)
    return {**summary, "attention": round(sum(parts.values()), 3), "attention_parts": parts}


def attention(summary: Mapping[str, Any], weights: AttentionOptions) -> dict[str, float]:
    """Score how much a recording needs a person's attention.

    Parameters
    ----------
    summary : mapping of str to Any
        Of the recording.
    weights : AttentionOptions
        Points per percent of the samples changed (`changed_percent`), per percent still missing (`missing_percent`),
        per mm of the largest expected error (`error_mm`), per artifact found but not repaired (`open`), per marker
        that no detector could judge (`unjudged`) and per warning (`warning`).

    Returns
    -------
    dict of str to float
        Points by cause, which add up to the score; a complete recording that nothing was done to scores 0.
    """
    points = {
        "changed": weights.changed_percent * 100 * summary["changed_share"],
        "missing": weights.missing_percent * 100 * summary["missing_share_after"],
        "expected error": weights.error_mm * (summary["expected_error_max_mm"] or 0.0),
        "artifacts left": weights.open * summary["findings_open"]["events"],
        "markers not judged": weights.unjudged * len(summary["unjudged"]),
        "warnings": weights.warning * len(summary["warnings"]),
    }
    return {name: round(value, 3) for name, value in points.items()}
