"""Missing-data patterns: groups of frames in which the same markers are observed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np


def group_rows(rows: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Group the equal rows of a bool matrix.

    Parameters
    ----------
    rows : np.ndarray
        Bool (n, columns).

    Yields
    ------
    tuple[np.ndarray, np.ndarray]
        A distinct row (columns,), in lexicographic order, and the indices (k,), ascending, of the rows that equal it.
    """
    if len(rows) == 0:
        return
    if (rows == rows[:1]).all():
        yield rows[0], np.arange(len(rows))
        return
    distinct, inverse = np.unique(rows, axis=0, return_inverse=True)
    inverse = inverse.reshape(-1)
    order = np.argsort(inverse, kind="stable")
    yield from zip(distinct, np.split(order, np.cumsum(np.bincount(inverse))[:-1]), strict=True)


def group_by_pattern(observed: np.ndarray, minimum: int) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Group frames by the markers observed in them, unless enough markers are observed in all.

    Parameters
    ----------
    observed : np.ndarray
        Bool (frames, markers).
    minimum : int
        If at least this many markers are observed in all frames, only these count, and there is one group.

    Yields
    ------
    tuple[np.ndarray, np.ndarray]
        The pattern, a mask (markers,), and the indices (k,), ascending, of the frames that share it.
    """
    throughout = observed.all(axis=0)
    if throughout.sum() >= minimum:
        observed = np.broadcast_to(throughout, observed.shape)
    yield from group_rows(observed)
