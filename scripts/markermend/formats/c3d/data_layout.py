"""Where the data of a C3D file lie: header and parameters declare it twice, and the file's size decides between them."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import NamedTuple

from markermend.core.recording import BadRecording
from markermend.formats.c3d import declarations
from markermend.formats.c3d.declarations import SATURATED
from markermend.formats.c3d.parameters import BLOCK, Section


@dataclass(frozen=True)
class Layout:
    """The data block: frames of points (four numbers each) and analog samples.

    Attributes
    ----------
    start : int
        Byte of the first frame.
    points, analog : int
        Points and analog samples per frame.
    real : bool
        Whether numbers are floating point, or 16-bit integers in units of the scale.
    frames : int
        How many frames the file holds.
    scale : float
        Size of an integer step in the file's unit.
    rate : float
        Frame rate in Hz; NaN where the file states none.
    first_frame : int
        The capture program's number of the first frame.
    warnings : tuple of str
        What was not as declared.
    """

    start: int
    points: int
    analog: int
    real: bool
    frames: int
    scale: float
    rate: float
    first_frame: int
    warnings: tuple[str, ...] = ()

    @property
    def stride(self) -> int:
        """Bytes per frame."""
        return _stride(self.points, self.analog, self.real)


class _Extent(NamedTuple):
    """One combination of declared values: byte of the first frame, points, analog samples, storage, frames."""

    start: int
    points: int
    analog: int
    real: bool
    frames: int

    def fills(self, size: int) -> bool:
        """Whether a file of `size` bytes ends in the last block of these data."""
        used = self.start + self.frames * _stride(self.points, self.analog, self.real)
        return bool(self.points and self.frames) and 0 <= size - used < BLOCK


def locate(section: Section, size: int, name: str) -> Layout:
    """Find the data block of a file.

    Where header and parameters disagree, the combination of their values that deviates least from the parameters and
    fills the file to within its last block is taken; if none does, the parameters, cut to the frames that the file holds.

    Parameters
    ----------
    section : Section
        Header and parameters.
    size : int
        Bytes of the file.
    name : str
        Of the file, for error messages.

    Returns
    -------
    Layout
        Where the data lie.

    Raises
    ------
    BadRecording
        If the file holds no points, no complete frame, or integers without a scale.
    """
    warnings = [] if section.sound else ["The parameter section is damaged; what could be read of it was used."]
    points = declarations.points(section)
    if not any(points):
        raise BadRecording(f"{name} has no 3-D data (it declares no points): leave it out of the recordings table")
    starts = declarations.starts(section, size)
    if starts[0] >= size:
        raise BadRecording(f"{name} ends before its data start (truncated): export it again")
    candidates = (
        starts,
        points,
        declarations.analog_samples(section),
        declarations.storages(section),
        declarations.frames(section),
    )
    extent, disagreement = _choose(candidates, size)
    stride = _stride(extent.points, extent.analog, extent.real)
    frames, shortage = _frames_held(extent.frames, (size - extent.start) // stride)
    if frames < 1:
        raise BadRecording(
            f"{name} holds no complete frame: it declares {extent.frames} of {extent.points} points, {stride} bytes each, and has "
            f"{max(size - extent.start, 0)} bytes for them (truncated, or its header is wrong): export it again"
        )
    scale = declarations.scale(section)
    if scale is None and not extent.real:
        raise BadRecording(f"{name} stores integers without a usable POINT:SCALE: export it again")
    rate, rate_warnings = declarations.frame_rate(section)
    first, first_warnings = declarations.first_frame(section, frames)
    warnings += [*disagreement, *shortage, *rate_warnings, *first_warnings]
    return Layout(
        extent.start, extent.points, extent.analog, extent.real, frames, scale or 1.0, rate, first, tuple(warnings)
    )


def _stride(points: int, analog: int, real: bool) -> int:
    """Bytes per frame."""
    return (4 * points + analog) * (4 if real else 2)


def _choose(
    candidates: tuple[list[int], list[int], list[int], list[bool], list[int]], size: int
) -> tuple[_Extent, list[str]]:
    """The combination nearest to the first of each that fills the file, the first of each if none does; and warnings."""
    starts, points, analog, storages, frames = candidates
    ranked = sorted(itertools.product(*(range(len(values)) for values in candidates)), key=sum)
    for number, (a, b, c, d, e) in enumerate(ranked):
        extent = _Extent(starts[a], points[b], analog[c], storages[d], frames[e])
        if extent.fills(size):
            return extent, [_disagreement(extent)] if number else []
    start, used = (next((value for value in values if value), values[0]) for values in (starts, points))
    warnings = ["Header and parameters disagree, and neither fits the file's size; the parameters are used."]
    return _Extent(start, used, analog[0], storages[0], frames[0]), warnings if len(ranked) > 1 else []


def _disagreement(extent: _Extent) -> str:
    """The warning that header and parameters disagree, and what the file holds by its size."""
    return (
        f"Header and parameters disagree; by the file's size it holds {extent.frames} frames of {extent.points} points "
        f"and {extent.analog} analog samples, {'floating point' if extent.real else 'integer'}."
    )


def _frames_held(frames: int, held: int) -> tuple[int, list[str]]:
    """The frames to read, of those declared, where the file has room for `held`; and warnings."""
    if frames in (SATURATED, held % (SATURATED + 1)) and held > SATURATED:
        return held, [f"The frame count {frames} is too small for the file, which holds {held} frames; all are read."]
    if held < frames:
        return held, [f"The file is truncated: it holds {held} of the {frames} frames that it declares."]
    return frames, []
