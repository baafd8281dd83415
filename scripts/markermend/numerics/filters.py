"""Filters of one signal that never look across a gap: differences, moving median and sum, Savitzky-Golay.

A signal is a float vector with NaN where nothing was measured. Each function works on its valid runs one by one, keeps
its length, and leaves NaN where NaN was. Lengths are in samples."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy import ndimage

from markermend.numerics.intervals import runs


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


def moving_sum(signal: np.ndarray, window: int) -> np.ndarray:
    """Sum over an odd window about each sample (skurowski2022 eq 21, 22); nothing counts beyond the ends of a run."""
    return per_run(lambda run: ndimage.convolve1d(run, np.ones(window), mode="constant"), signal)
