"""Swapped labels: from one frame to the next, each of two markers stands where the other one was.

Nothing here is learned from the recording but distances, so that a swap that lasts cannot hide by being learned. The
evidence is twofold. An *exchange* is a frame at which the vector between two markers turns to its opposite while their
midpoint goes on; with one of the four samples missing, one marker jumps to where the other was seen a frame before or
after. Between exchanges, the *shape* tells which is which: distances to other markers, against their medians.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.core.events import Event
from markermend.detection import label_permutations
from markermend.numerics import intervals, robust
from markermend.numerics.intervals import runs
from markermend.options.detection import LabelsOptions
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Exchange:
    """Two markers (indices) change places on the way to a frame; score in units of the threshold."""

    first: int
    second: int
    frame: int
    score: float


def _length(vectors: np.ndarray) -> np.ndarray:
    """Euclidean length along the last axis."""
    return np.sqrt(np.einsum("...i,...i->...", vectors, vectors))


def _usual(change: np.ndarray, window: int) -> np.ndarray:
    """Median of a change (frames,) over a window about each frame, NaN ignored, 0 where there is none."""
    return np.nan_to_num(robust.moving_median_across_gaps(change, window))


def jumping(positions: np.ndarray, *, window: int, options: LabelsOptions) -> np.ndarray:
    """Bool (frames, markers): True where a marker's velocity breaks as an exchange would make it.

    positions: (frames, markers, 3), mm, NaN = missing. The step to this frame differs from the median of the steps about
    it (over the window, frames) by more than so many times the usual difference, and more than the floor.
    """
    step = np.diff(positions, axis=0, prepend=np.nan)
    out = np.zeros(positions.shape[:2], bool)
    for m in range(positions.shape[1]):
        usual = np.stack([robust.moving_median_across_gaps(axis, window) for axis in step[:, m].T], axis=1)
        change = _length(step[:, m] - usual)
        level = np.maximum(options.jump_factor * _usual(change, window), options.floor_mm)
        out[:, m] = np.nan_to_num(change) > level
    return out


def exchanges(scene: Scene, sudden: np.ndarray, *, window: int, options: LabelsOptions) -> list[Exchange]:
    """Find the frames at which two markers change places, in time; a marker takes part in one at a time.

    scene: positions (frames, markers, 3), mm, NaN = missing. sudden, window: see jumping.
    """
    positions, present = scene.positions, scene.present
    before, now = np.roll(present, 1, axis=0), present
    before[0] = False
    found: list[Exchange] = []
    for a in range(positions.shape[1]):
        rows = np.flatnonzero(sudden[:, a])
        if not len(rows):
            continue
        both = sudden[rows, a + 1 :]
        for k, b in np.argwhere(both):
            found += _whole(positions, a, a + 1 + int(b), int(rows[k]), window, options)
        # Where the other one has a sample on one side of the jump alone, it is there that this one must come to or from.
        single = before[rows] != now[rows]
        for k, b in np.argwhere(single):
            found += _half(positions, a, int(b), int(rows[k]), options)
    return _disjoint(found)


def _whole(positions: np.ndarray, a: int, b: int, t: int, window: int, options: LabelsOptions) -> list[Exchange]:
    """The exchange of two markers that are seen on both sides of it, if it is one and leaves nothing like a jump.

    Where three markers change places in a ring, exchanging two of them would leave a smaller jump.
    """
    near = positions[max(t - window // 2, 1) - 1 : t + window // 2 + 1, [a, b]]
    usual = float(np.nanmedian(_length(np.diff(near[:, 0] - near[:, 1], axis=0))))
    apart = positions[t - 1 : t + 1, a] - positions[t - 1 : t + 1, b]
    middle = (positions[max(t - 2, 0) : t + 1, a] + positions[max(t - 2, 0) : t + 1, b]) / 2
    turned = float(_length(apart[1] - apart[0]))
    left = float(_length(apart[1] + apart[0]))
    drift = 2 * float(np.nanmin([_length(middle[-1] - middle[-2]), _length(middle[-1] - 2 * middle[-2] + middle[0])]))
    if left > max(options.jump_factor * usual, options.floor_mm):
        return []
    return _accept(a, b, t, turned, max(left, drift), options)


def _half(positions: np.ndarray, a: int, b: int, t: int, options: LabelsOptions) -> list[Exchange]:
    """The exchange of a marker with one that is seen on one side of it alone, if it is one."""
    jump = float(_length(positions[t, a] - positions[t - 1, a]))
    if np.isnan(positions[t, b, 0]):
        left = float(_length(positions[t, a] - positions[t - 1, b]))
    else:
        left = float(_length(positions[t, b] - positions[t - 1, a]))
    return _accept(a, b, t, jump, left, options)


def _accept(a: int, b: int, t: int, jump: float, left: float, options: LabelsOptions) -> list[Exchange]:
    """The exchange, if little enough of its jump is left once it is undone."""
    if jump < options.floor_mm or left > options.max_remaining_fraction * jump:
        return []
    return [Exchange(min(a, b), max(a, b), t, options.max_remaining_fraction * jump / max(left, 1e-3 * jump))]


def _disjoint(found: Sequence[Exchange]) -> list[Exchange]:
    """The exchanges in time, of those of one marker at one frame the best."""
    taken: set[tuple[int, int]] = set()
    kept = []
    for exchange in sorted(set(found), key=lambda e: (-e.score, e.frame, e.first, e.second)):
        ends = {(exchange.frame, exchange.first), (exchange.frame, exchange.second)}
        if not ends & taken:
            taken |= ends
            kept.append(exchange)
    return sorted(kept, key=lambda e: (e.frame, e.first, e.second))


def shape_vote(scene: Scene, a: int, b: int, *, near: int) -> np.ndarray:
    """How clearly the distances to other markers say that a and b are not swapped, (frames,), from -1 (they are) to 1.

    The others are the `near` first neighbours of each; distances are compared with their medians over the recording,
    steady ones counting most. 0 where neither of the two is seen.
    """
    around = dict.fromkeys([*scene.neighbours[a][:near], *scene.neighbours[b][:near]])
    others = np.array([n for n in around if n not in (a, b)], int)
    distance = _length(scene.positions[:, [a, b], None] - scene.positions[:, None, others])
    known = ~np.isnan(distance).all(axis=0)
    low, usual, high = np.full((3, *known.shape), np.nan)
    low[known], usual[known], high[known] = np.nanpercentile(distance[:, known], [16, 50, 84], axis=0)
    weight = 1 / (1 + ((high - low) ** 2).sum(axis=0))
    labelled, exchanged = (np.nansum(weight * (distance - own) ** 2, axis=(1, 2)) for own in (usual, usual[::-1]))
    vote: np.ndarray = (exchanged - labelled) / np.maximum(exchanged + labelled, 1e-9)
    return vote


def swapped(
    scene: Scene, a: int, b: int, own: Sequence[Exchange], *, options: LabelsOptions
) -> list[tuple[int, int, float]]:
    """The intervals over which two markers stand in for each other: start, stop, and score, given their exchanges.

    While at least one of the two is seen, every exchange turns the state over. Which of the two states is the swapped
    one is told by the shape over all that time, and by its being the shorter; where they do not tell, nothing is found.
    """
    vote = shape_vote(scene, a, b, near=options.shape_neighbours)
    score = {exchange.frame: exchange.score for exchange in own}
    found = []
    for start, stop in runs(scene.present[:, a] | scene.present[:, b]):
        cuts = [t for t in sorted(score) if start < t < stop]
        pieces = list(itertools.pairwise([start, *cuts, stop]))
        state = np.concatenate([np.full(v - u, (-1) ** k) for k, (u, v) in enumerate(pieces)])
        evidence = float(np.mean(state * (vote[start:stop] + options.recorded_label_weight)))
        if not cuts or abs(evidence) < options.min_clearness:
            continue
        for u, v in pieces[int(evidence > 0) :: 2]:
            sides = [score[t] for t in (u, v) if t in cuts]
            if vote[u:v].mean() < (options.recorded_label_weight if len(sides) == 2 else -options.min_clearness):
                found.append((u, v, min(sides)))
    return found


def detect_labels(scene: Scene, *, markers: Sequence[str], options: LabelsOptions) -> list[Event]:
    """Find the swaps of a recording: one event for each marker, with that under whose label it is as partner.

    Two markers are each other's partners; three and more form a ring of partners. All have the same interval.

    scene: positions (frames, markers, 3), mm, NaN = missing. Of swaps of one marker that overlap, the surer one is told.
    """
    window = max(5, intervals.samples(options.window_s, scene.rate, odd=True))
    sudden = jumping(scene.positions, window=window, options=options)
    by_pair: dict[tuple[int, int], list[Exchange]] = {}
    for exchange in exchanges(scene, sudden, window=window, options=options):
        by_pair.setdefault((exchange.first, exchange.second), []).append(exchange)
    in_rings = label_permutations.swapped(
        scene,
        sudden,
        ratio=options.max_remaining_fraction,
        floor_mm=options.floor_mm,
        near=options.shape_neighbours,
        trust=options.recorded_label_weight,
    )
    candidates = [(score, tuple(under), under, start, stop) for start, stop, under, score in in_rings]
    candidates += [
        (score, pair, dict(zip(pair, pair[::-1], strict=True)), start, stop)
        for pair, own in by_pair.items()
        for start, stop, score in swapped(scene, *pair, own, options=options)
    ]
    taken = np.zeros(scene.present.shape, bool)
    found = []
    # A ring says more than a pair: two of its members may look like one.
    for score, ring, under, start, stop in sorted(candidates, key=lambda c: (-len(c[1]), -c[0], c[1], c[3])):
        if not taken[start:stop, ring].any():
            taken[start:stop, ring] = True
            found += [Event(markers[m], start, stop, max(1.0, score), "xyz", markers[under[m]]) for m in ring]
    return sorted(found, key=lambda event: event.order)
