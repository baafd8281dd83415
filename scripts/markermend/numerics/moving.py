"""Moving sums, means and extremes along the first axis, of arrays without missing samples."""

from __future__ import annotations

import numpy as np

from markermend.numerics import ranks

LONGEST_SORTED = 9
"""Samples of the longest window that is sorted as a whole; scipy counts in longer ones."""


def reduce_windows(values: np.ndarray, window: int, *, operate: np.ufunc) -> np.ndarray:
    """Reduce all windows of a length by an associative operation, from windows whose lengths are powers of two.

    Sums are made of no differences: they are as accurate in long recordings as in short ones, and those of squares are never negative.

    Parameters
    ----------
    values : np.ndarray
        Values (frames, ...).
    window : int
        Length of the windows, samples, at most the number of frames.
    operate : np.ufunc
        The operation, such as `np.add` or `np.minimum`.

    Returns
    -------
    np.ndarray
        The result for each window (frames - window + 1, ...).
    """
    count = len(values) - window + 1
    block, length, start = values, 1, 0
    reduced: np.ndarray | None = None
    while True:
        if window & length:
            part = block[start : start + count]
            reduced, start = part if reduced is None else operate(reduced, part), start + length
        if start == window:
            assert reduced is not None
            return reduced
        block, length = operate(block[:-length], block[length:]), 2 * length


def centred(values: np.ndarray, window: int, *, mode: str) -> np.ndarray:
    """Pad values such that there is a window about each of them.

    Parameters
    ----------
    values : np.ndarray
        Values (frames, ...).
    window : int
        Length of the windows, samples; one of even length begins half of it before its sample.
    mode : str
        How `numpy.pad` extends them.

    Returns
    -------
    np.ndarray
        The values with window - 1 more (frames + window - 1, ...).
    """
    widths = [(window // 2, window - 1 - window // 2)] + [(0, 0)] * (values.ndim - 1)
    return np.pad(values, widths, mode=mode)  # type: ignore[call-overload, no-any-return]


def mean(values: np.ndarray, window: int, *, mode: str = "symmetric") -> np.ndarray:
    """Take the mean over a window about each sample.

    Parameters
    ----------
    values : np.ndarray
        Values (frames, ...).
    window : int
        Length of the window, samples.
    mode : str, optional
        How `numpy.pad` extends the values at their ends.

    Returns
    -------
    np.ndarray
        Means (frames, ...).
    """
    means: np.ndarray = reduce_windows(centred(values, window, mode=mode), window, operate=np.add) / window
    return means


def minimum(values: np.ndarray, window: int) -> np.ndarray:
    """Take the minimum over a window about each sample; beyond the ends the values are reflected.

    Parameters
    ----------
    values : np.ndarray
        Values (frames, ...).
    window : int
        Length of the window, samples.

    Returns
    -------
    np.ndarray
        Minima (frames, ...).
    """
    return reduce_windows(centred(values, window, mode="symmetric"), window, operate=np.minimum)


def median(values: np.ndarray, window: int) -> np.ndarray:
    """Take the median over a window about each sample; beyond the ends the values are reflected.

    Parameters
    ----------
    values : np.ndarray
        Values (frames, ...).
    window : int
        Length of the window, odd, samples.

    Returns
    -------
    np.ndarray
        Medians (frames, ...).
    """
    if window > LONGEST_SORTED:
        from scipy import ndimage  # 0.15 s to import

        far: np.ndarray = ndimage.median_filter(values, (window,) + (1,) * (values.ndim - 1), mode="reflect")
        return far
    padded = centred(values, window, mode="symmetric")
    return ranks.median([padded[k : k + len(values)] for k in range(window)])
