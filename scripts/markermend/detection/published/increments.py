"""Increments of one coordinate: thresholds, sudden changes, and pairs of opposite ones (skurowski2022 3.4)."""

from __future__ import annotations

import numpy as np

from markermend.numerics import filters, intervals
from markermend.numerics.filters import per_run
from markermend.numerics.morphology import dilation
from markermend.numerics.robust import mad_std
from markermend.options.detection.published import ThresholdOptions


def threshold(change: np.ndarray, *, scale: str, sigmas: float, floor_mm: float) -> float:
    """Compute the threshold of a sudden change.

    Parameters
    ----------
    change : np.ndarray
        Increments of any shape, mm; NaN are ignored.
    scale : {"mad", "std"}
        Estimator of their standard deviation: from the median absolute deviation, or the plain one.
    sigmas : float
        Threshold in standard deviations.
    floor_mm : float
        Smallest threshold, mm.

    Returns
    -------
    float
        The threshold, mm.

    Raises
    ------
    ValueError
        For another estimator.
    """
    finite = change[np.isfinite(change)]
    if scale not in ("mad", "std"):
        raise ValueError(f"scale {scale!r} is neither mad nor std")
    sigma = mad_std(finite) if scale == "mad" or not finite.size else float(np.std(finite))
    return max(sigmas * sigma, floor_mm)


def thresholds(changes: np.ndarray, options: ThresholdOptions) -> np.ndarray:
    """Compute the threshold of a sudden change for each coordinate.

    Parameters
    ----------
    changes : np.ndarray
        Increments (frames, markers, coordinates), mm; NaN are ignored.
    options : ThresholdOptions
        Threshold in standard deviations, their estimator, and over what they are taken.

    Returns
    -------
    np.ndarray
        Thresholds (markers, coordinates), mm.

    Raises
    ------
    ValueError
        For another set of coordinates.
    """

    def compute(own: np.ndarray) -> float:
        return threshold(own, scale=options.scale_estimator, sigmas=options.threshold_sigmas, floor_mm=options.floor_mm)

    over = options.sigma_over
    if over == "recording":
        return np.full(changes.shape[1:], compute(changes))
    if over == "marker":
        return np.array([np.full(changes.shape[2], compute(own)) for own in changes.swapaxes(0, 1)])
    if over == "coordinate":
        return np.array([[compute(own) for own in marker.T] for marker in changes.swapaxes(0, 1)])
    raise ValueError(f"sigma over {over!r} is none of coordinate, marker and recording")


def edges(change: np.ndarray, level: float | np.ndarray, reach: int) -> np.ndarray:
    """Find the sudden changes in high-passed increments that are no side lobe of the filter.

    Parameters
    ----------
    change : np.ndarray
        High-passed increments (frames,), mm, NaN = missing.
    level : float or np.ndarray
        The threshold, mm.
    reach : int
        Half the length of the filter, samples.

    Returns
    -------
    np.ndarray
        Sorted frames of the changes above the threshold that none within two samples exceeds, nor any within the reach
        by more than a factor of two.
    """
    size = per_run(np.abs, change)
    kept = (
        (size > level) & (size >= dilation(size, min(5, 2 * reach + 1))) & (2 * size >= dilation(size, 2 * reach + 1))
    )
    return np.flatnonzero(kept)


def derivative_pairs(
    change: np.ndarray, at: np.ndarray, *, shortest: int, longest: int, ratio: float
) -> tuple[list[tuple[int, int]], np.ndarray]:
    """Pair opposite sudden changes, the nearest first.

    Parameters
    ----------
    change : np.ndarray
        Increments (frames,), mm, NaN = missing.
    at : np.ndarray
        Sorted frames of the sudden changes.
    shortest, longest : int
        Shortest and longest distance of a pair, samples.
    ratio : float
        Neither change of a pair is less than this part of the other (0 to 1).

    Returns
    -------
    pairs : list[tuple[int, int]]
        Intervals [n1, n2) in order; none has a gap inside, no change is used twice, pairs do not cross (a change inside a
        pair belongs to it), and of pairs of equal length the earlier is made first.
    alone : np.ndarray
        Frames of the changes that belong to no pair.

    References
    ----------
    skurowski2022 3.4.1, find_derivate_pairs.
    """
    gaps = np.cumsum(np.isnan(change))
    within = np.searchsorted(at, at + longest, side="right") - np.arange(len(at)) - 1
    first = np.repeat(np.arange(len(at)), within)
    second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(within) - within, within)
    n1, n2 = at[first], at[second]
    balance = np.abs(change[n1] / change[n2]) if len(n1) else np.zeros(0)
    fits = (change[n1] * change[n2] < 0) & (n2 - n1 >= shortest) & (n2 - n1 <= longest) & (gaps[n1] == gaps[n2])
    fits &= (balance >= ratio) & (balance * ratio <= 1)
    pairs: list[tuple[int, int]] = []
    used = np.zeros(len(at), bool)
    for k in np.flatnonzero(fits)[np.lexsort((n1[fits], (n2 - n1)[fits]))]:
        if not used[first[k] : second[k] + 1].any():
            used[first[k] : second[k] + 1] = True
            pairs.append((int(n1[k]), int(n2[k])))
    return sorted(pairs), at[~used]


def high_passed_increments(signal: np.ndarray, *, window_s: float, order: int, rate: float) -> np.ndarray:
    """Subtract the Savitzky-Golay smooth from the increments of a signal.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), mm, NaN = missing.
    window_s : float
        Window of the filter, s; longer where the order needs it.
    order : int
        Order of its polynomials.
    rate : float
        Sampling rate, Hz.

    Returns
    -------
    np.ndarray
        High-passed increments (frames,), mm, NaN where the signal is.

    References
    ----------
    skurowski2022 eq 26, 27.
    """
    window = max(intervals.samples(window_s, rate, odd=True), 2 * order + 1)
    return filters.high_pass(filters.difference(signal), window, order)
