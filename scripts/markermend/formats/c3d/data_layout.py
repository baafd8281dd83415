"""Where the data of a C3D file lie: header and parameters say it twice, and the file's size judges between them."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

from markermend.core.recording import BadRecording
from markermend.formats.c3d.parameters import BLOCK, Section

SATURATED = 65535
"""The largest count that a 16-bit word holds; longer recordings store it, or the remainder."""


@dataclass(frozen=True)
class Layout:
    """The data block: frames of points (four numbers each) and analog samples.

    start: byte of the first frame. points, analog: points and analog samples per frame. real: floating point, or
    16-bit integers in units of scale. rate: Hz, NaN where the file has none. warnings: what was not as declared.
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


def locate(section: Section, size: int, name: str) -> Layout:
    """Find the data block of a file of `size` bytes; raises BadRecording where it holds no points.

    Where header and parameters disagree, the combination that deviates least from the parameters and fills the file
    to within its last block is taken; if none does, the parameters, cut to the frames that are there.
    """
    header, warnings = section.header, []
    if not section.sound:
        warnings.append("The parameter section is damaged; what could be read of it was used.")
    scale = section.number("POINT", "SCALE")
    points = _options(section.number("POINT", "USED"), header.points)
    if not any(points):
        raise BadRecording(f"{name} has no 3-D data (it declares no points): leave it out of the recordings table")
    choices = (
        _starts(section, size, name),
        points,
        _options(_analog(section), header.analog),
        [value < 0 for value in _options_real(scale, header.scale)],
        _frames(section),
    )
    start, used, analog, real, frames = _best(choices, size, warnings)
    frames = _frames_held(frames, (size - start) // _stride(used, analog, real), warnings)
    if frames < 1:
        raise BadRecording(f"{name} holds no complete frame (truncated, or its header is wrong): export it again")
    usable = next((value for value in (scale, header.scale) if value and math.isfinite(value)), None)
    if usable is None and not real:
        raise BadRecording(f"{name} stores integers without a usable POINT:SCALE: export it again")
    rate, first = _rate(section, warnings), _first_frame(section, frames, warnings)
    return Layout(start, used, analog, real, frames, abs(usable or 1.0), rate, first, tuple(warnings))


def _stride(points: int, analog: int, real: bool) -> int:
    """Bytes per frame."""
    return (4 * points + analog) * (4 if real else 2)


def _best(choices: tuple, size: int, warnings: list[str]) -> tuple:
    """The combination nearest to the first of each that fits the file's size; the first of each if none does."""
    ranked = sorted(
        itertools.product(*(enumerate(options) for options in choices)),
        key=lambda combination: sum(rank for rank, _ in combination),
    )
    for number, combination in enumerate(ranked):
        start, points, analog, real, frames = chosen = tuple(value for _, value in combination)
        if points and frames and 0 <= size - start - frames * _stride(points, analog, real) < BLOCK:
            if number:
                warnings.append(
                    f"Header and parameters disagree; by the file's size it holds {frames} frames of {points} points "
                    f"and {analog} analog samples, {'floating point' if real else 'integer'}."
                )
            return chosen
    if len(ranked) > 1:
        warnings.append("Header and parameters disagree, and neither fits the file's size; the parameters are used.")
    return tuple(next((value for value in options if value), options[0]) for options in choices[:2]) + tuple(
        options[0] for options in choices[2:]
    )


def _frames_held(frames: int, held: int, warnings: list[str]) -> int:
    """The frames to read, of those declared, where the file has room for `held`."""
    if frames in (SATURATED, held % (SATURATED + 1)) and held > SATURATED:
        warnings.append(f"The frame count {frames} is too small for the file, which holds {held} frames; all are read.")
        return held
    if held < frames:
        warnings.append(f"The file is truncated: it holds {held} of the {frames} frames that it declares.")
    return min(held, frames)


def _options(*values: float | None) -> list[int]:
    """The whole numbers among values, none negative, each once, in order."""
    whole = [int(value) for value in values if value is not None and 0 <= value < 2**31]
    return list(dict.fromkeys(whole)) or [0]


def _options_real(*scales: float | None) -> list[float]:
    """One scale per sign, in order; a scale that is absent, zero or not finite says nothing, and none at all: either."""
    usable = [scale for scale in scales if scale and math.isfinite(scale)]
    return list({scale < 0: scale for scale in reversed(usable)}.values())[::-1] or [-1.0, 1.0]


def _starts(section: Section, size: int, name: str) -> list[int]:
    """The bytes at which the data may start: by the parameters, by the header, after the parameters."""
    header = section.header
    blocks = _options(section.number("POINT", "DATA_START"), header.data_block)
    after = math.ceil((section.end + 2) / BLOCK)
    usable = [block for block in blocks if block > header.parameter_block and (block - 1) * BLOCK < size]
    starts = [(block - 1) * BLOCK for block in usable] or [after * BLOCK]
    if starts[0] >= size:
        raise BadRecording(f"{name} ends before its data start (truncated): export it again")
    return starts


def _analog(section: Section) -> float | None:
    """Analog samples per frame by the parameters; None where they do not say."""
    used, rate = section.number("ANALOG", "USED"), section.number("ANALOG", "RATE")
    point_rate = section.number("POINT", "RATE")
    if used == 0:
        return 0
    if used is None or not rate or not point_rate:
        return None
    return used * round(min(rate / point_rate, SATURATED))


def _frames(section: Section) -> list[int]:
    """The numbers of frames that the file declares, the most trustworthy first."""
    first, last = (_field(section, f"ACTUAL_{end}_FIELD") for end in ("START", "END"))
    declared = (
        section.number("POINT", "LONG_FRAMES"),
        None if first is None or last is None or last - first < SATURATED else last - first + 1,
        section.number("POINT", "FRAMES"),
        None if first is None or last is None else last - first + 1,
        section.header.last_frame - section.header.first_frame + 1,
    )
    return _options(*(value for value in declared if value is not None and value >= 1))


def _field(section: Section, name: str) -> int | None:
    """A frame number of the TRIAL group, stored as a low and a high word (or as one number)."""
    words = section.numbers("TRIAL", name)
    if not words or any(word < 0 or word > 2**31 for word in words):
        return None
    return int(words[0]) + (int(words[1]) * (SATURATED + 1) if len(words) > 1 else 0)


def _first_frame(section: Section, frames: int, warnings: list[str]) -> int:
    """The capture program's number of the first frame: of the parameters, if they agree with the frames that are there."""
    stated, written = _field(section, "ACTUAL_START_FIELD"), section.header.first_frame
    if stated is None or stated == written:
        return written
    last = _field(section, "ACTUAL_END_FIELD")
    agrees = stated % (SATURATED + 1) == written or (last is not None and last - stated + 1 == frames)
    if stated % (SATURATED + 1) != written:
        warnings.append(
            f"The first frame is {written} by the header and {stated} by TRIAL:ACTUAL_START_FIELD; "
            f"{stated if agrees else written} is used."
        )
    return stated if agrees else written


def _rate(section: Section, warnings: list[str]) -> float:
    """Frames per second: POINT:RATE, else the header's; NaN where neither is usable."""
    stated, written = section.number("POINT", "RATE"), section.header.rate
    usable = [rate for rate in (stated, written) if rate is not None and math.isfinite(rate) and rate > 0]
    if stated in usable and written in usable and abs(written / stated - 1) > 0.001:
        warnings.append(f"The rate is {written:g} Hz by the header and {stated:g} Hz by POINT:RATE, which is used.")
    elif usable and stated not in usable:
        warnings.append(f"POINT:RATE is missing or unusable; the header's {written:g} Hz is used.")
    return float(usable[0]) if usable else math.nan
