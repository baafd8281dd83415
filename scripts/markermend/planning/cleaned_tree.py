"""Where the cleaned files go: each under its own name, in the same tree as the originals."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Collection, Mapping

from markermend.planning.discovery import Folders
from markermend.planning.recordings import BadDataSet, Entry


def places(entries: Mapping[Folders, Entry], top: str) -> dict[Folders, str]:
    """Place the cleaned file of each recording.

    A file that does not lie below `top` goes to the folder of its subject. Files of a table that would meet there, or that are several
    recordings, go to a folder of the recording, too.

    Parameters
    ----------
    entries : mapping of Folders to Entry
        The recordings, by the names of their folders.
    top : str
        Absolute path of the folder of the recordings, or of the table that names them.

    Returns
    -------
    dict of Folders to str
        Paths from the folder of cleaned files, all different.

    Raises
    ------
    BadDataSet
        Where two would still be one.
    """
    found = {folders: _below(entry.source, top) or _of_subject(folders, entry) for folders, entry in entries.items()}
    met = Counter(found.values())
    for folders, entry in entries.items():
        if met[found[folders]] > 1:
            found[folders] = f"{'/'.join(folders)}/{os.path.basename(entry.source)}"
    twice = [place for place, count in Counter(found.values()).items() if count > 1]
    if twice:
        raise BadDataSet("recordings: the cleaned files of several would be one; rename one: " + ", ".join(twice))
    return found


def beside(place: str, suffix: str, taken: Collection[str]) -> str:
    """Place a copy in another format beside a cleaned file.

    Parameters
    ----------
    place : str
        Where the cleaned file goes.
    suffix : str
        Suffix of the format, with its dot.
    taken : collection of str
        Where all cleaned files go.

    Returns
    -------
    str
        The same with another suffix; where another cleaned file goes there, with both.
    """
    other = os.path.splitext(place)[0] + suffix
    return place + suffix if other in taken else other


def _below(path: str, top: str) -> str:
    """Path of a file from a folder that it lies below; empty where it does not."""
    start = top.rstrip(os.sep) + os.sep
    return path.removeprefix(start).replace(os.sep, "/") if path.startswith(start) else ""


def _of_subject(folders: Folders, entry: Entry) -> str:
    """The place in the folder of the subject."""
    return f"{folders[0]}/{os.path.basename(entry.source)}"
