"""The header and the parameter section of a C3D file; neither is assumed to be right.

Every length is checked against the bytes that are present.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

from markermend.core.recording import BadRecording
from markermend.formats.c3d.encoding import Coding, Processor
from markermend.formats.c3d.parameter_records import (
    UnsoundRecordError,
    Values,
    decode_record,
    decode_values,
)

BLOCK = 512
"""Bytes of a block, in which header, parameters and data are measured."""

KEY = 0x50
"""The second byte of every C3D file."""

LONGEST_SECTION = 4096 * BLOCK
"""More than the 255 blocks of the standard, for the files that exceed it."""


@dataclass(frozen=True)
class Header:
    """The first block of a C3D file: what it declares, right or wrong.

    Attributes
    ----------
    parameter_block, data_block : int
        Where parameters and data begin, in blocks counted from 1.
    points, analog : int
        Points, and analog samples, per frame.
    first_frame, last_frame : int
        The capture program's numbers of the first and the last frame.
    scale : float
        Size of an integer step in the file's unit; negative for floating point data.
    rate : float
        In Hz.
    """

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
    """The parameters of a C3D file.

    Attributes
    ----------
    coding : Coding
        How numbers are stored in the file.
    header : Header
        The first block of the file.
    groups : dict of str to dict of str to Values
        Parameters by group and name, both in capitals; integers are unsigned.
    sound : bool
        Whether every record fits the section.
    end : int
        Where the records end, in bytes.
    """

    coding: Coding
    header: Header
    groups: dict[str, dict[str, Values]] = field(default_factory=dict)
    sound: bool = True
    end: int = 0

    def texts(self, group: str, name: str) -> list[str]:
        """Give the strings of a parameter.

        Parameters
        ----------
        group, name : str
            Of the parameter, in capitals.

        Returns
        -------
        list of str
            None where it is absent or of another type.
        """
        values = self.groups.get(group, {}).get(name, [])
        return [value for value in values if isinstance(value, str)]

    def numbers(self, group: str, name: str) -> list[float]:
        """Give the finite numbers of a parameter.

        Parameters
        ----------
        group, name : str
            Of the parameter, in capitals.

        Returns
        -------
        list of float
            None where it is absent or of another type.
        """
        values = self.groups.get(group, {}).get(name, [])
        return [value for value in values if not isinstance(value, str) and math.isfinite(value)]

    def number(self, group: str, name: str) -> float | None:
        """Give the first number of a parameter.

        Parameters
        ----------
        group, name : str
            Of the parameter, in capitals.

        Returns
        -------
        float or None
            None where it is absent or of another type.
        """
        return next(iter(self.numbers(group, name)), None)


def read_section(path: Path) -> Section:
    """Read the header and the parameters of a file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    Section
        What could be read, with `sound` False where records are damaged.

    Raises
    ------
    BadRecording
        If it is not a C3D file at all.
    """
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
    return section


def _header(head: bytes, coding: Coding) -> Header:
    """Decode the header block."""
    words = coding.integers(head[: BLOCK // 2]).tolist()
    scale, rate = coding.floats(head[12:16])[0], coding.floats(head[20:24])[0]
    return Header(head[0], words[1], words[2], words[3], words[4], float(scale), words[8], float(rate))


def _parse(head: bytes, start: int, section: Section) -> None:
    """Walk the chain of groups and parameters from `start` and put what is sound into the section."""
    names: dict[int, str] = {}
    found: list[tuple[int, str, Values]] = []
    declared = max(section.header.data_block - 1, section.header.parameter_block - 1 + head[start - 2]) * BLOCK
    limit = min(declared, len(head))
    position: int | None = start
    while position is not None:
        section.end = position
        try:
            record = decode_record(head, position, limit, section.coding)
        except UnsoundRecordError:
            section.sound = False
            break
        position = record.following
        if record.identity and position is None:
            section.end = limit
        try:
            if record.identity < 0:
                names[-record.identity] = record.name
            elif record.identity > 0:
                found.append((record.identity, record.name, decode_values(record.body, section.coding)))
        except UnsoundRecordError:
            section.sound = False
    for identity, name, values in found:
        section.sound &= identity in names
        section.groups.setdefault(names.get(identity, ""), {}).setdefault(name, values)
