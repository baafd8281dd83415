"""Jumps of the whole scene: from one frame to the next all markers are displaced together, as when a camera is hit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from markermend.numerics.intervals import samples
from markermend.numerics.rigid_displacement import RigidDisplacement, displacement_over, extrapolate, fit_displacement
from markermend.options.detection import SceneJumpOptions

NEIGHBOUR_RATIO = 1.5
"""The frames beside a jump seem to jump by half as much: a frame beside one that jumps by this many times as much does not."""


@dataclass(frozen=True)
class SceneJump:
    """A displacement of all markers that begins from one frame to the next.

    Attributes
    ----------
    frame : int
        The first displaced frame.
    score : float
        Its size in units of the threshold.
    displacement : RigidDisplacement
        From where the markers were expected to where they are.
    points : np.ndarray
        Where the markers were expected (markers, 3), mm; NaN = unknown.
    """

    frame: int
    score: float
    displacement: RigidDisplacement
    points: np.ndarray

    @property
    def amount_mm(self) -> float:
        """Median distance by which the markers are displaced, mm."""
        return float(np.nanmedian(np.linalg.norm(self.displacement.displace(self.points) - self.points, axis=1)))

    def undone_by(self, other: SceneJump, max_remaining_fraction: float) -> bool:
        """Check whether a later jump takes the markers back to where they were.

        Parameters
        ----------
        other : SceneJump
            The later jump.
        max_remaining_fraction : float
            Largest distance that may remain, as a part of the smaller of the two jumps.

        Returns
        -------
        bool
            Whether it does.
        """
        after_both = other.displacement.displace(self.displacement.displace(other.displacement.undo(other.points)))
        remaining = np.nanmedian(np.linalg.norm(after_both - other.displacement.undo(other.points), axis=1))
        return bool(remaining <= max_remaining_fraction * min(self.amount_mm, other.amount_mm))


@dataclass(frozen=True)
class DisplacedStretch:
    """A stretch over which all markers are displaced.

    Attributes
    ----------
    start, stop : int
        The stretch, [start, stop).
    returns : bool
        Whether the markers are back in their places after it.
    score : float
        The smaller of the jumps at its ends, in units of the threshold.
    displacement : RigidDisplacement
        The displacement, estimated from both ends where the markers return.
    amount_mm : float
        Median distance by which the markers are displaced, mm.
    """

    start: int
    stop: int
    returns: bool
    score: float
    displacement: RigidDisplacement
    amount_mm: float


def find_displaced_stretches(positions: np.ndarray, rate: float, options: SceneJumpOptions) -> list[DisplacedStretch]:
    """Find the stretches over which all markers are displaced.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    rate : float
        Sampling rate, Hz.
    options : SceneJumpOptions
        Thresholds of a jump, and longest stretch after which the markers return.

    Returns
    -------
    list of DisplacedStretch
        By their first frames. A jump that none takes back lasts up to the next such jump, or to the end.
    """
    longest = samples(options.max_duration_s, rate)
    lasting: list[SceneJump] = []
    stretches = []
    for jump in find_scene_jumps(positions, rate, options):
        last = lasting[-1] if lasting else None
        if last and jump.frame - last.frame <= longest and last.undone_by(jump, options.max_remaining_fraction):
            lasting.pop()
            stretches.append(_stretch(positions, last, jump.frame, min(last.score, jump.score), returns=True))
        else:
            lasting.append(jump)
    stops = [jump.frame for jump in lasting[1:]] + [len(positions)] * bool(lasting)
    stretches += [
        _stretch(positions, jump, stop, jump.score, returns=False) for jump, stop in zip(lasting, stops, strict=True)
    ]
    return sorted(stretches, key=lambda stretch: stretch.start)


def _stretch(positions: np.ndarray, jump: SceneJump, stop: int, score: float, *, returns: bool) -> DisplacedStretch:
    """The stretch that begins with a jump."""
    displacement = displacement_over(positions, jump.frame, stop, returns=returns) or jump.displacement
    moved = np.linalg.norm(displacement.displace(jump.points) - jump.points, axis=1)
    return DisplacedStretch(jump.frame, stop, returns, score, displacement, float(np.nanmedian(moved)))


def find_scene_jumps(positions: np.ndarray, rate: float, options: SceneJumpOptions) -> list[SceneJump]:
    """Find the frames to which all markers jump together.

    The positions before and after are extrapolated to the moment between two frames. Their difference is zero for motion
    of constant acceleration, and a displacement of all markers shows in the median over the markers.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    rate : float
        Sampling rate, Hz.
    options : SceneJumpOptions
        Thresholds of a jump.

    Returns
    -------
    list of SceneJump
        By frame.
    """
    if len(positions) < 4:
        return []
    before = extrapolate(positions[1:-2], positions[:-3])
    after = extrapolate(positions[2:-1], positions[3:])
    distance = np.sqrt(((after - before) ** 2).sum(axis=2))
    seen = ~np.isnan(distance)
    enough = seen.sum(axis=1) >= options.min_markers
    size = np.zeros(len(distance))
    size[enough] = np.nanmedian(distance[enough], axis=1)
    usual = ndimage.median_filter(size, samples(options.scale_window_s, rate, odd=True), mode="nearest")
    level = np.maximum(options.floor_mm, options.usual_factor * usual)
    beside = np.maximum(np.append(size[1:], 0), np.append(0, size[:-1]))
    jumps = []
    for k in np.flatnonzero((size >= level) & (beside <= NEIGHBOUR_RATIO * size)):
        displacement = fit_displacement(before[k], after[k])
        if displacement is None:
            continue
        expected = displacement.displace(before[k])
        moved, off = (np.linalg.norm(expected - other, axis=1)[seen[k]] for other in (before[k], after[k]))
        if (off <= options.max_residual_fraction * np.median(moved)).mean() >= options.min_share:
            jumps.append(SceneJump(int(k) + 2, float(size[k] / level[k]), displacement, before[k]))
    return jumps
