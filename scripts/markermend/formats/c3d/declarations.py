"""What header and parameters of a C3D file declare about its data, each quantity with all its candidate values."""

from __future__ import annotations

import math

from markermend.formats.c3d.parameters import BLOCK, Section
from markermend.formats.notes import Note

SATURATED = 65535
"""The largest count that a 16-bit word holds; longer recordings store it, or the remainder."""


def whole_numbers(*values: float | None) -> list[int]:
    """Choose the whole numbers among candidate values.

    Parameters
    ----------
    *values : float or None
        Candidates, the most reliable first.

    Returns
    -------
    list of int
        Those that are not negative, each once, in order; [0] where there are none.
    """
    whole = [int(value) for value in values if value is not None and 0 <= value < 2**31]
    return list(dict.fromkeys(whole)) or [0]


def starts(section: Section, size: int) -> list[int]:
    """List the bytes at which the data may start.

    Parameters
    ----------
    section : Section
        Header and parameters.
    size : int
        Bytes of the file.

    Returns
    -------
    list of int
        By POINT:DATA_START and by the header where these are possible; else right after the parameters.
    """
    header = section.header
    blocks = whole_numbers(section.number("POINT", "DATA_START"), header.data_block)
    after = math.ceil((section.end + 2) / BLOCK)
    usable = [block for block in blocks if block > header.parameter_block and (block - 1) * BLOCK < size]
    return [(block - 1) * BLOCK for block in usable] or [after * BLOCK]


def points(section: Section) -> list[int]:
    """List the candidate numbers of points per frame.

    Parameters
    ----------
    section : Section
        Header and parameters.

    Returns
    -------
    list of int
        By POINT:USED and by the header.
    """
    return whole_numbers(section.number("POINT", "USED"), section.header.points)


def analog_samples(section: Section) -> list[int]:
    """List the candidate numbers of analog samples per frame.

    Parameters
    ----------
    section : Section
        Header and parameters.

    Returns
    -------
    list of int
        By the ANALOG group and by the header.
    """
    used, rate = section.number("ANALOG", "USED"), section.number("ANALOG", "RATE")
    point_rate = section.number("POINT", "RATE")
    declared: float | None = None
    if used == 0:
        declared = 0
    elif used is not None and rate and point_rate:
        declared = used * round(min(rate / point_rate, SATURATED))
    return whole_numbers(declared, section.header.analog)


def storages(section: Section) -> list[bool]:
    """List whether the data may be floating point.

    Parameters
    ----------
    section : Section
        Header and parameters.

    Returns
    -------
    list of bool
        By the signs of the scales, which are negative for floating point; both where no scale is usable.
    """
    usable = [scale for scale in (section.number("POINT", "SCALE"), section.header.scale) if is_usable(scale)]
    return list(dict.fromkeys(scale < 0 for scale in usable if scale is not None)) or [True, False]


def scale(section: Section) -> float | None:
    """Give the size of an integer step.

    Parameters
    ----------
    section : Section
        Header and parameters.

    Returns
    -------
    float or None
        In the file's unit, by POINT:SCALE or else by the header; None where neither is usable.
    """
    candidates = (section.number("POINT", "SCALE"), section.header.scale)
    return next((abs(value) for value in candidates if value is not None and is_usable(value)), None)


def is_usable(scale: float | None) -> bool:
    """Decide whether a scale is finite and not zero.

    Parameters
    ----------
    scale : float or None
        The scale, None where it is absent.

    Returns
    -------
    bool
        Whether it can be used.
    """
    return bool(scale) and scale is not None and math.isfinite(scale)


def frames(section: Section) -> list[int]:
    """List the candidate numbers of frames.

    Parameters
    ----------
    section : Section
        Header and parameters.

    Returns
    -------
    list of int
        The most reliable first.
    """
    first, last = (frame_field(section, f"ACTUAL_{end}_FIELD") for end in ("START", "END"))
    spanned = None if first is None or last is None else last - first + 1
    declared = (
        section.number("POINT", "LONG_FRAMES"),
        spanned if spanned is not None and spanned > SATURATED else None,
        section.number("POINT", "FRAMES"),
        spanned,
        section.header.last_frame - section.header.first_frame + 1,
    )
    return whole_numbers(*(value for value in declared if value is not None and value >= 1))


def frame_field(section: Section, name: str) -> int | None:
    """Give a frame number of the TRIAL group, which is stored as a low and a high word, or as one number.

    Parameters
    ----------
    section : Section
        Header and parameters.
    name : str
        Of the parameter.

    Returns
    -------
    int or None
        The number; None where the parameter is absent or impossible.
    """
    words = section.numbers("TRIAL", name)
    if not words or any(word < 0 or word > 2**31 for word in words):
        return None
    return int(words[0]) + (int(words[1]) * (SATURATED + 1) if len(words) > 1 else 0)


def first_frame(section: Section, held: int) -> tuple[int, list[str]]:
    """Determine the capture program's number of the first frame.

    Parameters
    ----------
    section : Section
        Header and parameters.
    held : int
        How many frames the file holds.

    Returns
    -------
    number : int
        Of the parameters, if they agree with the header or with the frames that the file holds; else of the header.
    warnings : list of str
        One sentence each.
    """
    stated, written = frame_field(section, "ACTUAL_START_FIELD"), section.header.first_frame
    if stated is None or stated == written:
        return written, []
    last = frame_field(section, "ACTUAL_END_FIELD")
    agrees = stated % (SATURATED + 1) == written or (last is not None and last - stated + 1 == held)
    used = stated if agrees else written
    if stated % (SATURATED + 1) == written:
        return used, []
    return used, [
        f"The first frame is {written} by the header and {stated} by TRIAL:ACTUAL_START_FIELD; {used} is used."
    ]


def frame_rate(section: Section) -> tuple[float, list[str]]:
    """Determine the frame rate.

    Parameters
    ----------
    section : Section
        Header and parameters.

    Returns
    -------
    rate : float
        POINT:RATE, else the header's, in Hz; NaN where neither is usable.
    warnings : list of str
        One sentence each.
    """
    stated, written = section.number("POINT", "RATE"), section.header.rate
    usable = [rate for rate in (stated, written) if rate is not None and math.isfinite(rate) and rate > 0]
    warnings: list[str] = []
    if stated is not None and stated in usable and written in usable and abs(written / stated - 1) > 0.001:
        warnings.append(f"The rate is {written:g} Hz by the header and {stated:g} Hz by POINT:RATE, which is used.")
    elif usable and stated not in usable:
        warnings.append(Note(f"POINT:RATE is missing or unusable; the header's {written:g} Hz is used."))
    return (float(usable[0]) if usable else math.nan), warnings
