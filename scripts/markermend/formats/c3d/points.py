"""The points of a C3D file: four numbers per point and frame, mapped into memory, decoded and encoded."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from markermend.formats.c3d.data_layout import Layout
from markermend.formats.c3d.encoding import Coding
from markermend.formats.units import LARGEST

LARGEST_INTEGER = 32767
"""The largest integer of a coordinate in an integer file."""


def map_points(path: Path, layout: Layout, coding: Coding, *, writable: bool = False) -> np.ndarray:
    """Map the stored numbers of the points into memory.

    Parameters
    ----------
    path : Path
        The file.
    layout : Layout
        Where its data lie.
    coding : Coding
        How its numbers are stored.
    writable : bool
        Whether what is assigned to the array goes into the file.

    Returns
    -------
    ndarray, shape (frames, points, 4)
        A view of the file itself, of the coding's float or integer type.
    """
    data = np.memmap(path, np.uint8, "r+" if writable else "r")
    stored = coding.float_type if layout.real else coding.integer_type
    width = stored.itemsize
    shape, strides = (layout.frames, layout.points, 4), (layout.stride, 4 * width, width)
    return np.ndarray(shape, stored, buffer=data, offset=layout.start, strides=strides)


def decode(stored: np.ndarray, layout: Layout, coding: Coding) -> tuple[np.ndarray, np.ndarray]:
    """Decode stored points.

    Parameters
    ----------
    stored : ndarray, shape (frames, points, 4)
        As map_points gives them.
    layout : Layout
        Where the data lie, and their scale.
    coding : Coding
        How the numbers are stored.

    Returns
    -------
    coordinates : ndarray of float, shape (frames, points, 3)
        In the file's unit, whatever word 4 says.
    word4 : ndarray of float, shape (frames, points)
        The fourth number as stored.
    """
    if layout.real:
        return coding.decode_floats(stored[..., :3]), coding.decode_floats(stored[..., 3])
    return stored[..., :3] * layout.scale, stored[..., 3].astype(np.float64)


def decode_word4(word4: np.ndarray, scale: float) -> tuple[np.ndarray, np.ndarray]:
    """Split word 4 of points into residual and camera mask.

    Word 4 is a signed 16-bit integer, in float files the float of one, signed or unsigned; negative means missing.

    Parameters
    ----------
    word4 : ndarray of float
        As decoded, of any shape.
    scale : float
        POINT:SCALE without its sign.

    Returns
    -------
    residual : ndarray of float
        In the file's unit; -1 where the sample is missing, NaN where word 4 is not finite.
    cameras : ndarray of uint8
        One bit for each of seven cameras; 0 where the sample is missing.
    """
    finite = np.isfinite(word4)
    whole = np.where(finite, np.clip(word4, -1.0, 65535.0), 0.0).astype(np.int64)
    missing = (whole < 0) | (whole >= 32768)
    residual = np.where(missing, -1.0, (whole & 0xFF) * scale)
    return np.where(finite, residual, np.nan), np.where(missing, 0, (whole >> 8) & 0x7F).astype(np.uint8)


def missing_clauses(
    positions: np.ndarray, word4: np.ndarray, *, credible: bool | None = None
) -> tuple[dict[str, np.ndarray], bool]:
    """Decide which samples are missing, and by which clause of the rule.

    A sample counts for the first clause that holds: `residual` (word 4 is negative), `zero` (exactly 0, 0, 0),
    `not finite`, `out of range`. Word 4 is disregarded where it calls every real sample missing.

    Parameters
    ----------
    positions : ndarray of float, shape (frames, points, 3)
        In the file's unit, as decoded.
    word4 : ndarray of float, shape (frames, points)
        As decoded.
    credible : bool, optional
        Whether word 4 means anything, where other points of the file have shown it; by default these points decide.

    Returns
    -------
    clauses : dict of str to ndarray of bool, shape (frames, points)
        Disjoint masks of missing samples, by clause.
    credible : bool
        False where word 4 was disregarded.
    """
    residual, _ = decode_word4(word4, 1.0)
    negative = residual < 0
    zero = (positions == 0).all(axis=2)
    unusable = ~(np.isfinite(positions).all(axis=2) & np.isfinite(word4))
    far = (np.abs(positions) >= LARGEST).any(axis=2)
    real = ~(zero | unusable | far)
    if credible is None:
        credible = not (real.any() and bool(np.all(negative | ~real)))
    negative &= credible
    zero &= ~negative
    unusable &= ~negative
    far &= ~negative & ~unusable
    return {"residual": negative, "zero": zero, "not finite": unusable, "out of range": far}, credible


def encode(
    values: np.ndarray, layout: Layout, coding: Coding, *, credible: bool = True
) -> tuple[np.ndarray, np.ndarray]:
    """Encode samples for storage.

    A position gets word 4 = 0 (residual 0, no camera: not measured), a missing one zeros and -1. Where word 4 of all samples is -1,
    a position gets it, too: one that is not negative would declare all others missing.

    Parameters
    ----------
    values : ndarray of float, shape (n, 3)
        Samples in the file's unit; NaN = missing.
    layout : Layout
        Where the data lie, and their scale.
    coding : Coding
        How numbers are stored.
    credible : bool
        False where word 4 of the file is disregarded.

    Returns
    -------
    stored : ndarray, shape (n, 4)
        Of the type that map_points gives.
    refused : ndarray of bool, shape (n,)
        Samples that cannot be stored: they exceed the number format or would be read back as missing, being too large
        for a position or rounded to 0, 0, 0.
    """
    missing = np.isnan(values).any(axis=1)
    positions = np.where(missing[:, None], 0.0, values)
    word4 = np.where(missing, -1.0, 0.0 if credible else -1.0)
    if layout.real:
        stored = coding.encode_floats(np.column_stack((positions, word4)))
        readable = np.asarray(np.isfinite(coding.decode_floats(stored)).all(axis=1))
        vanished = (coding.decode_floats(stored[:, :3]) == 0).all(axis=1)
    else:
        steps = np.rint(positions / layout.scale)
        readable = np.asarray((np.abs(steps) <= LARGEST_INTEGER).all(axis=1))
        vanished = (steps == 0).all(axis=1)
        storable = np.where(readable[:, None], steps, 0.0)
        stored = np.column_stack((storable, word4)).astype(coding.integer_type)
    far = (np.abs(positions) >= LARGEST).any(axis=1)
    return stored, ~readable | far | (vanished & ~missing)
