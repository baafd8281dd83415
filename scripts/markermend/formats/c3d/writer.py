"""New C3D files: a header, a parameter section and a data block made from arrays.

Only for recordings that have no original file, such as synthetic ones: a cleaned recording is a copy of its original.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from markermend.formats.c3d.encoding import Coding, Processor
from markermend.formats.c3d.parameter_encoding import Groups, encode_section, padded, single
from markermend.formats.c3d.parameters import KEY
from markermend.storage.atomic import replacing

STORAGES = {
    "pc_int": (Processor.INTEL, False),
    "pc_real": (Processor.INTEL, True),
    "dec_int": (Processor.DEC, False),
    "dec_real": (Processor.DEC, True),
    "sgi_int": (Processor.MIPS, False),
    "sgi_real": (Processor.MIPS, True),
}
"""Processor and whether the data are floating point, by the name of the storage."""

MAX_COUNT = 65535
"""The largest count that a 16-bit word holds."""

FULL_SCALE = 32000
"""The integer that stands for the largest coordinate."""

CAMERAS = 0x0F << 8
"""Camera mask of a measured sample in word 4: without one, and with residual 0, it would count as not measured."""


@dataclass(frozen=True, eq=False)
class Content:
    """What a new C3D file holds.

    Attributes
    ----------
    labels : sequence of str
        One for each point.
    positions : ndarray of float, shape (frames, points, 3)
        In `unit`; NaN is written as 0, 0, 0 with word 4 = -1.
    rate : float
        Frame rate in Hz.
    first_frame : int
        Number of the first frame.
    storage : str
        A key of STORAGES; the integer ones round to 1/32000 of the largest coordinate.
    unit : str
        What POINT:UNITS states.
    residuals : ndarray of float, shape (frames, points), optional
        In `unit`; negative = missing (word 4 = -1, the position is written). Without them every present sample has
        residual 0 and four cameras.
    analog : ndarray of float, shape (frames, samples, channels), optional
        Analog signals; `samples` is their number per frame.
    groups : Groups, optional
        Further parameters, which replace those made of the other fields where group and name are equal.
    """

    labels: Sequence[str]
    positions: np.ndarray
    rate: float
    first_frame: int = 1
    storage: str = "pc_real"
    unit: str = "mm"
    residuals: np.ndarray | None = None
    analog: np.ndarray | None = None
    groups: Groups | None = None

    @property
    def frames(self) -> int:
        """Number of frames."""
        return len(self.positions)


def write_new(path: Path, content: Content) -> None:
    """Write a new C3D file.

    Parameters
    ----------
    path : Path
        Where it goes.
    content : Content
        What it holds.

    Raises
    ------
    KeyError
        If the storage is unknown.
    ValueError
        If the shapes disagree, or the parameters exceed what a C3D file can hold.
    """
    processor, real = STORAGES[content.storage]
    coding, frames = Coding(processor), content.frames
    if content.positions.shape != (frames, len(content.labels), 3):
        raise ValueError(f"positions {content.positions.shape} do not fit {len(content.labels)} labels")
    scale, points = _points(content.positions, content.residuals, real)
    analog_scale, samples = _samples(np.zeros((frames, 0, 0)) if content.analog is None else content.analog, real)
    own: dict[str, dict[str, Any]] = {
        "POINT": _point_group(content, -scale if real else scale),
        "ANALOG": _analog_group(analog_scale, content.rate * samples.shape[1]),
        "TRIAL": _trial_group(content.first_frame, frames, content.rate),
    }
    for group, parameters in (content.groups or {}).items():
        own[group] = {**own.get(group, {}), **parameters}
    section = encode_section(own, coding)
    numbers = np.concatenate((points.reshape(frames, -1), samples.reshape(frames, -1)), axis=1).ravel()
    data = single(numbers, coding) if real else coding.encode_integers(np.rint(numbers)).tobytes()
    with replacing(path) as temporary, open(temporary, "wb") as file:
        file.write(_header(own["POINT"], content.first_frame, content.first_frame + frames - 1, samples.shape, coding))
        file.write(section)
        # Where 16 bits cannot hold the number of frames, readers count them by the size of the file.
        file.write(padded(data) if frames < MAX_COUNT else data)


def _header(point: dict[str, Any], first: int, last: int, samples: tuple[int, ...], coding: Coding) -> bytes:
    """The header block, which repeats some parameters; frame numbers beyond 16 bits are cut short here only."""
    counts = [point["USED"], samples[1] * samples[2], min(first, MAX_COUNT), min(last, MAX_COUNT), 0]
    return padded(
        bytes([2, KEY])
        + coding.encode_integers(counts).tobytes()
        + single(point["SCALE"], coding)
        + coding.encode_integers([point["DATA_START"], samples[1]]).tobytes()
        + single(point["RATE"], coding)
    )


def _points(positions: np.ndarray, residuals: np.ndarray | None, real: bool) -> tuple[float, np.ndarray]:
    """The scale, and coordinates and word 4 as numbers to store (frames, labels, 4)."""
    extent = float(np.nanmax(np.abs(positions), initial=0.0)) or 1.0
    scale = float(np.float32(extent / FULL_SCALE))
    missing = np.isnan(positions).any(axis=2)
    coordinates = np.where(missing[:, :, None], 0.0, positions)
    word4 = np.full(missing.shape, CAMERAS)
    if residuals is not None:
        word4 = CAMERAS + np.clip(np.rint(np.nan_to_num(residuals) / scale), 0, 255)
        missing = missing | (residuals < 0)
    word4 = np.where(missing, -1, word4)
    return scale, np.concatenate((coordinates if real else coordinates / scale, word4[:, :, None]), axis=2)


def _samples(analog: np.ndarray, real: bool) -> tuple[np.ndarray, np.ndarray]:
    """The scale of each channel, and analog samples as numbers to store (frames, samples per frame, channels)."""
    extent = np.abs(analog).max(axis=(0, 1), initial=0.0)
    scale = np.where((extent > 0) & (not real), extent / FULL_SCALE, 1.0).astype(np.float32)
    return scale, analog / scale


def _point_group(content: Content, scale: float) -> dict[str, Any]:
    """POINT parameters; DATA_START is set when the length of the section is known."""
    group = {
        "USED": len(content.labels),
        "SCALE": scale,
        "RATE": float(content.rate),
        "DATA_START": 0,
        "FRAMES": min(content.frames, MAX_COUNT),
        "LABELS": list(content.labels),
        "DESCRIPTIONS": [""] * len(content.labels),
        "UNITS": content.unit,
        "X_SCREEN": "+X",
        "Y_SCREEN": "+Z",
    }
    return {**group, "LONG_FRAMES": float(content.frames)} if content.frames > MAX_COUNT else group


def _analog_group(scale: np.ndarray, rate: float) -> dict[str, Any]:
    """ANALOG parameters; a file without analog signals states that none are used."""
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
        "ACTUAL_START_FIELD": [first_frame & MAX_COUNT, first_frame >> 16],
        "ACTUAL_END_FIELD": [last & MAX_COUNT, last >> 16],
        "CAMERA_RATE": float(rate),
    }
