"""A moving median and then a moving mean over windows that stay centred: near a gap or an end they shrink."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from markermend.numerics.intervals import runs

MIN_SHRUNKEN_HALF = 2
"""A window that would shrink to fewer samples on either side leaves the sample as it is."""


def smooth_symmetrically(values: np.ndarray, window: int) -> np.ndarray:
    """Smooth each column by a moving median, then by a moving mean.

    Parameters
    ----------
    values : np.ndarray
        Values (n, columns), NaN = missing; they are not modified.
    window : int
        Length of the windows, odd, samples; less than 3 leaves the values as they are.

    Returns
    -------
    np.ndarray
        Smoothed values (n, columns); NaN where the values are NaN.

    References
    ----------
    The filter of the program that was released with tits2018, which its text does not mention.
    """
    if window < 3:
        return values
    reach = _reach(~np.isnan(values).any(axis=1))
    return _slide(_slide(values, reach, window // 2, np.median), reach, window // 2, np.mean)


def _reach(seen: np.ndarray) -> np.ndarray:
    """For each sample (n,) how many seen ones lie on the side on which fewer do before a gap or an end; -1 for missing ones."""
    reach = np.full(len(seen), -1)
    for start, stop in runs(seen):
        place = np.arange(stop - start)
        reach[start:stop] = np.minimum(place, place[::-1])
    return reach


def _slide(values: np.ndarray, reach: np.ndarray, half: int, pick: Callable[..., np.ndarray]) -> np.ndarray:
    """Apply a statistic to the window of each sample, which has as many samples on either side as it can, at most `half`."""
    out = values.copy()
    for own in range(min(half, MIN_SHRUNKEN_HALF), half + 1):
        rows = np.flatnonzero(reach >= half if own == half else reach == own)
        if len(rows):
            windows = np.lib.stride_tricks.sliding_window_view(values, 2 * own + 1, axis=0)
            out[rows] = pick(windows[rows - own], axis=-1)
    return out
