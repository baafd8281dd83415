"""What the texts of a header state: a unit, a frame rate, a count."""

from __future__ import annotations

import re
from collections.abc import Sequence

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


def unit_shared(sheet: Sheet, texts: Sequence[str]) -> tuple[str | None, list[bool]]:
    """Give the unit of the trajectories that are positions; those in another unit than one of length (deg, N) are none.

    Parameters
    ----------
    sheet : Sheet
        The file, for error messages.
    texts : sequence of str
        The unit of each trajectory; empty where it states none.

    Returns
    -------
    unit : str or None
        A key of units.MILLIMETRES; None where none is stated.
    are_positions : list of bool
        One for each trajectory.

    Raises
    ------
    BadRecording
        If no trajectory has a unit of length although all have one, or the units of length differ.
    """
    are_positions = [not text or units.unit_of(text) is not None for text in texts]
    if texts and not any(are_positions):
        unit_named(sheet, texts[0])
    named = {unit_named(sheet, text) for text, own in zip(texts, are_positions, strict=True) if own and text}
    if len(named) > 1:
        raise BadRecording(f"{sheet.name}: its trajectories are in several units ({', '.join(sorted(named))})")
    return next(iter(named), None), are_positions


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
