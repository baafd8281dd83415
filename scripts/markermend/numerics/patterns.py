"""Patterns of missing data: rows that show the same columns."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np


def group_by_pattern(seen: np.ndarray, minimum: int) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Group frames by the markers that they show: yield a mask (markers,) and the frames (indices) that share it.

    seen: bool (frames, markers). Where at least `minimum` markers are seen in all frames, these alone count and there
    is one group.
    """
    throughout = seen.all(axis=0)
    if throughout.sum() >= minimum:
        seen = np.broadcast_to(throughout, seen.shape)
    patterns, inverse = np.unique(seen, axis=0, return_inverse=True)
    for number, pattern in enumerate(patterns):
        yield pattern, np.flatnonzero(inverse.reshape(-1) == number)
