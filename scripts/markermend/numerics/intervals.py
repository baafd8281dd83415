"""Half-open intervals [start, stop) of samples: runs of a mask, and durations as numbers of samples."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np


def runs(mask: np.ndarray) -> Iterator[tuple[int, int]]:
    """Yield the half-open intervals [start, stop) over which a bool vector is True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], np.asarray(mask, bool), [False])).astype(np.int8)))
    yield from zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)


def samples(seconds: float, rate: float, *, odd: bool = False) -> int:
    """The number of samples, at least 1, in so many seconds: the nearest whole (halves up) or, if wanted, odd number."""
    count = seconds * rate
    whole = 2 * int(np.floor(count / 2 + 1e-9)) + 1 if odd else int(np.floor(count + 0.5 + 1e-9))
    return max(1, whole)
