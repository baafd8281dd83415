"""The parameter section of a new C3D file: groups and parameters encoded into whole blocks."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from markermend.formats.c3d.encoding import Coding
from markermend.formats.c3d.parameter_records import FLOAT, INTEGER, TEXT
from markermend.formats.c3d.parameters import BLOCK, KEY

LARGEST_DIMENSION = 255
"""Of a parameter; longer lists go on in NAME2, NAME3. It is also the largest number of blocks."""

Groups = Mapping[str, Mapping[str, Any]]
"""Values of parameters by group and name."""


def encode_section(groups: dict[str, dict[str, Any]], coding: Coding) -> bytes:
    """Encode groups and parameters, and set POINT:DATA_START, which depends on their length.

    Parameters
    ----------
    groups : dict of str to dict of str to Any
        Text, lists of texts, or numbers of any shape, by group and name. POINT:DATA_START is changed.
    coding : Coding
        How numbers are stored.

    Returns
    -------
    bytes
        The section, in whole blocks.

    Raises
    ------
    ValueError
        If the parameters exceed what a C3D file can hold.
    """
    for _ in range(2):  # the size of DATA_START does not depend on its value
        entries = []
        for number, (group, parameters) in enumerate(groups.items(), start=1):
            entries.append(encode_record(group, -number, b"", coding))
            for name, value in _split(parameters):
                entries.append(encode_record(name, number, encode_values(value, coding), coding))
        length = 4 + sum(map(len, entries)) + 2
        blocks = -(-length // BLOCK)
        groups["POINT"]["DATA_START"] = 2 + blocks
    if blocks > LARGEST_DIMENSION:
        raise ValueError(f"the parameters need {blocks} blocks, a C3D file holds at most {LARGEST_DIMENSION}")
    return padded(bytes([1, KEY, blocks, coding.processor]) + b"".join(entries) + b"\0\0")


def encode_record(name: str, group: int, content: bytes, coding: Coding) -> bytes:
    """Encode a record of the parameter section.

    Parameters
    ----------
    name : str
        Of the group or parameter.
    group : int
        Number of the group; negative for the group itself, positive for its parameters.
    content : bytes
        What encode_values gives; nothing for a group.
    coding : Coding
        How numbers are stored.

    Returns
    -------
    bytes
        The record, without a description.
    """
    offset = 2 + len(content) + 1
    return struct.pack("bb", len(name), group) + name.encode() + _integers(offset, coding) + content + b"\0"


def encode_values(value: Any, coding: Coding) -> bytes:
    """Encode type, dimensions and data of a parameter.

    Parameters
    ----------
    value : Any
        Text, a list of texts, or numbers of any shape.
    coding : Coding
        How numbers are stored.

    Returns
    -------
    bytes
        Integers as 16-bit, other numbers as 32-bit floats.
    """
    if isinstance(value, str):
        text = value.encode()
        return struct.pack("bBB", TEXT, 1, len(text)) + text
    if isinstance(value, list | tuple) and value and isinstance(value[0], str):
        texts = [text.encode() for text in value]
        width = max(1, *map(len, texts))
        return struct.pack("bBBB", TEXT, 2, width, len(texts)) + b"".join(text.ljust(width) for text in texts)
    numbers = np.asarray(value)
    kind = FLOAT if numbers.dtype.kind == "f" else INTEGER
    data = single(numbers, coding) if kind == FLOAT else _integers(numbers, coding)
    return struct.pack(f"bB{numbers.ndim}B", kind, numbers.ndim, *numbers.shape) + data


def single(values: Any, coding: Coding) -> bytes:
    """Encode numbers as 32-bit floats.

    Parameters
    ----------
    values : array_like
        In any shape.
    coding : Coding
        How numbers are stored.

    Returns
    -------
    bytes
        The numbers, the first dimension fastest.
    """
    rounded = np.asarray(values, np.float32).astype(np.float64)
    return coding.encode_floats(rounded).tobytes("F")


def padded(content: bytes) -> bytes:
    """Fill bytes up with zeros to whole blocks.

    Parameters
    ----------
    content : bytes
        The bytes.

    Returns
    -------
    bytes
        As many as a multiple of the block.
    """
    return content + b"\0" * (-len(content) % BLOCK)


def _integers(values: Any, coding: Coding) -> bytes:
    """16-bit integers, the first dimension fastest."""
    return coding.encode_integers(values).tobytes("F")


def _split(parameters: Mapping[str, Any]) -> list[tuple[str, Any]]:
    """Parameters with lists of over 255 entries divided into NAME, NAME2, NAME3."""
    divided: list[tuple[str, Any]] = []
    for name, value in parameters.items():
        parts: Sequence[Any] = [value]
        if not isinstance(value, str) and np.ndim(value) == 1 and len(value) > LARGEST_DIMENSION:
            parts = [value[i : i + LARGEST_DIMENSION] for i in range(0, len(value), LARGEST_DIMENSION)]
        divided += [(f"{name}{part + 1}" if part else name, content) for part, content in enumerate(parts)]
    return divided
