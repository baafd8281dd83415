"""Building blocks of the detectors: robust scale, filters and morphology that never look across a gap.

A signal is a float vector with NaN where nothing was measured. Each function works on its valid runs one by one, keeps
its length, and leaves NaN where NaN was. Lengths are in samples; `samples` makes them from seconds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy import ndimage

from markermend.recording import runs

NORMAL = 1.4826
"""Standard deviation of a normal distribution with median absolute deviation 1."""


def samples(seconds: float, rate: float, *, odd: bool = False) -> int:
    """The number of samples, at least 1, in so many seconds: the nearest whole (halves up) or, if wanted, odd number."""
    count = seconds * rate
    whole = 2 * int(np.floor(count / 2 + 1e-9)) + 1 if odd else int(np.floor(count + 0.5 + 1e-9))
    return max(1, whole)


def deviation(values: np.ndarray) -> float:
    """Robust standard deviation about the median (1.4826 times the median absolute deviation); NaN ignored, 0 if all are."""
    finite = values[np.isfinite(values)]
    return float(NORMAL * np.median(np.abs(finite - np.median(finite)))) if finite.size else 0.0


def per_run(operate: Callable[[np.ndarray], np.ndarray], signal: np.ndarray) -> np.ndarray:
    """Apply an operation to each valid run of a signal on its own."""
    out = np.full(len(signal), np.nan)
    for start, stop in runs(~np.isnan(signal)):
        out[start:stop] = operate(signal[start:stop])
    return out


def difference(signal: np.ndarray) -> np.ndarray:
    """Each sample minus the one before (skurowski2022 eq 12, 19, 26); 0 at the first sample of a run."""
    return per_run(lambda run: np.diff(run, prepend=run[:1]), signal)


def moving_median(signal: np.ndarray, window: int) -> np.ndarray:
    """Median over an odd window about each sample; the first and last sample of a run stand in beyond its ends."""
    return per_run(lambda run: ndimage.median_filter(run, window, mode="nearest"), signal)


def smoothing_matrix(window: int, order: int) -> np.ndarray:
    """The matrix (window, window) that replaces samples by the polynomial fitted to them (skurowski2022 eq 6, 8)."""
    offsets = np.linspace(-1.0, 1.0, window) if window > 1 else np.zeros(1)
    basis, _ = np.linalg.qr(np.vander(offsets, order + 1))
    return basis @ basis.T


def high_pass(signal: np.ndarray, window: int, order: int) -> np.ndarray:
    """Signal minus its Savitzky-Golay smooth (skurowski2022 eq 7): polynomials up to `order` vanish, ends included.

    window: odd, above order. Runs shorter than the window get one polynomial, of a lower order if need be.
    """
    if window % 2 == 0 or window <= order:
        raise ValueError(f"window {window} is not odd or not above the order {order}")

    def run_high_pass(run: np.ndarray) -> np.ndarray:
        if len(run) < window:
            return run - smoothing_matrix(len(run), min(order, len(run) - 1)) @ run
        matrix, half = smoothing_matrix(window, order), window // 2
        smooth = ndimage.convolve1d(run, matrix[half])
        smooth[:half] = matrix[:half] @ run[:window]
        smooth[-half:] = matrix[-half:] @ run[-window:]
        return run - smooth

    return per_run(run_high_pass, signal)


def erosion(signal: np.ndarray, size: int) -> np.ndarray:
    """Least value under a flat structuring element of odd size (skurowski2022 eq 13, read as the minimum)."""
    return per_run(lambda run: ndimage.minimum_filter1d(run, size, mode="constant", cval=np.inf), signal)


def dilation(signal: np.ndarray, size: int) -> np.ndarray:
    """Greatest value under a flat structuring element of odd size (skurowski2022 eq 14, read as the maximum)."""
    return per_run(lambda run: ndimage.maximum_filter1d(run, size, mode="constant", cval=-np.inf), signal)


def opening(signal: np.ndarray, size: int) -> np.ndarray:
    """Erosion, then dilation: removes what is narrower than the element (skurowski2022 eq 15)."""
    return dilation(erosion(signal, size), size)


def closing(signal: np.ndarray, size: int) -> np.ndarray:
    """Dilation, then erosion: fills what is narrower than the element (skurowski2022 eq 16)."""
    return erosion(dilation(signal, size), size)


def top_hat(signal: np.ndarray, size: int) -> np.ndarray:
    """Signal minus its opening: keeps what is narrower than the element (skurowski2022 eq 17)."""
    return signal - opening(signal, size)


def moving_sum(signal: np.ndarray, window: int) -> np.ndarray:
    """Sum over an odd window about each sample (skurowski2022 eq 21, 22); nothing counts beyond the ends of a run."""
    return per_run(lambda run: ndimage.convolve1d(run, np.ones(window), mode="constant"), signal)


def threshold(change: np.ndarray, *, scale: str, sigmas: float, floor_mm: float) -> float:
    """What a change must exceed, mm: so many standard deviations (scale `mad`: robust ones, `std`: plain), or the floor.

    NaN ignored. Raises ValueError for another scale.
    """
    finite = change[np.isfinite(change)]
    if scale not in ("mad", "std"):
        raise ValueError(f"scale {scale!r} is neither mad nor std")
    sigma = deviation(finite) if scale == "mad" or not finite.size else float(np.std(finite))
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


def bridge(signal: np.ndarray, detected: np.ndarray, reach: int) -> np.ndarray:
    """Signal with its detected samples replaced by cubic curves between what stands beside them.

    The slope at either border is the mean over `reach` samples beyond it. Detected samples at the end of a valid run
    have nothing to lean on and become NaN.
    """
    out = np.where(detected, np.nan, signal)
    valid = ~np.isnan(out)
    for start, stop in runs(detected & ~np.isnan(signal)):
        before, after = start - 1, stop
        if before < 0 or after >= len(signal) or not (valid[before] and valid[after]):
            continue
        left, right = np.flatnonzero(~valid[:before]), np.flatnonzero(~valid[after:])
        back = min(reach, before - (left[-1] + 1 if left.size else 0))
        ahead = min(reach, (right[0] if right.size else len(signal) - after) - 1)
        slope0 = (out[before] - out[before - back]) / max(back, 1)
        slope1 = (out[after + ahead] - out[after]) / max(ahead, 1)
        span = after - before
        t = np.arange(1, span) / span
        out[start:stop] = (
            (1 + 2 * t) * (1 - t) ** 2 * out[before]
            + t * (1 - t) ** 2 * span * slope0
            + t**2 * (3 - 2 * t) * out[after]
            + t**2 * (t - 1) * span * slope1
        )
    return out


def moving_median_across(signal: np.ndarray, window: int) -> np.ndarray:
    """Moving median that joins valid runs as if there were no gaps between: for scales, not for detection.

    Within half a window of the ends it stays what it is where the window is whole.
    """
    out = np.full(len(signal), np.nan)
    valid = np.flatnonzero(~np.isnan(signal))
    half = min(window, len(valid)) // 2
    if len(valid):
        median = ndimage.median_filter(signal[valid], 2 * half + 1, mode="nearest")
        out[valid] = median[np.clip(np.arange(len(valid)), half, len(valid) - 1 - half)]
    return out


def usual_size(
    size: np.ndarray, neighbours: Sequence[np.ndarray], *, window: int, near: int, ratio: float
) -> np.ndarray:
    """The usual size of something about each frame, (frames, markers): never below the marker's median.

    It follows what the body is doing: where the moving median of the marker's sizes grows, so does it, but no more than
    `ratio` times as much as the median of its `near` nearest neighbours' does. size: NaN = missing, and so is the
    result.
    """
    overall = np.array([np.median(own[~np.isnan(own)]) if (~np.isnan(own)).any() else 1.0 for own in size.T])
    overall = np.maximum(overall, 1e-3)
    local = np.stack([moving_median_across(own, window) for own in size.T], axis=1) / overall
    livelier = np.maximum(local, 1.0)
    filled = np.nan_to_num(livelier, nan=1.0)
    for m, around in enumerate(neighbours):
        if len(around):
            others = np.median(filled[:, np.asarray(around, int)[:near]], axis=1)
            livelier[:, m] = np.minimum(livelier[:, m], ratio * others)
    return livelier * overall
