"""The table of recordings: one row per recording, as people write it.

A table with a cell that cannot be used is refused as a whole, with line and column of every problem.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping

from markermend.formats import files, units
from markermend.planning.recordings import BadDataSet, Entry
from markermend.planning.tables import Problem, read_table, unknown_word

COLUMNS = ("recording", "subject", "file", "kind", "rate", "unit", "mesh")
"""Columns of the table."""

REQUIRED = COLUMNS[:3]
"""The columns that must be there, with no cell empty."""

KINDS = ("auto", "dynamic", "static")
"""What the column `kind` can say."""


def read(path: str) -> list[Entry]:
    """Read the table of recordings.

    Parameters
    ----------
    path : str
        File of the table; files in it are relative to its folder.

    Returns
    -------
    list of Entry
        The recordings by subject and name.

    Raises
    ------
    BadDataSet
        For what is no such table, and for one without rows; naming every cell that is empty, means nothing or names no file that can be
        read, and every recording that is named twice.
    """
    table = read_table(path, what="recordings", columns=COLUMNS, required=REQUIRED)
    if not table:
        raise BadDataSet(f"recordings: {path} has no rows")
    base = os.path.dirname(os.path.abspath(path))
    problems: list[str] = []
    first: dict[tuple[str, ...], int] = {}
    for number, row in table:
        problems += [f"line {number}, {problem}" for problem in _problems(row, base)]
        name = tuple(row.get(column, "") for column in ("subject", "recording"))
        if all(name) and first.setdefault(name, number) != number:
            problems.append(
                f"line {number}, column recording: {name[1]!r} of the subject {name[0]!r} is in line {first[name]} already"
            )
    if problems:
        raise BadDataSet("\n".join([f"recordings: {path} cannot be used (config/README.md)", *problems]))
    return sorted((_entry(row, base) for _, row in table), key=lambda entry: (entry.subject, entry.recording))


def _problems(row: Mapping[str, str], base: str) -> Iterator[Problem]:
    """What is wrong with the cells of a row, whose files are relative to a folder."""
    for column in REQUIRED:
        if column not in row:
            yield Problem(column, "is empty")
    if row.get("kind", KINDS[0]) not in KINDS:
        yield Problem("kind", unknown_word(row["kind"], KINDS))
    if "rate" in row and not 0 < _number(row["rate"]) < math.inf:
        yield Problem("rate", f"{row['rate']!r} is no number of frames per second")
    if "unit" in row and units.unit_of(row["unit"]) is None:
        yield Problem("unit", f"{row['unit']!r} is none of {units.KNOWN}")
    for column in ("file", "mesh"):
        path = _place(row[column], base) if column in row else None
        if path and not os.path.isfile(path):
            yield Problem(column, f"{path} is {'not a file' if os.path.exists(path) else 'not there'}")
        elif path and column == "file" and (reason := files.why_unreadable(path)):
            yield Problem(column, f"{path} {reason}")


def _number(text: str) -> float:
    """Read a number; not a number where the text is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def _place(file: str, base: str) -> str:
    """Absolute path of a file that is named relative to a folder."""
    return os.path.normpath(os.path.join(base, file))


def _entry(row: Mapping[str, str], base: str) -> Entry:
    """The recording of a row without problems."""
    return Entry(
        row["subject"],
        row["recording"],
        _place(row["file"], base),
        kind=row.get("kind", KINDS[0]),
        rate=float(row["rate"]) if "rate" in row else None,
        unit=units.unit_of(row.get("unit", "")),
        mesh=_place(row["mesh"], base) if "mesh" in row else None,
    )
