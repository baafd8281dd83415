"""The table of recordings: one row per recording, as people write it."""

from __future__ import annotations

import os
from collections import Counter
from typing import Any

from markermend.formats import files, units
from markermend.planning.recordings import BadDataSet, Entry
from markermend.planning.tables import read_table

COLUMNS = ("recording", "subject", "file", "kind", "rate", "unit", "mesh")
"""Columns of the table; the first three are required."""


def read_rows(path: str) -> list[dict[str, Any]]:
    """Read the table of recordings.

    Parameters
    ----------
    path : str
        File of the table.

    Returns
    -------
    list of dict
        One per row, without empty cells; a rate that is a number is one.

    Raises
    ------
    BadDataSet
        For what is no such table, and for one without rows.
    """
    table = read_table(path, what="recordings", columns=COLUMNS, required=COLUMNS[:3])
    rows: list[dict[str, Any]] = [row for _, row in table]
    if not rows:
        raise BadDataSet(f"recordings: {path} has no rows")
    return [row | {"rate": _number_or_text(row["rate"])} if "rate" in row else row for row in rows]


def _number_or_text(text: str) -> float | str:
    """Read a number where the text is one."""
    try:
        return float(text)
    except ValueError:
        return text


def from_rows(rows: list[dict[str, Any]], path: str) -> list[Entry]:
    """Turn the rows of a table into recordings.

    Parameters
    ----------
    rows : list[dict[str, Any]]
        The rows, held against their schema.
    path : str
        File of the table; files in it are relative to its folder.

    Returns
    -------
    list of Entry
        The recordings by subject and name.

    Raises
    ------
    BadDataSet
        Naming every file that is missing or of a format that is not read, every unknown unit, and every recording that is named twice.
    """
    base = os.path.dirname(os.path.abspath(path))
    entries = []
    for row in rows:
        places = {name: os.path.normpath(os.path.join(base, row[name])) for name in ("file", "mesh") if name in row}
        more = {name: row[name] for name in ("kind", "rate") if name in row}
        unit = units.unit_of(row.get("unit", ""))
        entries.append(
            Entry(row["subject"], row["recording"], places["file"], unit=unit, mesh=places.get("mesh"), **more)
        )
    wanted = [entry.source for entry in entries] + [entry.mesh for entry in entries if entry.mesh]
    problems = [
        f"{'not a file' if os.path.exists(file) else 'no such file'}: {file}"
        for file in dict.fromkeys(wanted)
        if not os.path.isfile(file)
    ]
    problems += [f"{entry.source} {reason}" for entry in entries if (reason := files.why_unreadable(entry.source))]
    strange = dict.fromkeys(row["unit"] for row in rows if "unit" in row and units.unit_of(row["unit"]) is None)
    problems += [f"not a unit of length ({units.KNOWN}): {unit}" for unit in strange]
    named = Counter((entry.subject, entry.recording) for entry in entries)
    problems += [f"twice: recording {name} of subject {subject}" for (subject, name), n in named.items() if n > 1]
    if problems:
        raise BadDataSet("\n".join([f"recordings: {path} cannot be used", *problems]))
    return sorted(entries, key=lambda entry: (entry.subject, entry.recording))
