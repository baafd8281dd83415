"""How much was done, in a sentence of the methods paragraph: what was counted, and nothing of which there was none."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from markermend.report.phrases import enumeration

DONE = {
    "filled": ("gap", "filled"),
    "repaired": ("artifact", "repaired"),
    "blanked": ("artifact", "set to missing"),
}
"""The keys of a summary with what was done: what it was done to, and what it was."""


def sentence(summaries: Sequence[Mapping[str, Any]]) -> str:
    """Count what was done in recordings.

    Parameters
    ----------
    summaries : sequence of mapping of str to Any
        Of recordings that were not set aside.

    Returns
    -------
    str
        A sentence; another where persons who gave their names judged any finding.
    """
    totals = {key: {name: sum(own[key][name] for own in summaries) for name in ("events", "samples")} for key in DONE}
    samples = sum(own["frames"] * own["markers"] for own in summaries)
    recordings = f"{len(summaries):,} recordings" if len(summaries) != 1 else "this recording"
    parts = [
        f"{_count(totals[key]['events'], noun)} ({_count(totals[key]['samples'], 'sample')}) {'was' if totals[key]['events'] == 1 else 'were'} {verb}"
        for key, (noun, verb) in DONE.items()
        if totals[key]["events"]
    ]
    done = enumeration(parts) if parts else "nothing was changed"
    return " ".join(
        [f"In {recordings} of {_count(samples, 'sample')} {done}.", *_judged([own["judged"] for own in summaries])]
    )


def _judged(each: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """How many findings were judged by whom, and when."""
    events = sum(own["events"] for own in each)
    by, dates = (sorted({name for own in each for name in own[key]}) for key in ("by", "dates"))
    if events and by:
        days = f" ({' to '.join(dict.fromkeys((dates[0], dates[-1])))})" if dates else ""
        what = "1 finding or gap was" if events == 1 else f"{events:,} findings and gaps were"
        yield f"{what} judged by hand by {enumeration(by)}{days}".rstrip(".") + "."


def _count(number: int, noun: str) -> str:
    """A number of things."""
    return f"{number:,} {noun}{'s' * (number != 1)}"
