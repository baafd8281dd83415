"""Units of length in files: their names, which one is meant where a file names none, and the largest coordinate."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.formats.notes import Note

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "dm": 100.0, "m": 1000.0, "in": 25.4, "ft": 304.8}
"""Length of each unit in mm."""

_NAMES = {
    **{unit: unit for unit in MILLIMETRES},
    **{
        f"{prefix}{name}": unit
        for prefix, unit in {"milli": "mm", "centi": "cm", "deci": "dm", "": "m"}.items()
        for name in ("meter", "meters", "metre", "metres")
    },
    **{"mill": "mm", "cent": "cm", "deci": "dm", "mete": "m", "metr": "m"},  # cut to four letters
    **dict.fromkeys(("inch", "inches"), "in"),
    **dict.fromkeys(("foot", "feet"), "ft"),
}
"""The unit that each name stands for, in small letters."""

KNOWN = "mm, cm, dm, m, in (inch) or ft (feet)"
"""The units for messages."""

LARGEST = 1e7
"""Coordinates of this size or more are no positions, in any unit: programs write such numbers (-1e9) for missing samples."""

LARGEST_IN_METRES = 20.0
"""Coordinates that stay below this are metres: a capture volume in mm exceeds it, one in metres does not."""

SMALLEST_IN_MILLIMETRES = 200.0
"""Where 5 % of the coordinates exceed this they are millimetres: no capture volume has so many metres."""

ROWS_FOR_UNIT = 1000
"""About how many rows of coordinates, evenly spaced, the unit is inferred from."""


def unit_of(name: str) -> str | None:
    """Give the unit of length that a name stands for.

    Parameters
    ----------
    name : str
        As a file has it, in any case of letters, with or without blanks and brackets around it, or a full stop after it.

    Returns
    -------
    str or None
        A key of MILLIMETRES; None where the name is not that of a unit of length.
    """
    return _NAMES.get(name.strip(" \t\0()[].").lower())


def settle(stated: Sequence[str | None], *, given: str | None, coordinates: np.ndarray) -> tuple[list[str], list[str]]:
    """Decide on the unit of each trajectory of a file.

    Parameters
    ----------
    stated : sequence of str or None
        What the file states of each, a key of MILLIMETRES; None where it states none.
    given : str or None
        The unit in the recordings table, which takes precedence; None where it has none.
    coordinates : ndarray of float, shape (rows, ...)
        In the file's unit. Values that are NaN, infinite, zero, or too large for a position do not count.

    Returns
    -------
    used : list of str
        The unit of each trajectory. Where nobody states one, it is m if 95 % of the coordinates are below LARGEST_IN_METRES, else mm.
    warnings : list of str
        What was assumed, or is implausible, one sentence each; a Note where there is no doubt.
    """
    named = list(dict.fromkeys(unit for unit in stated if unit is not None))
    if given is not None:
        replaced = ", ".join(unit for unit in named if unit != given)
        warnings = [f"The file's unit is {replaced}; {given} of the recordings table is used."] if replaced else []
        return [given] * len(stated), warnings
    size = _typical_size(coordinates)
    assumed = "m" if 0 < size < LARGEST_IN_METRES else "mm"
    used = [assumed if unit is None else unit for unit in stated]
    wrong = "The file's unit is {}, but the coordinates are so {} that they may be {}: if so, state the `unit` in the recordings table."
    if None in stated and size > SMALLEST_IN_MILLIMETRES:
        return used, [Note("The file states no unit; its coordinates are mm, being too large for m.")]
    if None in stated:
        return used, [f"The file states no unit; by the size of its coordinates, {assumed} is assumed."]
    if "mm" in named and assumed == "m":
        return used, [wrong.format("mm", "small", "metres")]
    if "m" in named and size > SMALLEST_IN_MILLIMETRES:
        return used, [wrong.format("m", "large", "millimetres")]
    return used, []


def _typical_size(coordinates: np.ndarray) -> float:
    """The 95th percentile of the sizes of coordinates; NaN, zero and what is too large for a position do not count (0 if none does)."""
    sizes = np.abs(coordinates[:: max(1, len(coordinates) // ROWS_FOR_UNIT)])
    sizes = sizes[(sizes > 0) & (sizes < LARGEST)]
    return float(np.percentile(sizes, 95)) if sizes.size else 0.0
