"""Units of length in files: their names, which one is meant where a file names none, and the largest coordinate."""

from __future__ import annotations

import numpy as np

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

LARGEST = 1e7
"""Coordinates of this size or more are no positions, in any unit: programs write such numbers (-1e9) for missing samples."""

LARGEST_IN_METRES = 20.0
"""Coordinates that stay below this are metres: a capture volume in mm exceeds it, one in metres does not."""

ROWS_FOR_UNIT = 1000
"""About how many rows of coordinates, evenly spaced, the unit is inferred from."""


def unit_of(name: str) -> str | None:
    """Give the unit of length that a name stands for.

    Parameters
    ----------
    name : str
        As a file has it, in any case of letters, with or without blanks around it.

    Returns
    -------
    str or None
        A key of MILLIMETRES; None where the name is not that of a unit of length.
    """
    return _NAMES.get(name.strip().lower())


def are_likely_metres(coordinates: np.ndarray) -> bool:
    """Decide whether coordinates are so small that they are metres and not millimetres.

    Parameters
    ----------
    coordinates : ndarray of float, shape (rows, ...)
        In the file's unit. Values that are NaN, infinite, zero, or too large for a position do not count.

    Returns
    -------
    bool
        True where 95 % of the coordinates that count are below LARGEST_IN_METRES; False where none counts.
    """
    sizes = np.abs(coordinates[:: max(1, len(coordinates) // ROWS_FOR_UNIT)])
    sizes = sizes[(sizes > 0) & (sizes < LARGEST)]
    return sizes.size > 0 and float(np.percentile(sizes, 95)) < LARGEST_IN_METRES
