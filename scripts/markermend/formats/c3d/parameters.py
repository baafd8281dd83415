"""The header and the parameter section of a C3D file, read without trust in either.

Our own parser checks every length against the bytes that are there. Only a section that it finds sound is handed to
ezc3d, and without the data, since ezc3d reads whole files and trusts them. ezc3d does not know MIPS files.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from markermend.core.recording import BadRecording
from markermend.formats.c3d.encoding import Coding, Processor
from markermend.formats.c3d.isolated_reader import strings_by_ezc3d

BLOCK = 512
KEY = 0x50
LONGEST_SECTION = 4096 * BLOCK
"""More than the 255 blocks of the standard, for the files that exceed it."""

LONGEST_DESCRIPTION = 127

TEXT, BYTE, INTEGER, FLOAT = -1, 1, 2, 4


@dataclass(frozen=True)
class Header:
    """The first block of a C3D file: what it says of the data, right or wrong."""

    parameter_block: int
    points: int
    analog: int
    first_frame: int
    last_frame: int
    scale: float
    data_block: int
    rate: float


@dataclass
class Section:
    """The parameters of a C3D file by group and name, both in capitals, as lists of strings or numbers.

    Integers are unsigned. sound: whether every record fits the section. exact: whether, besides, each is as long as its
    contents, and no longer. end: where the records end, in bytes.
    """

    coding: Coding
    header: Header
    groups: dict[str, dict[str, list]] = field(default_factory=dict)
    sound: bool = True
    exact: bool = True
    end: int = 0

    def texts(self, group: str, name: str) -> list[str]:
        """The strings of a parameter; empty where it is absent or of another type."""
        values = self.groups.get(group, {}).get(name, [])
        return [value for value in values if isinstance(value, str)]

    def numbers(self, group: str, name: str) -> list[float]:
        """The finite numbers of a parameter; empty where it is absent or of another type."""
        values = self.groups.get(group, {}).get(name, [])
        return [value for value in values if not isinstance(value, str) and math.isfinite(value)]

    def number(self, group: str, name: str) -> float | None:
        """The first number of a parameter, or None."""
        return next(iter(self.numbers(group, name)), None)


def read_section(path: Path) -> Section:
    """Read header and parameters; raises BadRecording where the file is not a C3D file at all."""
    with open(path, "rb") as file:
        head = file.read(LONGEST_SECTION)
    if not head:
        raise BadRecording(f"{path.name} is empty (0 bytes): export it again")
    if len(head) < BLOCK or head[1] != KEY:
        raise BadRecording(f"{path.name} is not a C3D file (its second byte is not 0x50): give the real format")
    start = (head[0] - 1) * BLOCK
    if start < BLOCK or len(head) < start + 4 or head[start + 3] not in tuple(Processor):
        raise BadRecording(f"{path.name} has no C3D parameter section where its header says: export it again")
    coding = Coding(Processor(head[start + 3]))
    section = Section(coding, _header(head, coding))
    _parse(head, start + 4, section)
    readable = section.coding.processor is not Processor.MIPS
    if section.sound and section.exact and readable:
        for group, parameters in strings_by_ezc3d(_without_data(head, section)).items():
            section.groups.setdefault(group, {}).update(parameters)
    return section


def _header(head: bytes, coding: Coding) -> Header:
    """Decode the header block."""
    words = coding.integers(head[: BLOCK // 2]).tolist()
    scale, rate = coding.floats(head[12:16])[0], coding.floats(head[20:24])[0]
    return Header(head[0], words[1], words[2], words[3], words[4], float(scale), words[8], float(rate))


def _parse(head: bytes, start: int, section: Section) -> None:
    """Walk the chain of groups and parameters from `start` and put what is sound into the section."""
    names: dict[int, str] = {}
    found: list[tuple[int, str, list]] = []
    declared = max(section.header.data_block - 1, section.header.parameter_block - 1 + head[start - 2]) * BLOCK
    limit = min(declared, len(head))
    position: int | None = start
    while position is not None:
        section.end = position
        try:
            identity, name, body, position = _record(head, position, limit, section.coding)
        except _UnsoundError:
            section.sound = False
            break
        if identity and position is None:
            section.end = limit
        try:
            if identity < 0:
                names[-identity] = name
                length = 0
            elif identity > 0:
                values, length = _values(body, section.coding)
                found.append((identity, name, values))
            section.exact &= identity == 0 or _described(body[length:], whole=position is not None)
        except _UnsoundError:
            section.sound = False
    for identity, name, values in found:
        section.sound &= identity in names
        section.groups.setdefault(names.get(identity, ""), {}).setdefault(name, values)


class _UnsoundError(Exception):
    """A record that does not fit its section."""


def _record(head: bytes, position: int, limit: int, coding: Coding) -> tuple[int, str, bytes, int | None]:
    """One record: group number (negative for a group, 0 at the end), name, body, and where the next begins.

    An offset of 0, or one that leaves the section, marks the last record.
    """
    if position + 2 > limit:
        raise _UnsoundError
    length, identity = struct.unpack_from("bb", head, position)
    if length == 0 or identity == 0:
        return 0, "", b"", None
    at = position + 2 + abs(length)
    if at + 2 > limit:
        raise _UnsoundError
    name = _text(head[position + 2 : at]).upper()
    if not name.isprintable():
        raise _UnsoundError
    (offset,) = struct.unpack_from(f"{coding.order}H", head, at)
    if offset == 0 or at + offset > limit:
        return identity, name, head[at + 2 : limit], None
    if offset == 1:
        raise _UnsoundError
    return identity, name, head[at + 2 : at + offset], at + offset


def _described(rest: bytes, *, whole: bool) -> bool:
    """Tell whether what follows the contents of a record is a description, and (`whole`) nothing else."""
    if not rest or rest[0] > LONGEST_DESCRIPTION:
        return False
    return len(rest) == 1 + rest[0] if whole else len(rest) >= 1 + rest[0]


def _values(body: bytes, coding: Coding) -> tuple[list, int]:
    """The values of a parameter record (strings along the first dimension, or numbers), and how many bytes they take."""
    if len(body) < 2 or len(body) < 2 + body[1]:
        raise _UnsoundError
    (kind,) = struct.unpack_from("b", body)
    dimensions = list(body[2 : 2 + body[1]])
    if kind not in (TEXT, BYTE, INTEGER, FLOAT) or len(dimensions) > 7:
        raise _UnsoundError
    size = math.prod(dimensions) * abs(kind)
    length = 2 + len(dimensions) + size
    data = body[2 + len(dimensions) : length]
    if len(data) < size:
        raise _UnsoundError
    if kind == TEXT:
        return list(_texts(data, dimensions[0] if dimensions else 1)), length
    if kind == BYTE:
        return list(data), length
    return (coding.integers(data) if kind == INTEGER else coding.floats(data)).tolist(), length


def _texts(data: bytes, width: int) -> Iterator[str]:
    """Cut character data into strings of equal width."""
    for start in range(0, len(data), max(width, 1)):
        yield _text(data[start : start + width])


def _text(data: bytes) -> str:
    """Bytes as text, without trailing blanks: UTF-8 where that is what they are, Latin-1 otherwise."""
    try:
        text = data.decode()
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return text.rstrip(" \0")


def _without_data(head: bytes, section: Section) -> bytes:
    """A C3D file with the parameter section and nothing behind it, under a header that declares no data."""
    start = (section.header.parameter_block - 1) * BLOCK
    parameters = bytearray(head[start : section.end]) + bytes(2)
    parameters += bytes(-len(parameters) % BLOCK)
    parameters[2] = min(len(parameters) // BLOCK, 255)
    words = np.zeros(BLOCK // 2, f"{section.coding.order}u2")
    words[3], words[4], words[8] = 1, 0, len(parameters) // BLOCK + 2
    return bytes((2, KEY)) + words.tobytes()[2:] + bytes(parameters)
