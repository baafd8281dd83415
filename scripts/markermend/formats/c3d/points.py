"""The points of a C3D file: four numbers per point and frame, mapped into memory, decoded and encoded."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from markermend.formats.c3d.data_layout import Layout
from markermend.formats.c3d.encoding import Coding

LARGEST = 32767
"""The largest integer of a coordinate in an integer file."""

FARTHEST = 1e7
"""No laboratory has coordinates so large in mm or m: programs store them (-1e9) for what they did not see."""


def map_points(path: Path, layout: Layout, coding: Coding, *, writable: bool = False) -> np.ndarray:
    """The stored numbers of the points as an array (frames, points, 4) over the file itself."""
    data = np.memmap(path, np.uint8, "r+" if writable else "r")
    stored = coding.float_type if layout.real else coding.integer_type
    width = stored.itemsize
    shape, strides = (layout.frames, layout.points, 4), (layout.stride, 4 * width, width)
    return np.ndarray(shape, stored, buffer=data, offset=layout.start, strides=strides)


def decode(stored: np.ndarray, layout: Layout, coding: Coding) -> tuple[np.ndarray, np.ndarray]:
    """Stored numbers (frames, points, 4) as coordinates (frames, points, 3) in the file's unit, and word 4 as stored."""
    if layout.real:
        return coding.decode_floats(stored[..., :3]), coding.decode_floats(stored[..., 3])
    return stored[..., :3] * layout.scale, stored[..., 3].astype(np.float64)


def decode_word4(word4: np.ndarray, scale: float) -> tuple[np.ndarray, np.ndarray]:
    """Word 4 of points as residual, in the file's unit, and camera mask (7 bits).

    Word 4 is a signed 16-bit integer, in float files the float of one, signed or unsigned: negative means missing, and
    gives residual -1 and no camera. A word 4 that is not finite has residual NaN.
    """
    finite = np.isfinite(word4)
    whole = np.where(finite, np.clip(word4, -1.0, 65535.0), 0.0).astype(np.int64)
    missing = (whole < 0) | (whole >= 32768)
    residual = np.where(missing, -1.0, (whole & 0xFF) * scale)
    return np.where(finite, residual, np.nan), np.where(missing, 0, (whole >> 8) & 0x7F).astype(np.uint8)


def missing_clauses(positions: np.ndarray, word4: np.ndarray) -> tuple[dict[str, np.ndarray], bool]:
    """Why samples are missing, as one mask (frames, points) per clause, disjoint, and whether word 4 was believed.

    positions, word4: as decoded. A sample counts for the first clause that catches it: `residual` (word 4 is negative),
    `zero` (exactly 0, 0, 0), `not finite`, `out of range`. Where word 4 calls every real sample missing, it is not
    believed.
    """
    residual, _ = decode_word4(word4, 1.0)
    negative = residual < 0
    zero = (positions == 0).all(axis=2)
    unusable = ~(np.isfinite(positions).all(axis=2) & np.isfinite(word4))
    far = (np.abs(positions) >= FARTHEST).any(axis=2)
    real = ~(zero | unusable | far)
    believed = not (real.any() and bool(np.all(negative | ~real)))
    negative &= believed
    zero &= ~negative
    unusable &= ~negative
    far &= ~negative & ~unusable
    return {"residual": negative, "zero": zero, "not finite": unusable, "out of range": far}, believed


def encode(values: np.ndarray, layout: Layout, coding: Coding) -> tuple[np.ndarray, np.ndarray]:
    """Samples (n, 3) in the file's unit, NaN = missing, as stored numbers (n, 4), and which of them cannot be stored.

    A position gets word 4 = 0 (residual 0, no camera: not measured), a missing one zeros and -1. What exceeds the
    number format, or would become 0, 0, 0 and so read as missing, cannot be stored.
    """
    missing = np.isnan(values).any(axis=1)
    positions = np.where(missing[:, None], 0.0, values)
    word4 = np.where(missing, -1.0, 0.0)
    if layout.real:
        stored = coding.encode_floats(np.column_stack((positions, word4)))
        readable = np.asarray(np.isfinite(coding.decode_floats(stored)).all(axis=1))
        vanished = (coding.decode_floats(stored[:, :3]) == 0).all(axis=1)
    else:
        steps = np.rint(positions / layout.scale)
        readable = np.asarray((np.abs(steps) <= LARGEST).all(axis=1))
        vanished = (steps == 0).all(axis=1)
        held = np.where(readable[:, None], steps, 0.0)
        stored = np.column_stack((held, word4)).astype(coding.integer_type)
    return stored, ~readable | (vanished & ~missing)
