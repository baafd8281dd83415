"""A table of recordings to begin with, guessed from the names of folders and files, for a person to correct.

Reads: the names below a folder, and the beginning of each recording. The format of the table is that of recording_table.py.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from markermend.core.recording import BadRecording
from markermend.formats.outline import read_outline
from markermend.options.general import GeneralOptions
from markermend.options.ingest import IngestOptions
from markermend.planning import recordings
from markermend.planning.counts import counted
from markermend.planning.recording_table import COLUMNS
from markermend.planning.recordings import Entry
from markermend.storage import tab_separated
from markermend.storage.folder_names import printable

SUBJECT = (
    r"(sub|subj|subject|suj|pat|patient|participant|part|proband|person|actor|vp|pp|pt|ab|id|s|p)[-_ ]?\d{1,4}(?![a-z0-9])",
    r"\d{1,4}(?=[-_ ]\d)",
)
"""Regular expressions for the name of a subject: a whole name of a folder, or the beginning of that of a file, in any case of letters."""

RANGE_OF_MOTION = r"(^|[^a-z])(rom|range[-_ ]?of[-_ ]?motion)([^a-z]|$)"
"""A regular expression for the names of recordings that calibrate a model by motion."""

NAMED = 3
"""Names that a line lists."""


@dataclass(frozen=True)
class StartingTable:
    """A table of recordings to begin with.

    Attributes
    ----------
    entries : tuple of Entry
        The recordings by subject and name.
    notes : tuple of str
        What was guessed from what, and what was left out, one line each.
    """

    entries: tuple[Entry, ...]
    notes: tuple[str, ...]

    def text(self, folder: Path) -> str:
        """Write the table.

        Parameters
        ----------
        folder : Path
            The folder that the table goes to: files are named relative to it.

        Returns
        -------
        str
            The table with tabs between its columns.
        """
        rows = [
            {
                "recording": entry.recording,
                "subject": entry.subject,
                "file": _relative(entry.source, os.path.abspath(folder)),
                "kind": entry.kind,
                "rate": None,
                "unit": None,
            }
            for entry in self.entries
        ]
        return tab_separated.table(COLUMNS[:6], rows)


def make_table(folder: str, general: GeneralOptions, ingest: IngestOptions) -> StartingTable:
    """Make a table of the recordings below a folder.

    The subject of a recording is that of `recordings.find` where the folder is named like a subject; else that with which the names of
    all files in the folder begin, where they do.

    Parameters
    ----------
    folder : str
        The folder.
    general : GeneralOptions
        Which links are followed, which folders are days, and where results are, which are left out.
    ingest : IngestOptions
        The names of static recordings.

    Returns
    -------
    StartingTable
        The recordings, and what was guessed.

    Raises
    ------
    BadDataSet
        Where there are no recordings.
    """
    found, warnings = recordings.find(
        folder,
        os.path.abspath(general.results),
        follow_links=general.follow_links,
        day_folders=general.day_folders,
    )
    named = _subjects_of_names(entry for entry in found if _is_text(entry))
    entries = _distinct(
        [
            replace(
                entry,
                subject=named.get(entry.source, entry.subject).strip(),
                recording=entry.recording.strip(),
                kind=_kind(entry, ingest),
                within=None,
            )
            for entry in found
            if _is_text(entry)
        ],
        folder,
    )
    motion = [entry for entry in entries if entry.kind == "auto" and _matches(RANGE_OF_MOTION, entry.recording)]
    static = [entry for entry in entries if entry.kind == "static"]
    left_out = [entry.source for entry in found if not _is_text(entry)]
    notes = [
        f"{counted(len(entries), 'recording')} of {counted(len({entry.subject for entry in entries}), 'subject')}",
        *_subject_notes(entries, named),
        *_note(static, "static by name, reported and never changed", "recording"),
        *_note(
            motion,
            "range of motion by name, cleaned as any other (write static in the column kind where it is not to be)",
            "recording",
        ),
        *_unreadable(entries),
        *warnings,
        *[f"left out: {printable(path)!r}, whose name is not text in UTF-8: rename it" for path in left_out],
    ]
    return StartingTable(tuple(sorted(entries, key=lambda entry: (entry.subject, entry.recording))), tuple(notes))


def _matches(pattern: str, name: str) -> bool:
    """Whether a pattern occurs in a name, in any case of letters."""
    return re.search(pattern, name, re.IGNORECASE) is not None


def _kind(entry: Entry, ingest: IngestOptions) -> str:
    """The kind of a recording by its name."""
    return "static" if any(_matches(pattern, entry.recording) for pattern in ingest.static_names) else "auto"


def _is_text(entry: Entry) -> bool:
    """Whether the path of a recording is text that a table can hold."""
    return printable(entry.source) == entry.source


def _relative(path: str, folder: str) -> str:
    """A path relative to a folder, which does not begin with a blank: a table loses it."""
    inner = os.path.relpath(path, folder)
    return inner if inner == inner.lstrip() else os.path.join(os.curdir, inner)


def _subjects_of_names(entries: Iterable[Entry]) -> dict[str, str]:
    """The subjects that the names of files begin with, by file, where the folder has no subject's name and all in it agree on a pattern."""
    folders: dict[str, list[Entry]] = {}
    for entry in entries:
        folders.setdefault(os.path.dirname(entry.source), []).append(entry)
    found: dict[str, str] = {}
    for own in folders.values():
        if any(re.fullmatch(pattern, os.path.basename(own[0].subject), re.IGNORECASE) for pattern in SUBJECT):
            continue
        for pattern in SUBJECT:
            begins = {e.source: re.match(pattern, os.path.basename(e.source), re.IGNORECASE) for e in own}
            if all(begins.values()):
                found |= {path: match.group() for path, match in begins.items() if match}
                break
    return found


def _distinct(entries: Sequence[Entry], folder: str) -> list[Entry]:
    """The recordings with names that differ within each subject: those of one name are named by their paths."""
    named = Counter(entry.folders for entry in entries)
    return [
        entry
        if named[entry.folders] == 1
        else replace(entry, recording=os.path.relpath(entry.source, folder).replace(os.sep, "_"))
        for entry in entries
    ]


def _subject_notes(entries: Sequence[Entry], named: Mapping[str, str]) -> list[str]:
    """From what the subjects were guessed."""
    by_name = [entry for entry in entries if entry.source in named]
    by_folder = [entry for entry in entries if entry.source not in named]
    return [
        *_note(by_folder, "subject from the folder", "subject"),
        *_note(by_name, "subject from the beginning of the file's name", "subject"),
    ]


def _note(entries: Sequence[Entry], what: str, attribute: str) -> list[str]:
    """A line on some recordings, with some names; none where there are no recordings."""
    if not entries:
        return []
    names = list(dict.fromkeys(getattr(entry, attribute) for entry in entries))
    listed = ", ".join(names[:NAMED]) + (f" and {len(names) - NAMED} more" if len(names) > NAMED else "")
    return [f"{counted(len(entries), 'recording')}: {what}: {listed}"]


def _unreadable(entries: Iterable[Entry]) -> list[str]:
    """What is known to be wrong with recordings from their beginning."""
    notes = []
    for entry in entries:
        try:
            read_outline(Path(entry.source))
        except (BadRecording, OSError) as error:
            notes.append(f"{entry.subject}/{entry.recording} will be set aside as it is: {error}")
    return notes
