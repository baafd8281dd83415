"""The recordings of a data set: what is known about one, and all that lie below a folder."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from markermend.formats.files import READABLE
from markermend.storage.folder_names import RESERVED_RECORDINGS, RESERVED_SUBJECTS, encode, printable

FORMATS = tuple(ending[1:] for ending in READABLE)
"""Suffixes of the files that can be read. Of two files with one stem, the first in this order keeps it as its name."""


class BadDataSet(Exception):
    """A data set or a config that cannot be used; the message says what, where and what to do."""


class NoRecordings(BadDataSet):
    """There is no folder or table of the name that the config has."""


@dataclass(frozen=True)
class Entry:
    """One recording of the data set.

    Attributes
    ----------
    subject, recording : str
        Their names.
    source : str
        Absolute path of the original file.
    kind : str
        `auto`, `dynamic` or `static`.
    rate : float or None
        Frame rate that replaces the file's, Hz.
    mesh : str or None
        Absolute path of a mesh file for the subject.
    """

    subject: str
    recording: str
    source: str
    kind: str = "auto"
    rate: float | None = None
    mesh: str | None = None

    @property
    def folders(self) -> tuple[str, str]:
        """Names of the subject's folder and, within it, the recording's."""
        return encode(self.subject, RESERVED_SUBJECTS), encode(self.recording, RESERVED_RECORDINGS)

    @property
    def format(self) -> str:
        """The original's suffix in lower case, which is that of the cleaned file."""
        return suffix(self.source)


def suffix(path: str) -> str:
    """Name the format of a file.

    Parameters
    ----------
    path : str
        Its path.

    Returns
    -------
    str
        The suffix in lower case, without its dot.
    """
    return os.path.splitext(path)[1].lower()[1:]


def find(folder: str, results: str) -> list[Entry]:
    """Find every recording below a folder, at whatever depth.

    The subject is the folder that holds the file: its name or, where several folders share it, their paths below
    `folder`. The recording is the stem of the file; of several files with one stem, the first by format (FORMATS) and
    name keeps it, and the others have their full names. Hidden files, hidden folders and folders of results are
    left out.

    Parameters
    ----------
    folder : str
        The folder.
    results : str
        The folder of results.

    Returns
    -------
    list of Entry
        The recordings by subject and name.

    Raises
    ------
    BadDataSet
        Where there is no recording, where two would have one name, or where results would lie among the recordings.
    """
    top = os.path.abspath(folder)
    inside = os.path.realpath(top) + os.sep
    if inside.startswith(os.path.realpath(results).rstrip(os.sep) + os.sep):
        raise BadDataSet(
            f"results: {results} holds the recordings ({folder}), so that the next run would take results for "
            "recordings. Choose a folder of its own: --config results=FOLDER"
        )
    found = {path: files for path, files in _walk(top, os.path.realpath(results)) if files}
    if not found:
        kinds = ", ".join(f".{name}" for name in FORMATS)
        raise BadDataSet(f"recordings: no recording ({kinds}) in {top} or below")
    shared = Counter(os.path.basename(path) for path in found)
    entries = []
    for path, files in sorted(found.items()):
        name, inner = os.path.basename(path), os.path.relpath(path, top)
        subject = name if shared[name] == 1 or path == top else inner.replace(os.sep, "/")
        if path != top and top in found and inner == os.path.basename(top):
            subject = f"{inner}/{inner}"
        names = _name_files(files)
        entries += [Entry(printable(subject), printable(names[file]), os.path.join(path, file)) for file in files]
    named = Counter(entry.folders for entry in entries)
    same_name = [printable(entry.source) for entry in entries if named[entry.folders] > 1]
    if same_name:
        raise BadDataSet("recordings: these cannot be distinguished by name; rename one:\n" + "\n".join(same_name))
    return sorted(entries, key=lambda entry: (entry.subject, entry.recording))


def _walk(top: str, results: str) -> Iterator[tuple[str, list[str]]]:
    """Walk the folders below `top`, links too but none twice, and give the recordings' file names in each."""
    seen = set()
    for path, folders, files in os.walk(top, followlinks=True):
        real = os.path.realpath(path)
        if real in seen or real == results or "01_markers.parquet" in files:
            folders.clear()
            continue
        seen.add(real)
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        yield path, sorted(name for name in files if not name.startswith(".") and suffix(name) in FORMATS)


def _name_files(files: list[str]) -> dict[str, str]:
    """Name the recordings of one folder after their files, each differently."""
    names: dict[str, str] = {}
    for file in sorted(files, key=lambda file: (FORMATS.index(suffix(file)), file)):
        stem = os.path.splitext(file)[0]
        names[file] = file if stem in names.values() or stem in files else stem
    return names
