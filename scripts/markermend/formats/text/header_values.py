"""What the texts of a header state: a unit, a frame rate, a count."""

from __future__ import annotations

import re

from markermend.core.recording import BadRecording
from markermend.formats import units
from markermend.formats.text.lines import Sheet, is_number


def unit_named(sheet: Sheet, text: str) -> str:
    """Give the unit of length that a text names.

    Parameters
    ----------
    sheet : Sheet
        The file, for the error message.
    text : str
        Such as "mm" or "Meters".

    Returns
    -------
    str
        A key of units.MILLIMETRES.

    Raises
    ------
    BadRecording
        If it is not a unit of length.
    """
    unit = units.unit_of(text)
    if unit is None:
        raise BadRecording(f"{sheet.name}: the unit '{text[:40]}' is not known: correct it in the file ({units.KNOWN})")
    return unit


def rate_named(text: str) -> float | None:
    """Give the frame rate that a text states.

    Parameters
    ----------
    text : str
        A cell.

    Returns
    -------
    float or None
        In Hz; None where the text is no finite number above zero.
    """
    rate = float(text.replace(",", ".")) if is_number(text) else 0.0
    return rate if 0 < rate < float("inf") else None


def count_named(text: str) -> int | None:
    """Give the count that a text states.

    Parameters
    ----------
    text : str
        A cell.

    Returns
    -------
    int or None
        The count, or None.
    """
    return int(text) if re.fullmatch(r"\d{1,12}", text) else None
