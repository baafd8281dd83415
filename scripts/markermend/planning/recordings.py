"""The recordings of a data set: what is known about one, and all that lie below a folder."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from markermend.formats.files import READABLE
from markermend.options.general import GeneralOptions
from markermend.planning.left_out import LeftOut
from markermend.storage.folder_names import RESERVED_RECORDINGS, RESERVED_SUBJECTS, encode, printable
from markermend.storage.source_file import leads_out

FORMATS = tuple(ending[1:] for ending in READABLE)
"""Suffixes of the files that can be read. Of two files with one stem, the first in this order keeps it as its name."""


DAYS = 3
"""Days that a warning names."""


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
    unit : str or None
        Unit of the positions that replaces the file's, a key of units.MILLIMETRES.
    mesh : str or None
        Absolute path of a mesh file for the subject.
    within : str or None
        Absolute path of the folder that the original, a link, may not lead out of.
    """

    subject: str
    recording: str
    source: str
    kind: str = "auto"
    rate: float | None = None
    unit: str | None = None
    mesh: str | None = None
    within: str | None = None

    @property
    def leads_out(self) -> bool:
        """Whether the original is a link to a file that is to be left alone."""
        return self.within is not None and leads_out(self.source, self.within)

    @property
    def is_no_file(self) -> bool:
        """Whether something other than a file stands in the place of the original, such as a pipe."""
        return os.path.exists(self.source) and not os.path.isfile(self.source)

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


def find(
    folder: str,
    results: str,
    *,
    follow_links: bool = False,
    day_folders: Sequence[str] = GeneralOptions().day_folders,
) -> tuple[list[Entry], list[str]]:
    """Find every recording below a folder, at whatever depth.

    The subject is the folder that holds the file, or the next one above that is not a day's: its name or, where several folders share
    it, their paths below `folder` without days. The recording is the stem of the file after the days on its path; of several files with
    one stem, the first by format (FORMATS) and name keeps it, and the others have their full names. Hidden files, hidden folders and
    folders of results are left out.

    Parameters
    ----------
    folder : str
        The folder.
    results : str
        The folder of results.
    follow_links : bool, optional
        Whether links that lead out of the folder are followed. Those to files are else recordings that are set aside.
    day_folders : sequence of str, optional
        Regular expressions for the whole names of folders that are days of a subject, in any case of letters.

    Returns
    -------
    entries : list of Entry
        The recordings by subject and name.
    warnings : list of str
        The folders below that were not searched, and why; the files that are no recordings, in counts.

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
            "recordings. Choose another folder for the results"
        )
    warnings: list[str] = []
    left = LeftOut(top)
    walked = _walk(top, os.path.realpath(results), follow_links, warnings, left)
    found = {path: files for path, files in walked if files}
    warnings += left.warnings()
    if not found:
        kinds = ", ".join(f".{name}" for name in FORMATS)
        raise BadDataSet("\n".join([f"recordings: no recording ({kinds}) in {top} or below", *warnings]))
    places = {path: _without_days(os.path.relpath(path, top), day_folders) for path in found}
    subjects = _name_subjects({place for place, _ in places.values()}, os.path.basename(top))
    own_days = sorted({days[0] for place, days in places.values() if place == os.curdir and days})
    if len(own_days) > 1:
        listed = ", ".join(map(printable, own_days[:DAYS])) + (
            f" and {len(own_days) - DAYS} more" * (len(own_days) > DAYS)
        )
        warnings.append(
            f"recordings: {listed} are taken for days of one subject, {printable(subjects[os.curdir])} (day_folders: [] takes each for a "
            "subject)"
        )
    entries = []
    for path, files in sorted(found.items()):
        place, days = places[path]
        names = _name_files(files)
        for file in files:
            source = os.path.join(path, file)
            within = top if os.path.islink(source) and not follow_links else None
            recording = "_".join([*days, names[file]])
            entries.append(Entry(printable(subjects[place]), printable(recording), source, within=within))
    named = Counter(entry.folders for entry in entries)
    same_name = [printable(entry.source) for entry in entries if named[entry.folders] > 1]
    if same_name:
        raise BadDataSet("recordings: these cannot be distinguished by name; rename one:\n" + "\n".join(same_name))
    return sorted(entries, key=lambda entry: (entry.subject, entry.recording)), warnings


def _without_days(inner: str, day_folders: Sequence[str]) -> tuple[str, list[str]]:
    """A path below the folder of recordings without the folders of days, "." for that folder itself, and the days."""
    parts = [] if inner == os.curdir else inner.split(os.sep)
    days = [part for part in parts if any(re.fullmatch(day, part, re.IGNORECASE) for day in day_folders)]
    return os.sep.join(part for part in parts if part not in days) or os.curdir, days


def _name_subjects(places: Collection[str], top: str) -> dict[str, str]:
    """Name the subjects of folders, given by their paths below the folder of recordings, whose own name is `top`."""
    names = {place: top if place == os.curdir else os.path.basename(place) for place in places}
    shared = Counter(names.values())
    subjects = {}
    for place, name in names.items():
        subjects[place] = name if shared[name] == 1 or place == os.curdir else place.replace(os.sep, "/")
        if os.curdir in places and place == top:
            subjects[place] = f"{top}/{top}"
    return subjects


def _walk(
    top: str, results: str, follow_links: bool, warnings: list[str], left: LeftOut
) -> Iterator[tuple[str, list[str]]]:
    """Walk the folders below `top`, links too but none twice, and give the recordings' file names in each; warn of those left out."""

    def unreadable(error: OSError) -> None:
        warnings.append(
            f"recordings: {printable(error.filename)} cannot be searched ({error.strerror}): it is left out"
        )

    seen = set()
    for path, folders, files in os.walk(top, followlinks=True, onerror=unreadable):
        real = os.path.realpath(path)
        if not follow_links and path != top and os.path.islink(path) and leads_out(path, top):
            warnings.append(
                f"recordings: {printable(path)} is a link that leads out of the folder of recordings: it is left out "
                "(follow_links: true follows it)"
            )
            folders.clear()
            continue
        earlier = real != results and os.path.isfile(os.path.join(path, "report", "logs", "recordings.txt"))
        if earlier or "01_markers.parquet" in files:
            left.note("with results of earlier runs", os.path.dirname(path), [os.path.basename(path)])
        if real in seen or real == results or earlier or "01_markers.parquet" in files:
            folders.clear()
            continue
        seen.add(real)
        left.note_files(path, files)
        left.note("hidden", path, [f"{name}/" for name in folders if name.startswith(".")])
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        yield path, sorted(name for name in files if not name.startswith(".") and suffix(name) in FORMATS)


def _name_files(files: list[str]) -> dict[str, str]:
    """Name the recordings of one folder after their files, each differently."""
    names: dict[str, str] = {}
    for file in sorted(files, key=lambda file: (FORMATS.index(suffix(file)), file)):
        stem = os.path.splitext(file)[0]
        names[file] = file if stem in names.values() or stem in files else stem
    return names
