"""The recordings of a data set: every recording below a folder, or the rows of a table."""

from __future__ import annotations

import csv
import os
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from markermend.formats.files import READABLE
from markermend.storage.folder_names import RESERVED_RECORDINGS, RESERVED_SUBJECTS, encode, printable

FORMATS = tuple(ending[1:] for ending in READABLE)
"""Suffixes of the files that can be read. Of two files with one stem, the first in this order keeps it as its name."""

COLUMNS = ("recording", "subject", "file", "kind", "rate", "mesh")
"""Columns of the table; the first three are required."""


class BadDataSet(Exception):
    """The recordings cannot be told from the setting; the message says what, where and what to do."""


@dataclass(frozen=True)
class Entry:
    """One recording of the data set.

    source: absolute path of the original. kind: auto, dynamic or static. rate: Hz, where the file does not tell. mesh:
    absolute path of a mesh file for the subject.
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
    """The suffix of a path in lower case, without its dot."""
    return os.path.splitext(path)[1].lower()[1:]


def find(folder: str, results: str) -> list[Entry]:
    """Find every recording below a folder, whatever the depth; the folder that holds a file is its subject.

    A folder of results, hidden files and hidden folders are left out. Subject: the folder's name; where several
    share it, their path below `folder`. Recording: the file's stem;
    where two files share it, the first by format (FORMATS) and name, and the others their full names. Raises
    BadDataSet where there is none, where two would have one name, or where results would lie among the recordings.
    """
    top = os.path.abspath(folder)
    inside = os.path.realpath(top) + os.sep
    if inside.startswith(os.path.realpath(results).rstrip(os.sep) + os.sep):
        raise BadDataSet(
            f"results: {results} holds the recordings ({folder}), so that the next run would take results for "
            "recordings. Choose a folder of its own: --config results=FOLDER"
        )
    found = {path: files for path, files in walk(top, os.path.realpath(results)) if files}
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
        names = name_files(files)
        entries += [Entry(printable(subject), printable(names[file]), os.path.join(path, file)) for file in files]
    named = Counter(entry.folders for entry in entries)
    alike = [printable(entry.source) for entry in entries if named[entry.folders] > 1]
    if alike:
        raise BadDataSet("recordings: these cannot be told apart by name; rename one:\n" + "\n".join(alike))
    return sorted(entries, key=lambda entry: (entry.subject, entry.recording))


def walk(top: str, results: str) -> Iterator[tuple[str, list[str]]]:
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


def name_files(files: list[str]) -> dict[str, str]:
    """Name the recordings of one folder after their files, each differently."""
    names: dict[str, str] = {}
    for file in sorted(files, key=lambda file: (FORMATS.index(suffix(file)), file)):
        stem = os.path.splitext(file)[0]
        names[file] = file if stem in names.values() or stem in files else stem
    return names


def read_rows(path: str) -> list[dict[str, Any]]:
    """Read the table of recordings: one dictionary per row, empty cells left out. A rate that is a number becomes one.

    Raises BadDataSet as read_table does, and for a table without rows.
    """
    table = read_table(path, what="recordings", columns=COLUMNS, required=COLUMNS[:3])
    rows: list[dict[str, Any]] = [row for _, row in table]
    if not rows:
        raise BadDataSet(f"recordings: {path} has no rows")
    return [row | {"rate": number_or_text(row["rate"])} if "rate" in row else row for row in rows]


def read_table(
    path: str, *, what: str, columns: Sequence[str], required: Sequence[str]
) -> list[tuple[int, dict[str, str]]]:
    """Read a table separated by tabs, commas or semicolons: line number and filled cells of each row that has any.

    what: the setting that names the table. columns: those that there are. Raises BadDataSet for what is no table, for
    a column that is not required where it should be, unknown or repeated, and for cells outside of the columns.
    """
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            header = file.readline()
            separator = next((mark for mark in "\t,;" if mark in header), "\t")
            file.seek(0)
            reader = csv.reader(file, delimiter=separator)
            table = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader]
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadDataSet(f"{what}: {path} is not a table in UTF-8 text ({error})") from error
    names = table[0][1] if table else []
    repeated = [name for name, count in Counter(names).items() if count > 1 and name]
    if repeated:
        raise BadDataSet(f"{what}: {path} has column {', '.join(repeated)} more than once")
    known = f"columns are {', '.join(columns)}"
    if absent := [name for name in required if name not in names]:
        raise BadDataSet(f"{what}: {path} has no column {', '.join(absent)}; {known}")
    if strange := [name for name in names if name and name not in columns]:
        raise BadDataSet(f"{what}: {path} has column {', '.join(strange)}, which means nothing; {known}")
    rows = []
    for number, cells in table[1:]:
        if len(cells) > len(names):
            raise BadDataSet(f"{what}: {path} line {number} has {len(cells)} cells for {len(names)} columns")
        row = {name: cell for name, cell in zip(names, cells, strict=False) if cell}
        if "" in row:
            raise BadDataSet(f"{what}: {path} line {number} has {row['']!r} in a column without a name")
        if row:
            rows.append((number, row))
    return rows


def number_or_text(text: str) -> float | str:
    """Read a number where the text is one."""
    try:
        return float(text)
    except ValueError:
        return text


def from_rows(rows: list[dict[str, Any]], path: str) -> list[Entry]:
    """Turn the rows of a table into entries; files are relative to the table.

    Raises BadDataSet naming every file that is missing or of no known format, and every recording named twice.
    """
    base = os.path.dirname(os.path.abspath(path))
    entries = []
    for row in rows:
        places = {name: os.path.normpath(os.path.join(base, row[name])) for name in ("file", "mesh") if name in row}
        more = {name: row[name] for name in ("kind", "rate") if name in row}
        entries.append(Entry(row["subject"], row["recording"], places["file"], mesh=places.get("mesh"), **more))
    wanted = [entry.source for entry in entries] + [entry.mesh for entry in entries if entry.mesh]
    problems = [f"no such file: {file}" for file in dict.fromkeys(wanted) if not os.path.isfile(file)]
    problems += [
        f"not a known format ({', '.join(FORMATS)}): {entry.source}" for entry in entries if entry.format not in FORMATS
    ]
    named = Counter((entry.subject, entry.recording) for entry in entries)
    problems += [f"twice: recording {name} of subject {subject}" for (subject, name), n in named.items() if n > 1]
    if problems:
        raise BadDataSet("\n".join([f"recordings: {path} cannot be used", *problems]))
    return sorted(entries, key=lambda entry: (entry.subject, entry.recording))
