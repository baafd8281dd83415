"""Pulses of the positions of markers: displacements over a few frames, with flanks, beside motion that is a polynomial."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from markermend.numerics import moving
from markermend.options.detection.frames import SegmentSlipOptions


@dataclass(frozen=True, eq=False)
class Pulse:
    """A displacement over a few frames, estimated together with a polynomial.

    Attributes
    ----------
    start, stop : int
        Its frames, [start, stop).
    weights : np.ndarray
        Regression weights (n,): their product with positions at the n frames is the height of the displacement.
    """

    start: int
    stop: int
    weights: np.ndarray


def pulse_sizes(positions: np.ndarray, length: int, options: SegmentSlipOptions) -> np.ndarray:
    """Compute by how much the mean of a few samples departs from the motion on either side.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    length : int
        Samples whose mean is taken, around each frame.
    options : SegmentSlipOptions
        Samples on either side through which a polynomial is laid, and its order.

    Returns
    -------
    np.ndarray
        Distances (frames, markers), mm; 0 where a sample is missing.
    """
    context = options.context_frames
    time = np.arange(-context, length + context) - (length - 1) / 2
    inside = (np.arange(len(time)) >= context) & (np.arange(len(time)) < context + length)
    powers = np.vander(time / len(time), options.context_order + 1)
    kernel = np.where(inside, 1 / length, 0.0)
    kernel[~inside] = -powers[inside].mean(axis=0) @ np.linalg.pinv(powers[~inside])
    padded = moving.centred(positions, len(kernel), mode="symmetric")
    pulse = sum(weight * padded[k : k + len(positions)] for k, weight in enumerate(kernel))
    sizes: np.ndarray = np.nan_to_num(np.sqrt((pulse**2).sum(axis=2)))
    return sizes


def best_pulse(courses: np.ndarray, options: SegmentSlipOptions) -> Pulse:
    """Find the pulse that, with a polynomial, explains some courses best.

    Parameters
    ----------
    courses : np.ndarray
        Coordinates (n, d) over n frames, mm, without NaN.
    options : SegmentSlipOptions
        Durations of a pulse and its flanks, the frames between it and either end, at least, and the order of the polynomial.

    Returns
    -------
    Pulse
        The pulse.
    """
    pulses, free, power = _pulses(len(courses), options)
    explained = ((free @ courses) ** 2).sum(axis=1) / power
    best = int(np.argmax(explained))
    raised = np.flatnonzero(pulses[best])
    return Pulse(int(raised[0]), int(raised[-1]) + 1, free[best] / power[best])


def residual_beside(courses: np.ndarray, pulse: Pulse, options: SegmentSlipOptions) -> float:
    """Fit the motion beside a pulse, whatever its shape: a polynomial through all frames but its own and the next ones.

    Parameters
    ----------
    courses : np.ndarray
        Coordinates (n, d) over n frames, mm, without NaN.
    pulse : Pulse
        The pulse.
    options : SegmentSlipOptions
        The order of the polynomial, and the frames on either side that a rounded slip may still move.

    Returns
    -------
    float
        Mean square that the polynomial leaves per degree of freedom, mm^2.
    """
    enough = options.fit_order + 1 + options.min_frames_beside
    for border in range(options.border_frames, -1, -1):
        beside = np.ones(len(courses), bool)
        beside[max(0, pulse.start - border) : pulse.stop + border] = False
        if np.count_nonzero(beside) >= enough:
            break
    basis = np.linalg.qr(_polynomials(len(courses), options.fit_order)[beside])[0]
    return _mean_square(courses[beside], basis)


def pulse_residual(courses: np.ndarray, pulse: Pulse, options: SegmentSlipOptions) -> float:
    """Fit a pulse together with a polynomial.

    Parameters
    ----------
    courses : np.ndarray
        Coordinates (n, d) over n frames, mm, without NaN.
    pulse : Pulse
        The pulse.
    options : SegmentSlipOptions
        The order of the polynomial.

    Returns
    -------
    float
        Mean square that they leave per degree of freedom, mm^2.
    """
    # The weights of the regression are proportional to the part of the pulse that no polynomial explains.
    free = pulse.weights / np.linalg.norm(pulse.weights)
    return _mean_square(courses, np.column_stack([_polynomials(len(courses), options.fit_order), free]))


def impact_residual(courses: np.ndarray, options: SegmentSlipOptions) -> float:
    """Fit an impact: a polynomial whose velocity and acceleration break at one frame.

    Parameters
    ----------
    courses : np.ndarray
        Coordinates (n, d) over n frames, mm, without NaN.
    options : SegmentSlipOptions
        Frames between the break and either end, at least, and the order of the polynomial.

    Returns
    -------
    float
        Smallest mean square that it leaves per degree of freedom, mm^2.
    """
    return min(_mean_square(courses, basis) for basis in _breaks(len(courses), options))


def _mean_square(courses: np.ndarray, basis: np.ndarray) -> float:
    """Mean square per degree of freedom that an orthonormal basis (n, p) leaves of courses (n, d), mm^2."""
    left = courses - basis @ (basis.T @ courses)
    return float((left**2).sum() / max(1, basis.shape[0] - basis.shape[1]))


@cache
def _polynomials(frames: int, order: int) -> np.ndarray:
    """An orthonormal basis (frames, order + 1) of polynomials."""
    return np.linalg.qr(np.vander(np.linspace(-1, 1, frames), order + 1))[0]


@cache
def _breaks(frames: int, options: SegmentSlipOptions) -> list[np.ndarray]:
    """Orthonormal bases (frames, fit_order + 3) of polynomials that break at each frame."""
    time, context = np.linspace(-1, 1, frames), options.context_frames
    after = [np.maximum(0, time - time[frame]) for frame in range(context, frames - context)]
    return [np.linalg.qr(np.column_stack([np.vander(time, options.fit_order + 1), own, own**2]))[0] for own in after]


@cache
def _pulses(frames: int, options: SegmentSlipOptions) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pulses (k, frames) of height 1 of all lengths, flanks and places, their parts free of polynomials, and the power of these."""
    shapes, context = [], options.context_frames
    for flank in range(options.max_flank_frames + 1):
        ramp = np.arange(1, flank + 1) / (flank + 1)
        for length in range(max(1, options.min_total_frames - 2 * flank), options.max_frames + 1):
            pulse = np.concatenate([ramp, np.ones(length), ramp[::-1]])
            for start in range(context, frames - context - len(pulse) + 1):
                shapes.append(np.pad(pulse, (start, frames - start - len(pulse))))
    pulses, basis = np.array(shapes), _polynomials(frames, options.fit_order)
    free = pulses - pulses @ basis @ basis.T
    return pulses, free, (free**2).sum(axis=1)
