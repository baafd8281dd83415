"""What a run is about to take, in one line before it begins.

Reads: the beginnings of recordings, at most `LOOKED_AT` of them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from markermend.core.recording import BadRecording
from markermend.formats.outline import Outline, read_outline
from markermend.planning.counts import counted
from markermend.planning.recordings import Entry
from markermend.planning.result_files import QUALITY
from markermend.terminal.progress import duration

CPU_PER_RECORDING_S = 6.0
"""Time of a core that every recording takes, s (benchmarks/results/runtime.tsv: all jobs of 85_12 and STS1)."""

CPU_PER_SAMPLE_S = 4.1e-5
"""Time of a core that a sample of a marker takes besides, s: 0.3 s for a minute of a marker at 120 Hz."""

MOST = 3.0
"""How many times as long recordings with many gaps and artifacts may take."""

LOOKED_AT = 200
"""Recordings that are looked at; of more, as many evenly spaced ones stand for all."""


def line(entries: Sequence[Entry], results: Path, *, cores: int | None) -> str:
    """Estimate what a run will take.

    Parameters
    ----------
    entries : sequence of Entry
        The recordings.
    results : Path
        The folder of results.
    cores : int or None
        Cores that the run has; None where that is not known.

    Returns
    -------
    str
        Recordings, subjects, duration of the data, and about how long it will take from nothing: if they are clean, and if they have many gaps and
        artifacts; how many have results already.
    """
    count, subjects = len(entries), len({entry.subject for entry in entries})
    looked_at = entries[:: math.ceil(count / LOOKED_AT)]
    outlines = [outline for outline in map(_outline, looked_at) if outline]
    share = count / len(looked_at)
    seconds = share * sum(outline.seconds for outline in outlines if math.isfinite(outline.seconds))
    work = count * CPU_PER_RECORDING_S + share * CPU_PER_SAMPLE_S * sum(outline.samples for outline in outlines)
    of_cores = min(cores or 1, count)
    most = duration(MOST * work / of_cores)
    where = f"on {counted(cores, 'core')}" if cores else "of one core"
    done = sum(
        (results / subject / recording / QUALITY).exists() for subject, recording in (e.folders for e in entries)
    )
    who = "it has" if count == 1 else f"{done} of them {'has' if done == 1 else 'have'}"
    there = f"; {who} results, which are kept where nothing has changed" if done else ""
    return (
        f"{counted(count, 'recording')} of {counted(subjects, 'subject')}, {duration(seconds)} of data: "
        f"about {duration(work / of_cores)} to {most} {where}{there}"
    )


def _outline(entry: Entry) -> Outline | None:
    """The outline of a recording; nothing in one that will be set aside."""
    if entry.leads_out or entry.is_no_file:
        return None
    try:
        return read_outline(Path(entry.source), rate=entry.rate)
    except (BadRecording, OSError):
        return None
