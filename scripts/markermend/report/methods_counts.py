"""How much was done, in a sentence of the methods paragraph: what was counted, and nothing of which there was none."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from markermend.planning.counts import counted
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
        A sentence; another where persons who gave their names decided anything.
    """
    totals = {key: {name: sum(own[key][name] for own in summaries) for name in ("events", "samples")} for key in DONE}
    samples = sum(own["frames"] * own["markers"] for own in summaries)
    recordings = counted(len(summaries), "recording", style=",") if len(summaries) != 1 else "this recording"
    parts = [
        f"{counted(totals[key]['events'], noun, style=',')} ({counted(totals[key]['samples'], 'sample', style=',')}) {'was' if totals[key]['events'] == 1 else 'were'} {verb}"
        for key, (noun, verb) in DONE.items()
        if totals[key]["events"]
    ]
    done = enumeration(parts) if parts else "nothing was changed"
    return " ".join(
        [
            f"In {recordings} of {counted(samples, 'sample', style=',')} {done}.",
            *_decided([own["judged"] for own in summaries]),
        ]
    )


def _decided(each: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """How many findings, gaps and stretches of frames were treated as persons decided who gave their names, and when they did."""
    events = sum(own["events"] for own in each)
    by, dates = (sorted({name for own in each for name in own[key]}) for key in ("by", "dates"))
    if events and by:
        days = f" ({' to '.join(dict.fromkeys((dates[0], dates[-1])))})" if dates else ""
        what = (
            "1 finding, gap or stretch of frames was"
            if events == 1
            else f"{events:,} findings, gaps and stretches of frames were"
        )
        yield f"{what} treated as decided by {enumeration(by)}{days}".rstrip(".") + "."
