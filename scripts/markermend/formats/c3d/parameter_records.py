"""One record of the parameter section of a C3D file, a group or a parameter, decoded with every length checked."""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from markermend.formats.c3d.encoding import Coding

TEXT, BYTE, INTEGER, FLOAT = -1, 1, 2, 4
"""Types of parameters: bytes per value, negative for text."""

MOST_DIMENSIONS = 7
"""Of a parameter."""

Values = Sequence[str] | Sequence[float]


class UnsoundRecordError(Exception):
    """A record that does not fit its section."""


@dataclass(frozen=True)
class Record:
    """A group or a parameter.

    Attributes
    ----------
    identity : int
        Number of the group; negative for the group itself, positive for its parameters, 0 at the end of the chain.
    name : str
        In capitals.
    body : bytes
        What follows the name and the offset.
    following : int or None
        Where the next record begins; None after the last one.
    """

    identity: int
    name: str
    body: bytes
    following: int | None


def decode_record(head: bytes, position: int, limit: int, coding: Coding) -> Record:
    """Decode the record at a position; an offset of 0, or one that leaves the section, marks the last.

    Parameters
    ----------
    head : bytes
        The file up to the end of its parameters.
    position, limit : int
        Where the record begins and the section ends, in bytes from the start of the file.
    coding : Coding
        How numbers are stored.

    Returns
    -------
    Record
        With identity 0 where the chain ends at the position.

    Raises
    ------
    UnsoundRecordError
        If the record exceeds the section or its name is not printable.
    """
    if position + 2 > limit:
        raise UnsoundRecordError
    length, identity = struct.unpack_from("bb", head, position)
    if length == 0 or identity == 0:
        return Record(0, "", b"", None)
    at = position + 2 + abs(length)
    if at + 2 > limit:
        raise UnsoundRecordError
    name = decode_text(head[position + 2 : at]).upper()
    if not name.isprintable():
        raise UnsoundRecordError
    (offset,) = struct.unpack_from(f"{coding.order}H", head, at)
    if offset == 0 or at + offset > limit:
        return Record(identity, name, head[at + 2 : limit], None)
    if offset == 1:
        raise UnsoundRecordError
    return Record(identity, name, head[at + 2 : at + offset], at + offset)


def decode_values(body: bytes, coding: Coding) -> Values:
    """Decode the values of a parameter.

    Parameters
    ----------
    body : bytes
        The body of its record.
    coding : Coding
        How numbers are stored.

    Returns
    -------
    sequence of str or of float
        Strings along the first dimension, or numbers, integers unsigned.

    Raises
    ------
    UnsoundRecordError
        If the type is unknown or the body is too short.
    """
    if len(body) < 2 or len(body) < 2 + body[1]:
        raise UnsoundRecordError
    (kind,) = struct.unpack_from("b", body)
    dimensions = list(body[2 : 2 + body[1]])
    if kind not in (TEXT, BYTE, INTEGER, FLOAT) or len(dimensions) > MOST_DIMENSIONS:
        raise UnsoundRecordError
    size = math.prod(dimensions) * abs(kind)
    data = body[2 + len(dimensions) :][:size]
    if len(data) < size:
        raise UnsoundRecordError
    if kind == TEXT:
        return list(_texts(data, dimensions[0] if dimensions else 1))
    if kind == BYTE:
        return list(data)
    numbers: list[float] = (coding.integers(data) if kind == INTEGER else coding.floats(data)).tolist()
    return numbers


def decode_text(data: bytes) -> str:
    """Decode text: UTF-8 where the bytes are valid, Latin-1 otherwise.

    Parameters
    ----------
    data : bytes
        The bytes.

    Returns
    -------
    str
        The text without trailing blanks.
    """
    try:
        text = data.decode()
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return text.rstrip(" \0")


def _texts(data: bytes, width: int) -> Iterator[str]:
    """Cut character data into strings of equal width."""
    for start in range(0, len(data), max(width, 1)):
        yield decode_text(data[start : start + width])
