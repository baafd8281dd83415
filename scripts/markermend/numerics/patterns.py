"""Missing-data patterns: groups of frames in which the same markers are observed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

WORD_BYTES = 8
"""Bytes of the numbers as which rows are compared."""


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
    group = _ranks(rows)
    order = np.argsort(group, kind="stable")
    members = np.split(order, np.cumsum(np.bincount(group))[:-1])
    yield from ((rows[own[0]], own) for own in members)


def _ranks(rows: np.ndarray) -> np.ndarray:
    """The places (n,) of rows among the distinct ones in lexicographic order.

    Rows are compared as whole numbers of 64 bits each, which takes a fraction of the time of comparing rows.
    """
    packed = np.packbits(np.ascontiguousarray(rows), axis=1)
    packed = np.pad(packed, ((0, 0), (0, -packed.shape[1] % WORD_BYTES)))
    group = np.zeros(len(rows), np.int64)
    for word in packed.view(">u8").T:
        rank = np.unique(word.astype(np.uint64), return_inverse=True)[1]
        group = np.unique(group * (rank.max() + 1) + rank, return_inverse=True)[1]
    return group


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
