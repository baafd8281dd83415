"""Names of markers that people wrote, held against those of the recordings before anything runs.

Reads: the beginnings of recordings, until every name is found.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping
from difflib import get_close_matches
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from markermend.core.recording import BadRecording
from markermend.formats.outline import read_outline
from markermend.planning.discovery import Folders
from markermend.planning.recordings import Entry
from markermend.storage.folder_names import readable

LOOKED_AT = 1000
"""Recordings that are looked at; of more, as many evenly spaced ones stand for all."""

NEAR = 3
"""Similar names that a warning lists."""


def unknown_names(
    protect: Iterable[str],
    decisions: Mapping[Folders, Iterable[Mapping[str, Any]]],
    entries: Mapping[Folders, Entry],
) -> list[str]:
    """Warn of names and patterns that no marker has.

    Parameters
    ----------
    protect : iterable of str
        The patterns of the option `protect`, each of which is to be a marker of any recording.
    decisions : mapping of Folders to iterable of mapping
        What a person decided about each recording, which is to have the marker.
    entries : mapping of Folders to Entry
        The recordings.

    Returns
    -------
    list of str
        A sentence for each, with similar names.
    """
    left, known = list(dict.fromkeys(protect)), set[str]()
    places = list(entries)
    for place in places[:: max(1, math.ceil(len(places) / LOOKED_AT))]:
        if not left:
            break
        known |= _names(entries[place])
        left = [pattern for pattern in left if not _matches(pattern, known)]
    warnings = [f"protect: no recording has a marker {pattern}{_similar(pattern, known)}" for pattern in left if known]
    for place, lines in decisions.items():
        names = _names(entries[place])
        for pattern in dict.fromkeys(str(line["marker"]) for line in lines):
            if names and not _matches(pattern, names):
                warnings.append(f"decisions: {readable(*place)} has no marker {pattern}{_similar(pattern, names)}")
    return warnings


def _names(entry: Entry) -> set[str]:
    """The names of the trajectories of a recording; none where it cannot be read."""
    if entry.leads_out or entry.is_no_file:
        return set()
    try:
        return set(read_outline(Path(entry.source), rate=entry.rate or 1.0).names)
    except (BadRecording, OSError):
        return set()


def _matches(pattern: str, names: Iterable[str]) -> bool:
    """Whether a name or pattern is that of a trajectory."""
    return any(fnmatchcase(name, pattern) for name in names)


def _similar(pattern: str, known: Collection[str]) -> str:
    """Ask whether a similar name was meant, in any case of letters."""
    by_small = {name.casefold(): name for name in sorted(known)}
    close = [by_small[name] for name in get_close_matches(pattern.strip("*?").casefold(), by_small, n=NEAR)]
    return f"; did you mean {' or '.join(close)}?" if close else ""
