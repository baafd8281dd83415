"""Half-open intervals [start, stop) of samples: runs of a mask, and durations as numbers of samples."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np


def runs(mask: np.ndarray) -> Iterator[tuple[int, int]]:
    """Find the intervals over which a mask is True.

    Parameters
    ----------
    mask : np.ndarray
        Bool (n,).

    Yields
    ------
    tuple[int, int]
        Half-open interval [start, stop), ascending.
    """
    edges = np.flatnonzero(np.diff(np.concatenate(([False], np.asarray(mask, bool), [False])).astype(np.int8)))
    yield from zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)


def samples(seconds: float, rate: float, *, odd: bool = False) -> int:
    """Convert a duration to a number of samples.

    Parameters
    ----------
    seconds : float
        Duration, s.
    rate : float
        Sampling rate, Hz.
    odd : bool
        Whether to round to an odd number, as a centred window needs.

    Returns
    -------
    int
        The nearest whole number (halves are rounded up), at least 1.
    """
    count = seconds * rate
    whole = 2 * int(np.floor(count / 2 + 1e-9)) + 1 if odd else int(np.floor(count + 0.5 + 1e-9))
    return max(1, whole)
