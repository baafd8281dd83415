"""Gaps of complete stretches of a recording: anywhere, or where a marker moves as it seldom does."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from benchmarks.support.gap_cases import Gap
from markermend.core.recording import Recording

SEVERAL = 0.7
"""Share of the largest ratio of motions from which on a stretch counts as unusual."""


def random_gaps(whole: Recording, length: int, markers: int, rng: np.random.Generator) -> list[Gap]:
    """Some markers that miss the same stretch at random; none where too few are seen for so long."""
    for start in rng.permutation(np.arange(1, whole.frames - length - 1)).tolist():
        there = np.flatnonzero(_seen(whole, np.array([start]), length)[0])
        if len(there) >= markers:
            return [(int(marker), start, start + length) for marker in rng.choice(there, markers, replace=False)]
    return []


def unusual_gaps(
    whole: Recording, near: Sequence[np.ndarray], length: int, markers: int, rng: np.random.Generator
) -> list[Gap]:
    """A marker and its nearest neighbours that miss a stretch in which the marker moves far more than usual.

    Motion is the distance of the middle of a stretch from the middle between its borders; the marker is one of the quarter with the
    largest ratio of the most to the median.
    """
    starts = np.arange(4, whole.frames - length - 4, max(1, length // 8))
    seen, path = _seen(whole, starts, length), whole.positions
    motion = np.linalg.norm(path[starts + length // 2] - (path[starts - 1] + path[starts + length]) / 2, axis=2)
    motion = np.where(seen, motion, np.nan)
    ratio = np.nan_to_num(motion / (np.nanmedian(motion, axis=0) + 1.0))
    most = ratio.max(axis=0)
    marker = int(rng.choice(np.argsort(-most)[: max(4, len(most) // 4)]))
    first = int(rng.choice(np.flatnonzero(ratio[:, marker] >= SEVERAL * most[marker])))
    mates = [int(other) for other in near[marker] if seen[first, other]][: markers - 1]
    start = int(starts[first])
    return [(gone, start, start + length) for gone in sorted([marker, *mates])]


def _seen(whole: Recording, starts: np.ndarray, length: int) -> np.ndarray:
    """Whether each marker is seen throughout each stretch and at its borders, bool (starts, markers)."""
    lost = np.concatenate([np.zeros((1, len(whole.markers)), int), np.cumsum(whole.missing, axis=0)])
    seen: np.ndarray = lost[starts + length + 1] == lost[starts - 1]
    return seen
