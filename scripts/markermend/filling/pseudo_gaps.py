"""Pseudo-gaps: stretches of a marker that are hidden for trial, on which the error of a predictor can be measured."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from markermend.filling.gap import Gap
from markermend.filling.motion import neighbour_motion
from markermend.numerics.intervals import runs
from markermend.options.filling import EnsembleOptions
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class PseudoGap:
    """A trial on a stretch whose true positions are known.

    Attributes
    ----------
    scene : Scene
        The recording without the marker during the pseudo-gap.
    gap : Gap
        The pseudo-gap.
    truth : ndarray, shape (n, 3)
        The hidden positions, mm.
    motion : float
        How much neighbours move during the pseudo-gap, mm; NaN where unknown (`neighbour_motion`).
    """

    scene: Scene
    gap: Gap
    truth: np.ndarray
    motion: float = math.nan


@dataclass(frozen=True)
class _Pattern:
    """What every pseudo-gap repeats of the real gap, frame by frame over its own n frames.

    absent: bool (n, markers), samples missing during the real gap. deviation: (n, markers), mm, inherited standard
    deviation of samples that were filled earlier. before, after: frames of the marker hidden besides on either side.
    """

    marker: int
    absent: np.ndarray
    deviation: np.ndarray
    before: int
    after: int

    @property
    def length(self) -> int:
        """Number of frames of a pseudo-gap."""
        return len(self.absent)

    @property
    def hidden(self) -> int:
        """Number of samples of the marker that a pseudo-gap hides."""
        return self.before + self.length + self.after


def pseudo_gaps(scene: Scene, gap: Gap, options: EnsembleOptions) -> list[PseudoGap]:
    """Hide stretches as long as a gap, spread over the frames where the marker is seen.

    A pseudo-gap lies where the marker is seen at both borders. Where the marker is nowhere seen for as long as the gap,
    pseudo-gaps are two thirds as long as the longest stretch. Where there is room, they lie where the marker is not known to
    jump nearby, and where no nearest neighbour is missing that is seen throughout the gap.

    Samples of other markers that are missing during the gap are missing at the same offsets of a pseudo-gap. Samples
    that were filled earlier are displaced at random by their inherited standard deviation. A gap at an end of the
    recording has one border only: its pseudo-gaps hide as much again on the other side, at least 1 s. The gap itself
    stays hidden.

    Several pseudo-gaps share a scene, in which all of them are hidden; predictors that cannot share the training of the whole
    scene are trained once for all of them.

    Parameters
    ----------
    scene : Scene
        The recording, in which the gap is missing.
    gap : Gap
        The gap to imitate.
    options : EnsembleOptions
        How many are wanted, and how similar they should be.

    Returns
    -------
    list of PseudoGap
        By their start; empty where the marker is seen too briefly. The same gap gets the same
        pseudo-gaps in every run, other gaps get others.
    """
    length, count = trial_length(scene.present[:, gap.marker], gap.length), options.pseudo_gaps
    if length < 1 or count == 0:
        return []
    starts = _possible_starts(scene, gap.marker, length)
    similar = _equally_seen(scene, gap, starts, length, options.compared_neighbours)
    starts = similar if len(similar) >= count else starts
    rng = np.random.default_rng([gap.marker, gap.start, gap.stop])
    chosen = starts[np.unique(((np.arange(count) + rng.random(count)) / count * len(starts)).astype(int))]
    motions = neighbour_motion(scene, gap, chosen, length=length, neighbours=options.motion_neighbours)
    motion = dict(zip(chosen.tolist(), motions.tolist(), strict=True))
    # The error of a filled sample lasts about as long as its gap: one direction for each pseudo-gap and marker.
    directions = rng.standard_normal((len(chosen), scene.positions.shape[1], 3))
    pattern = _pattern(scene, gap, length)
    max_per_scene = int(options.max_hidden_share * np.count_nonzero(scene.present[:, gap.marker]) / pattern.hidden)
    stride = scene_count(chosen, distance=2 * pattern.hidden, max_per_scene=max_per_scene)
    found: dict[int, PseudoGap] = {}
    for first in range(stride):
        shared = _hide(scene, pattern, chosen[first::stride], directions[first::stride])
        for start in chosen[first::stride].tolist():
            trial = Gap(gap.marker, start, start + length)
            found[start] = PseudoGap(shared, trial, scene.positions[trial.samples], motion[start])
    return [found[start] for start in chosen.tolist()]


def trial_length(seen: np.ndarray, length: int) -> int:
    """Choose the length of the pseudo-gaps of a gap.

    Parameters
    ----------
    seen : ndarray of bool, shape (frames,)
        Whether the marker is seen.
    length : int
        Frames of the gap.

    Returns
    -------
    int
        The length of the gap, or two thirds of the longest stretch without its borders if that is less.
    """
    longest = max((stop - start for start, stop in runs(seen)), default=0)
    return min(length, 2 * (longest - 2) // 3)


def scene_count(starts: np.ndarray, *, distance: int, max_per_scene: int) -> int:
    """Find the least number of scenes over which pseudo-gaps can be distributed in turn.

    Parameters
    ----------
    starts : ndarray of int, shape (pseudo-gaps,)
        First frames, ascending.
    distance : int
        Least distance between the starts of pseudo-gaps of one scene, frames.
    max_per_scene : int
        Largest number of pseudo-gaps in one scene.

    Returns
    -------
    int
        The number n such that every nth pseudo-gap can be in the same scene; one scene for each where none can share.
    """
    for stride in range(1, len(starts)):
        near = (starts[stride:] - starts[:-stride]).min() < distance
        if not near and math.ceil(len(starts) / stride) <= max_per_scene:
            return stride
    return len(starts)


def _possible_starts(scene: Scene, marker: int, length: int) -> np.ndarray:
    """First frames of the stretches of a length over which, and at whose borders, the marker is seen, not near a jump if possible."""
    seen = np.concatenate([[0], np.cumsum(scene.present[:, marker])])
    starts = np.arange(1, len(scene.positions) - length)
    free: np.ndarray = starts[seen[starts + length + 1] - seen[starts - 1] == length + 2]
    if scene.near_jumps is None:
        return free
    near = np.concatenate([[0], np.cumsum(scene.near_jumps[:, marker])])
    smooth = free[near[free + length] == near[free]]
    return smooth if len(smooth) else free


def _equally_seen(scene: Scene, gap: Gap, starts: np.ndarray, length: int, neighbours: int) -> np.ndarray:
    """Starts of the stretches over which every nearest neighbour is seen that is seen throughout the gap."""
    nearest = np.asarray(scene.neighbours[gap.marker], int)[:neighbours]
    seen = nearest[scene.present[gap.start : gap.stop, nearest].all(axis=0)]
    lost = np.concatenate([[0], np.cumsum(~scene.present[:, seen].all(axis=1))])
    equal: np.ndarray = starts[lost[starts + length] == lost[starts]]
    return equal


def _pattern(scene: Scene, gap: Gap, length: int) -> _Pattern:
    """Sample the frames of a gap at `length` frames."""
    rows = np.linspace(gap.start, gap.stop - 1, length).astype(int)
    deviation = (
        np.zeros((length, scene.positions.shape[1])) if scene.inherited_std is None else scene.inherited_std[rows]
    )
    beyond = max(length, round(scene.rate))
    at_start, at_end = gap.start == 0, gap.stop == len(scene.positions)
    return _Pattern(gap.marker, ~scene.present[rows], deviation, beyond * at_start, beyond * at_end)


def _hide(scene: Scene, pattern: _Pattern, starts: np.ndarray, directions: np.ndarray) -> Scene:
    """Repeat the pattern at each start; directions (starts, markers, 3) of the errors of filled samples."""
    positions = scene.positions.copy()
    for start, direction in zip(starts.tolist(), directions, strict=True):
        stop = start + pattern.length
        positions[start:stop] += pattern.deviation[..., None] * direction
        positions[start:stop][pattern.absent] = np.nan
        positions[max(start - pattern.before, 0) : stop + pattern.after, pattern.marker] = np.nan
    return replace(scene, positions=positions, measured=None, inherited_std=None, whole=scene)
