"""Reading the recordings of a subject, of which some may have been set aside."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from markermend.core.recording import Recording, SetAside
from markermend.storage import stage_files


def read_subject(paths: Sequence[Path], *, prepare: Callable[[Recording], Recording]) -> list[Recording]:
    """Read the recordings of a subject, each prepared before the next is read, so that many fit into memory.

    Parameters
    ----------
    paths : sequence of Path
        01_markers.parquet of each recording, in a folder of the recording's name.
    prepare : callable
        Makes of each recording what is kept of it.

    Returns
    -------
    list of Recording
        Those that were not set aside.

    Raises
    ------
    SetAside
        If all were set aside.
    """
    recordings: list[Recording] = []
    aside: SetAside | None = None
    for path in paths:
        try:
            recording = stage_files.read_recording(path)
        except SetAside as note:
            aside = note
            continue
        facts = {"recording": path.parent.name, **recording.facts}
        recordings.append(prepare(replace(recording, facts=facts)))
    if not recordings and aside is not None:
        raise aside
    return recordings
