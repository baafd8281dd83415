"""Jumps of the whole scene: from one frame to the next all markers are displaced together, as when a camera is hit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from markermend.numerics.displaced_scene import either_side, jumps, settle
from markermend.numerics.intervals import samples
from markermend.numerics.rigid_displacement import RigidDisplacement, fit_displacement
from markermend.options.detection.frames import SceneJumpOptions

NEIGHBOUR_RATIO = 1.5
"""The frames beside a jump seem to jump by half as much: a frame beside one that jumps by this many times as much does not."""


@dataclass(frozen=True)
class SceneJump:
    """A displacement of all markers that begins from one frame to the next.

    Attributes
    ----------
    frame, last : int
        The first displaced frame, and that from which on the markers no longer ring.
    score : float
        Its size in units of the threshold.
    displacement : RigidDisplacement
        From where the markers were expected to where they are.
    points : np.ndarray
        Where the markers were expected (markers, 3), mm; NaN = unknown.
    """

    frame: int
    last: int
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
            Largest distance that may remain, as a part of the smaller of the two jumps, beyond what the first leaves
            unexplained.

        Returns
        -------
        bool
            Whether it does.
        """
        remaining = np.linalg.norm(
            other.displacement.displace(other.points) - self.displacement.undo(other.points), axis=1
        )
        allowed = max_remaining_fraction * min(self.amount_mm, other.amount_mm) + self.displacement.residual_mm
        return bool(np.nanmedian(remaining) <= allowed)


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
        The displacement.
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
    for jump, largest_mm in find_scene_jumps(positions, rate, options):
        last = lasting[-1] if lasting else None
        if jump.amount_mm <= options.max_remaining_fraction * largest_mm:
            stretches.append(DisplacedStretch(jump.frame, jump.last, True, jump.score, jump.displacement, largest_mm))
        elif last and jump.frame - last.frame <= longest and last.undone_by(jump, options.max_remaining_fraction):
            lasting.pop()
            stretches.append(_stretch(last, jump.frame, min(last.score, jump.score), returns=True))
        else:
            lasting.append(jump)
    stops = [jump.frame for jump in lasting[1:]] + [len(positions)] * bool(lasting)
    stretches += [_stretch(jump, stop, jump.score, returns=False) for jump, stop in zip(lasting, stops, strict=True)]
    return sorted(stretches, key=lambda stretch: stretch.start)


def _stretch(jump: SceneJump, stop: int, score: float, *, returns: bool) -> DisplacedStretch:
    """The stretch that begins with a jump."""
    return DisplacedStretch(jump.frame, stop, returns, score, jump.displacement, jump.amount_mm)


def find_scene_jumps(
    positions: np.ndarray, rate: float, options: SceneJumpOptions
) -> Iterator[tuple[SceneJump, float]]:
    """Find the frames to which all markers jump together.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    rate : float
        Sampling rate, Hz.
    options : SceneJumpOptions
        Thresholds of a jump.

    Yields
    ------
    jump : SceneJump
        By frame; jumps that follow each other until the scene is settled are one.
    largest_mm : float
        The largest displacement until then, median over the markers, mm.
    """
    distance = jumps(positions)
    enough = (~np.isnan(distance)).sum(axis=1) >= options.min_markers
    size = np.zeros(len(distance))
    size[enough] = np.nanmedian(distance[enough], axis=1)
    beside = np.maximum(np.append(size[1:], 0), np.append(0, size[:-1]))
    alone = (size >= options.floor_mm) & (beside <= NEIGHBOUR_RATIO * size)
    if not alone.any():
        return
    from scipy import ndimage  # 0.15 s to import, and few recordings get here

    usual = ndimage.median_filter(size, samples(options.scale_window_s, rate, odd=True), mode="nearest")
    level = np.maximum(options.floor_mm, options.usual_factor * usual)
    done = 0
    for k in np.flatnonzero((size >= level) & alone).tolist():
        if k >= done and _moves_as_one(positions, k, options):
            last, largest_mm = settle(positions, k)
            before, after = either_side(positions, k, last)
            displacement = fit_displacement(before, after)
            if displacement is not None:
                done = last + 1
                score = float((size[k : last + 1] / level[k : last + 1]).max())
                yield SceneJump(k, last, score, displacement, before), largest_mm


def _moves_as_one(positions: np.ndarray, frame: int, options: SceneJumpOptions) -> bool:
    """Whether nearly all markers jump to a frame as one rigid body."""
    before, after = either_side(positions, frame, frame)
    displacement = fit_displacement(before, after)
    if displacement is None:
        return False
    expected = displacement.displace(before)
    known = ~np.isnan(before + after).any(axis=1)
    moved, off = (np.linalg.norm(expected - other, axis=1)[known] for other in (before, after))
    return bool((off <= options.max_residual_fraction * np.median(moved)).mean() >= options.min_share)
