"""Exchanges of two labels: a frame at which two markers change places, and the stretches between such frames.

An exchange is a frame at which the vector between two markers reverses while their midpoint moves on; where one of the
four samples is missing, one marker jumps to where the other was a frame before or after. Between exchanges the *shape*
decides which label is which: distances to other markers, against their medians over the recording.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from markermend.detection.labelling.clearness import pair_clearness
from markermend.detection.labelling.distances import length
from markermend.detection.labelling.permutations import ExchangedStretch, Permutation
from markermend.numerics.intervals import runs
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class PairChange:
    """A frame at which two markers change places.

    Attributes
    ----------
    first, second : int
        Indices of the markers, ascending.
    frame : int
        The first frame after the change.
    score : float
        Evidence in units of the threshold.
    """

    first: int
    second: int
    frame: int
    score: float


def find_pair_exchanges(
    scene: Scene, sudden: np.ndarray, *, window: int, options: LabelsOptions
) -> list[ExchangedStretch]:
    """Find the stretches over which two labels are exchanged.

    Parameters
    ----------
    scene : Scene
        What is observed.
    sudden : np.ndarray
        Where the velocity of a marker breaks, bool (frames, markers).
    window : int
        Window of the usual motion, samples.
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.

    Returns
    -------
    list[ExchangedStretch]
        The stretches.
    """
    changes: dict[tuple[int, int], list[PairChange]] = {}
    for change in find_pair_changes(scene, sudden, window=window, options=options):
        changes.setdefault((change.first, change.second), []).append(change)
    return [stretch for pair, own in changes.items() for stretch in exchanged_stretches(scene, pair, own, options)]


def find_pair_changes(scene: Scene, sudden: np.ndarray, *, window: int, options: LabelsOptions) -> list[PairChange]:
    """Find the frames at which two markers change places; a marker takes part in one change at a time.

    Parameters
    ----------
    scene : Scene
        What is observed.
    sudden : np.ndarray
        Where the velocity of a marker breaks, bool (frames, markers).
    window : int
        Window of the usual motion, samples.
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.

    Returns
    -------
    list[PairChange]
        The changes, by frame.
    """
    positions, present = scene.positions, scene.present
    before, now = np.roll(present, 1, axis=0), present
    before[0] = False
    found: list[PairChange] = []
    for a in range(positions.shape[1]):
        rows = np.flatnonzero(sudden[:, a])
        if not len(rows):
            continue
        both = sudden[rows, a + 1 :]
        for k, b in np.argwhere(both):
            found += _observed_change(positions, (a, a + 1 + int(b)), int(rows[k]), window, options)
        # Where the other one has a sample on one side of the jump alone, this one must come from or go to that place.
        single = before[rows] != now[rows]
        for k, b in np.argwhere(single):
            found += _half_observed_change(positions, (a, int(b)), int(rows[k]), options)
    return _strongest(found)


def _observed_change(
    positions: np.ndarray, pair: tuple[int, int], frame: int, window: int, options: LabelsOptions
) -> list[PairChange]:
    """The change of two markers that are observed on both sides of it, if it is one and no jump remains.

    Where three markers change places in a cycle, exchanging two of them would leave a smaller jump.
    """
    a, b = pair
    near = positions[max(frame - window // 2, 1) - 1 : frame + window // 2 + 1, [a, b]]
    usual = float(np.nanmedian(length(np.diff(near[:, 0] - near[:, 1], axis=0))))
    between = positions[frame - 1 : frame + 1, a] - positions[frame - 1 : frame + 1, b]
    middle = (positions[max(frame - 2, 0) : frame + 1, a] + positions[max(frame - 2, 0) : frame + 1, b]) / 2
    jump = float(length(between[1] - between[0]))
    remaining = float(length(between[1] + between[0]))
    steps = [length(middle[-1] - middle[-2]), length(middle[-1] - 2 * middle[-2] + middle[0])]
    drift = 2 * float(np.nanmin(steps))
    if remaining > max(options.jump_factor * usual, options.floor_mm):
        return []
    return _accepted(pair, frame, jump, max(remaining, drift), options)


def _half_observed_change(
    positions: np.ndarray, pair: tuple[int, int], frame: int, options: LabelsOptions
) -> list[PairChange]:
    """The change of a marker with one that is observed on one side of it alone, if it is one."""
    a, b = pair
    jump = float(length(positions[frame, a] - positions[frame - 1, a]))
    if np.isnan(positions[frame, b, 0]):
        remaining = float(length(positions[frame, a] - positions[frame - 1, b]))
    else:
        remaining = float(length(positions[frame, b] - positions[frame - 1, a]))
    return _accepted(pair, frame, jump, remaining, options)


def _accepted(
    pair: tuple[int, int], frame: int, jump: float, remaining: float, options: LabelsOptions
) -> list[PairChange]:
    """The change, if little enough of its jump remains with the labels changed back."""
    ratio = options.max_remaining_fraction
    if jump < options.floor_mm or remaining > ratio * jump:
        return []
    return [PairChange(min(pair), max(pair), frame, ratio * jump / max(remaining, 1e-3 * jump))]


def _strongest(found: Sequence[PairChange]) -> list[PairChange]:
    """The changes by frame, of those of one marker at one frame the strongest."""
    taken: set[tuple[int, int]] = set()
    kept = []
    for change in sorted(set(found), key=lambda c: (-c.score, c.frame, c.first, c.second)):
        ends = {(change.frame, change.first), (change.frame, change.second)}
        if not ends & taken:
            taken |= ends
            kept.append(change)
    return sorted(kept, key=lambda c: (c.frame, c.first, c.second))


def exchanged_stretches(
    scene: Scene, pair: tuple[int, int], changes: Sequence[PairChange], options: LabelsOptions
) -> list[ExchangedStretch]:
    """Find the stretches over which two markers stand in for each other, given their changes.

    While at least one of the two is observed, every change reverses the state. Which of the two states is the exchanged one
    is decided by the shape over all that time and by its being the shorter; where neither is clear, nothing is found.

    Parameters
    ----------
    scene : Scene
        What is observed.
    pair : tuple[int, int]
        Indices of the markers, ascending.
    changes : Sequence[PairChange]
        Their changes.
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.

    Returns
    -------
    list[ExchangedStretch]
        The stretches, by frame.
    """
    clearness = pair_clearness(scene, pair, neighbours=options.shape_neighbours)
    score = {change.frame: change.score for change in changes}
    found = []
    for start, stop in runs(scene.present[:, pair[0]] | scene.present[:, pair[1]]):
        cuts = [t for t in sorted(score) if start < t < stop]
        stretches = list(pairwise([start, *cuts, stop]))
        state = np.concatenate([np.full(v - u, (-1) ** k) for k, (u, v) in enumerate(stretches)])
        evidence = float(np.mean(state * (clearness[start:stop] + options.recorded_label_weight)))
        if not cuts or abs(evidence) < options.min_clearness:
            continue
        for u, v in stretches[int(evidence > 0) :: 2]:
            ends = [score[t] for t in (u, v) if t in cuts]
            limit = options.recorded_label_weight if len(ends) == 2 else -options.min_clearness
            if clearness[u:v].mean() < limit:
                found.append(ExchangedStretch(u, v, Permutation(pair, pair[::-1]), min(ends)))
    return found
