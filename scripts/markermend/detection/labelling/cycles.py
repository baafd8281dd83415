"""Exchanges of labels of three and more markers in a cycle.

Only distances are estimated from the recording: a regression would learn a permutation that lasts, and hide it. At the
frame of a change every marker of the cycle continues under another label; between changes the distances to other markers
decide which labels are right.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from markermend.detection.labelling.clearness import stretch_clearness
from markermend.detection.labelling.distances import distances
from markermend.detection.labelling.permutations import ExchangedStretch, Permutation, possible_permutations
from markermend.options.detection.labels import LabelsOptions
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class CycleChange:
    """A frame at which labels change in a cycle.

    Attributes
    ----------
    frame : int
        The first frame after the change.
    cycle : tuple[int, ...]
        Indices of the labels, the lowest first: what was under each goes on under the next, and at the end the first.
    score : float
        Evidence in units of the threshold.
    """

    frame: int
    cycle: tuple[int, ...]
    score: float


def find_cycle_exchanges(scene: Scene, sudden: np.ndarray, options: LabelsOptions) -> list[ExchangedStretch]:
    """Find the stretches over which labels are exchanged in cycles of three and more.

    Parameters
    ----------
    scene : Scene
        What is observed.
    sudden : np.ndarray
        Where the velocity of a marker breaks, bool (frames, markers).
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.

    Returns
    -------
    list[ExchangedStretch]
        The stretches between changes whose distances to other markers are clear enough. Of all stretches, the one whose
        labels are right is that which makes the clearness of the others largest.
    """
    changes: dict[tuple[int, ...], list[CycleChange]] = {}
    for change in find_cycle_changes(scene.positions, sudden, options):
        changes.setdefault(tuple(sorted(change.cycle)), []).append(change)
    return [
        stretch for markers, own in changes.items() for stretch in _exchanged_stretches(scene, markers, own, options)
    ]


def find_cycle_changes(positions: np.ndarray, sudden: np.ndarray, options: LabelsOptions) -> list[CycleChange]:
    """Find the frames at which labels change in cycles of three and more.

    Parameters
    ----------
    positions : np.ndarray
        Positions (frames, markers, 3), mm, NaN = missing.
    sudden : np.ndarray
        Where the velocity of a marker breaks, bool (frames, markers).
    options : LabelsOptions
        Thresholds of a change of labels, and how clear the distances must be.

    Returns
    -------
    list[CycleChange]
        The changes, by frame: each jump is at least `floor_mm`, and what remains of them with the labels changed back is
        small.
    """
    ratio, found = options.max_remaining_fraction, []
    for t in np.flatnonzero(sudden.sum(axis=1) >= 3):
        candidates = np.flatnonzero(sudden[t] & ~np.isnan(positions[max(t - 2, 0) : t + 1]).any(axis=(0, 2)))
        if len(candidates) < 3 or t < 2:
            continue
        before, last = positions[t - 2 : t, candidates]
        # A marker continues its motion, or stays: after an exchange of a single frame the step before is no estimate of its velocity.
        far = np.minimum(*(distances(expected, positions[t, candidates]) for expected in (2 * last - before, last)))
        for cycle in map_cycles(np.argmin(far, axis=1)):
            own = np.array(cycle)
            jump, remaining = far[own, own].min(), far[own, np.roll(own, -1)].max()
            if jump >= options.floor_mm and remaining <= ratio * jump:
                members = candidates[own].tolist()
                first = members.index(min(members))
                score = float(ratio * jump / max(remaining, 1e-3 * jump))
                found.append(CycleChange(int(t), tuple(members[first:] + members[:first]), score))
    return found


def map_cycles(following: np.ndarray) -> list[list[int]]:
    """List the cycles of at least three indices of a map.

    Parameters
    ----------
    following : np.ndarray
        The index to which each index is mapped (n,).

    Returns
    -------
    list[list[int]]
        Each cycle once.
    """
    found, seen = [], np.zeros(len(following), bool)
    for start in range(len(following)):
        path = [start]
        while not seen[path[-1]] and following[path[-1]] not in path:
            path.append(int(following[path[-1]]))
        closing = int(following[path[-1]])
        cycle = path[path.index(closing) :] if closing in path and not seen[path].any() else []
        seen[path] = True
        if len(cycle) >= 3:
            found.append(cycle)
    return found


def _exchanged_stretches(
    scene: Scene, markers: tuple[int, ...], changes: Sequence[CycleChange], options: LabelsOptions
) -> list[ExchangedStretch]:
    """The stretches over which some markers are clearly exchanged, given all their changes."""
    stretches = list(pairwise([0, *(change.frame for change in changes), len(scene.positions)]))
    best: list[tuple[Permutation, float]] = []
    for permutations in possible_permutations(markers, [change.cycle for change in changes]):
        clearness = [
            0.0 if one.is_identity else stretch_clearness(scene, one, *place, neighbours=options.shape_neighbours)
            for one, place in zip(permutations, stretches, strict=True)
        ]
        candidate = list(zip(permutations, clearness, strict=True))
        if not best or _total(candidate, stretches) > _total(best, stretches):
            best = candidate
    return [
        ExchangedStretch(start, stop, permutation, min(c.score for c in changes if c.frame in (start, stop)))
        for (start, stop), (permutation, clearness) in zip(stretches, best, strict=True)
        if clearness >= options.min_cycle_clearness
    ]


def _total(candidate: Sequence[tuple[Permutation, float]], stretches: Sequence[tuple[int, int]]) -> float:
    """Sum of the clearness over all frames."""
    frames = [stop - start for start, stop in stretches]
    return sum(n * clearness for n, (_, clearness) in zip(frames, candidate, strict=True))
