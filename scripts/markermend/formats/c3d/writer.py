"""New C3D files: a header, a parameter section and a data block made from arrays.

Only for recordings that have no original file, such as synthetic ones: a cleaned recording is a copy of its original.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from markermend.storage.atomic import replacing

STORAGES = {
    "pc_int": (84, False),
    "pc_real": (84, True),
    "dec_int": (85, False),
    "dec_real": (85, True),
    "sgi_int": (86, False),
    "sgi_real": (86, True),
}
"""Processor code and whether the data are floating point, by the name of the storage."""

BLOCK = 512
MOST = 65535
"""The largest count that a 16-bit word holds."""

LONGEST = 255
"""The largest dimension of a parameter; longer lists go on in NAME2, NAME3."""

FULL_SCALE = 32000
"""The integer that stands for the largest coordinate."""

CAMERAS = 0x0F << 8
"""Camera mask of a measured sample in word 4: without one, and with residual 0, it would count as not measured."""

Groups = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Words:
    """Numbers as bytes in the byte order and floating point format of one processor."""

    processor: int

    def integers(self, values: Any) -> bytes:
        """16-bit integers, signed or unsigned."""
        order = ">" if self.processor == 86 else "<"
        return (np.atleast_1d(np.asarray(values, np.int64)) & 0xFFFF).astype(f"{order}u2").tobytes("F")

    def reals(self, values: Any) -> bytes:
        """32-bit floats; those of DEC are four times the IEEE number with the 16-bit halves swapped."""
        single = np.atleast_1d(np.asarray(values, np.float32))
        if self.processor != 85:
            return single.astype(">f4" if self.processor == 86 else "<f4").tobytes("F")
        positive_zero = single * np.float32(4) + np.float32(0)
        halves = np.frombuffer(positive_zero.astype("<f4").tobytes("F"), "<u2").reshape(-1, 2)
        return halves[:, ::-1].tobytes()

    def parameter(self, value: Any) -> bytes:
        """Type, dimensions and data of a parameter: text, list of texts, or numbers of any shape."""
        if isinstance(value, str):
            text = value.encode()
            return struct.pack("bBB", -1, 1, len(text)) + text
        if isinstance(value, list | tuple) and value and isinstance(value[0], str):
            texts = [text.encode() for text in value]
            width = max(1, *map(len, texts))
            return struct.pack("bBBB", -1, 2, width, len(texts)) + b"".join(text.ljust(width) for text in texts)
        numbers = np.asarray(value)
        kind = 4 if numbers.dtype.kind == "f" else 2
        data = self.reals(numbers) if kind == 4 else self.integers(numbers)
        return struct.pack(f"bB{numbers.ndim}B", kind, numbers.ndim, *numbers.shape) + data

    def entry(self, name: str, group: int, content: bytes) -> bytes:
        """A group (negative number) or parameter (positive) of the parameter section."""
        offset = 2 + len(content) + 1
        return struct.pack("bb", len(name), group) + name.encode() + self.integers(offset) + content + b"\0"


def write_new(
    path: Path,
    *,
    labels: Sequence[str],
    positions: np.ndarray,
    rate: float,
    first_frame: int = 1,
    storage: str = "pc_real",
    unit: str = "mm",
    residuals: np.ndarray | None = None,
    analog: np.ndarray | None = None,
    groups: Groups | None = None,
) -> None:
    """Write a new C3D file.

    positions: (frames, labels, 3) in `unit`; NaN is written as 0, 0, 0 with word 4 = -1. rate: Hz. storage: one of
    STORAGES; the integer ones round to 1/32000 of the largest coordinate. residuals: (frames, labels) in `unit`,
    negative = missing (word 4 = -1, the position is kept); without them every present sample has residual 0 and four
    cameras. analog: (frames, samples per frame, channels). groups: further parameters by group and name, which replace
    those written here where the names are equal. Raises KeyError on an unknown storage, and ValueError where the
    shapes disagree or the parameters exceed what a C3D file can hold.
    """
    processor, real = STORAGES[storage]
    words, frames = Words(processor), len(positions)
    if positions.shape != (frames, len(labels), 3):
        raise ValueError(f"positions {positions.shape} do not fit {len(labels)} labels")
    scale, points = _points(positions, residuals, real)
    analog_scale, samples = _samples(np.zeros((frames, 0, 0)) if analog is None else analog, real)
    own: dict[str, dict[str, Any]] = {
        "POINT": _point_group(labels, frames, rate, -scale if real else scale, unit),
        "ANALOG": _analog_group(analog_scale, rate * samples.shape[1]),
        "TRIAL": _trial_group(first_frame, frames, rate),
    }
    for group, parameters in (groups or {}).items():
        own[group] = {**own.get(group, {}), **parameters}
    section = _parameter_section(own, words)
    numbers = np.concatenate((points.reshape(frames, -1), samples.reshape(frames, -1)), axis=1).ravel()
    data = words.reals(numbers) if real else words.integers(np.rint(numbers))
    with replacing(path) as temporary, open(temporary, "wb") as file:
        file.write(_header(own["POINT"], first_frame, first_frame + frames - 1, samples.shape, words))
        file.write(section)
        # Where 16 bits cannot hold the number of frames, readers count them by the size of the file.
        file.write(_padded(data) if frames < MOST else data)


def _header(point: dict[str, Any], first: int, last: int, samples: tuple[int, ...], words: Words) -> bytes:
    """The header block, which repeats some parameters; frame numbers beyond 16 bits are cut short here only."""
    return _padded(
        b"\x02\x50"
        + words.integers([point["USED"], samples[1] * samples[2], min(first, MOST), min(last, MOST), 0])
        + words.reals(point["SCALE"])
        + words.integers([point["DATA_START"], samples[1]])
        + words.reals(point["RATE"])
    )


def _points(positions: np.ndarray, residuals: np.ndarray | None, real: bool) -> tuple[float, np.ndarray]:
    """The scale, and coordinates and word 4 as numbers to store (frames, labels, 4)."""
    extent = float(np.nanmax(np.abs(positions), initial=0.0)) or 1.0
    scale = float(np.float32(extent / FULL_SCALE))
    absent = np.isnan(positions).any(axis=2)
    coordinates = np.where(absent[:, :, None], 0.0, positions)
    word = np.full(absent.shape, CAMERAS)
    if residuals is not None:
        word = CAMERAS + np.clip(np.rint(np.nan_to_num(residuals) / scale), 0, 255)
        absent = absent | (residuals < 0)
    word = np.where(absent, -1, word)
    return scale, np.concatenate((coordinates if real else coordinates / scale, word[:, :, None]), axis=2)


def _samples(analog: np.ndarray, real: bool) -> tuple[np.ndarray, np.ndarray]:
    """The scale of each channel, and analog samples as numbers to store (frames, samples per frame, channels)."""
    extent = np.abs(analog).max(axis=(0, 1), initial=0.0)
    scale = np.where((extent > 0) & (not real), extent / FULL_SCALE, 1.0).astype(np.float32)
    return scale, analog / scale


def _point_group(labels: Sequence[str], frames: int, rate: float, scale: float, unit: str) -> dict[str, Any]:
    """POINT parameters; DATA_START is set when the length of the section is known."""
    group = {
        "USED": len(labels),
        "SCALE": scale,
        "RATE": float(rate),
        "DATA_START": 0,
        "FRAMES": min(frames, MOST),
        "LABELS": list(labels),
        "DESCRIPTIONS": [""] * len(labels),
        "UNITS": unit,
        "X_SCREEN": "+X",
        "Y_SCREEN": "+Z",
    }
    return {**group, "LONG_FRAMES": float(frames)} if frames > MOST else group


def _analog_group(scale: np.ndarray, rate: float) -> dict[str, Any]:
    """ANALOG parameters; a file without analog signals says so."""
    if not len(scale):
        return {"USED": 0}
    return {
        "USED": len(scale),
        "RATE": float(rate),
        "GEN_SCALE": 1.0,
        "SCALE": scale,
        "OFFSET": np.zeros(len(scale), int),
        "LABELS": [f"A{channel + 1}" for channel in range(len(scale))],
        "DESCRIPTIONS": [""] * len(scale),
        "UNITS": ["V"] * len(scale),
        "FORMAT": "SIGNED",
        "BITS": 16,
    }


def _trial_group(first_frame: int, frames: int, rate: float) -> dict[str, Any]:
    """TRIAL parameters: frame numbers of any size as low and high word."""
    last = first_frame + frames - 1
    return {
        "ACTUAL_START_FIELD": [first_frame & MOST, first_frame >> 16],
        "ACTUAL_END_FIELD": [last & MOST, last >> 16],
        "CAMERA_RATE": float(rate),
    }


def _parameter_section(groups: dict[str, dict[str, Any]], words: Words) -> bytes:
    """The parameter section in whole blocks; sets POINT:DATA_START, whose size does not depend on its value."""
    for _ in range(2):
        entries = []
        for number, (group, parameters) in enumerate(groups.items(), start=1):
            entries.append(words.entry(group, -number, b""))
            for name, value in _split(parameters):
                entries.append(words.entry(name, number, words.parameter(value)))
        length = 4 + sum(map(len, entries)) + 2
        blocks = -(-length // BLOCK)
        groups["POINT"]["DATA_START"] = 2 + blocks
    if blocks > LONGEST:
        raise ValueError(f"the parameters need {blocks} blocks, a C3D file holds at most {LONGEST}")
    return _padded(bytes([1, 0x50, blocks, words.processor]) + b"".join(entries) + b"\0\0")


def _split(parameters: Mapping[str, Any]) -> list[tuple[str, Any]]:
    """Parameters with lists of over 255 entries divided into NAME, NAME2, NAME3."""
    divided: list[tuple[str, Any]] = []
    for name, value in parameters.items():
        parts: Sequence[Any] = [value]
        if not isinstance(value, str) and np.ndim(value) == 1 and len(value) > LONGEST:
            parts = [value[i : i + LONGEST] for i in range(0, len(value), LONGEST)]
        divided += [(f"{name}{part + 1}" if part else name, content) for part, content in enumerate(parts)]
    return divided


def _padded(content: bytes) -> bytes:
    """Bytes filled up with zeros to whole blocks."""
    return content + b"\0" * (-len(content) % BLOCK)
