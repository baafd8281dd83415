"""How much a body moves during a gap: errors of an interpolation in time on neighbours that were measured there."""

from __future__ import annotations

import math

import numpy as np

from markermend.filling.gap import Gap
from markermend.prediction.scene import Scene

QUARTERS = 1, 2, 3
"""Where in a stretch the curve is compared with what was measured, in quarters of the time between its borders."""


def neighbour_motion(scene: Scene, gap: Gap, starts: np.ndarray, *, length: int, neighbours: int) -> np.ndarray:
    """Measure how much the neighbours of a marker move, as far as an interpolation in time cannot follow.

    Each neighbour is compared with the cubic curve through its positions and velocities at both borders. So the result is
    what a spline would err on a neighbour; the median is taken, since one of them may jump. Only samples that were measured
    count, not those that were filled.

    Parameters
    ----------
    scene : Scene
        The recording.
    gap : Gap
        The gap; the nearest neighbours that were measured throughout it are compared.
    starts : ndarray of int, shape (n,)
        First frames of the stretches to measure, such as the gap itself or its pseudo-gaps.
    length : int
        Frames of each stretch.
    neighbours : int
        Number of neighbours to compare.

    Returns
    -------
    ndarray, shape (n,)
        Median over the neighbours of the root mean square distance from the curve, mm; NaN where it is unknown, as it is
        everywhere if the gap is at an end of the recording.
    """
    measured = scene.measured or scene
    if gap.start < 2 or gap.stop > len(measured.positions) - 2:
        return np.full(len(starts), np.nan)
    near = np.asarray(measured.neighbours[gap.marker], int)
    near = near[measured.present[gap.start - 2 : gap.stop + 2, near].all(axis=0)][:neighbours]
    distances = np.sqrt(_squared_distances(measured.positions[:, near], starts, length).mean(axis=0))
    found = np.full(len(starts), np.nan)
    known = ~np.isnan(distances).all(axis=1)
    found[known] = np.nanmedian(distances[known], axis=1)
    return found


def motion_ratio(of_gap: float, of_trials: np.ndarray, *, min_motion_mm: float) -> float:
    """Compare the motion during a gap with that during its pseudo-gaps.

    Parameters
    ----------
    of_gap : float
        Result of `neighbour_motion` for the gap, mm.
    of_trials : ndarray, shape (pseudo-gaps,)
        Those for its pseudo-gaps, mm.
    min_motion_mm : float
        Smaller motion counts as this, mm.

    Returns
    -------
    float
        Ratio of the former to the root mean square of the latter, at least 1; 1 where either is unknown.
    """
    known = of_trials[~np.isnan(of_trials)]
    if math.isnan(of_gap) or not len(known):
        return 1.0
    return max(1.0, of_gap / max(math.sqrt((known**2).mean()), min_motion_mm))


def _squared_distances(positions: np.ndarray, starts: np.ndarray, length: int) -> np.ndarray:
    """Squared distances (quarters, starts, markers), mm^2, of positions (frames, markers, 3) from Hermite's curve."""

    def at(offset: int) -> np.ndarray:
        taken: np.ndarray = positions[np.clip(starts + offset, 0, len(positions) - 1)]
        return taken

    span = length + 1
    first, last = at(-1), at(length)
    leaving, arriving = span * (first - at(-2)), span * (at(length + 1) - last)
    squares = []
    for quarter in QUARTERS:
        offset = round(span * quarter / 4)
        t = offset / span
        curve = (2 * t**3 - 3 * t**2 + 1) * first + (t**3 - 2 * t**2 + t) * leaving
        curve += (3 * t**2 - 2 * t**3) * last + (t**3 - t**2) * arriving
        squares.append(((at(offset - 1) - curve) ** 2).sum(axis=2))
    return np.stack(squares)
