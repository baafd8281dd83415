"""Increments of one coordinate as published: thresholds, sudden changes, and pairs of opposite ones (skurowski2022 3.4)."""

from __future__ import annotations

import numpy as np

from markermend.numerics import filters, intervals
from markermend.numerics.filters import per_run
from markermend.numerics.morphology import dilation
from markermend.numerics.robust import mad_std


def threshold(change: np.ndarray, *, scale: str, sigmas: float, floor_mm: float) -> float:
    """What a change must exceed, mm: so many standard deviations (scale `mad`: robust ones, `std`: plain), or the floor.

    NaN ignored. Raises ValueError for another scale.
    """
    finite = change[np.isfinite(change)]
    if scale not in ("mad", "std"):
        raise ValueError(f"scale {scale!r} is neither mad nor std")
    sigma = mad_std(finite) if scale == "mad" or not finite.size else float(np.std(finite))
    return max(sigmas * sigma, floor_mm)


def edges(change: np.ndarray, level: float | np.ndarray, reach: int) -> np.ndarray:
    """Indices of the sudden changes in a high-passed difference: above the level and not a filter's side lobe.

    A change is kept where none within two samples is larger and none within `reach` is more than twice as large.
    """
    size = per_run(np.abs, change)
    kept = (
        (size > level) & (size >= dilation(size, min(5, 2 * reach + 1))) & (2 * size >= dilation(size, 2 * reach + 1))
    )
    return np.flatnonzero(kept)


def derivative_pairs(
    change: np.ndarray, at: np.ndarray, *, shortest: int, longest: int, ratio: float
) -> tuple[list[tuple[int, int]], np.ndarray]:
    """Pair opposite sudden changes (find_derivate_pairs of skurowski2022 3.4.1): intervals [n1, n2) and what is left.

    change: (frames,), signed. at: sorted indices of its sudden changes. A pair is opposite in sign, shortest <= n2 - n1
    <= longest samples apart with no gap between, and neither is less than `ratio` of the other. The nearest pairs come
    first (ties: the earlier), each change is used once, pairs do not cross, and a change inside a pair belongs to it.
    Returns the pairs in order and the indices that belong to none.
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


def difference_high_pass(signal: np.ndarray, *, window_s: float, order: int, rate: float) -> np.ndarray:
    """Differences less their Savitzky-Golay smooth (skurowski2022 eq 26, 27), over a window that the order allows."""
    window = max(intervals.samples(window_s, rate, odd=True), 2 * order + 1)
    return filters.high_pass(filters.difference(signal), window, order)
