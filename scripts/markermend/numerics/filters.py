"""Filters of one signal that never look across a gap: differences, moving median and sum, Savitzky-Golay, band-pass, low-pass.

A signal is a float vector with NaN where nothing was measured. Each function treats the runs of valid samples one by
one, keeps the signal's length, and leaves NaN where NaN was. Lengths are in samples.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from markermend.numerics.intervals import runs


def per_run(operate: Callable[[np.ndarray], np.ndarray], signal: np.ndarray) -> np.ndarray:
    """Apply an operation to each run of valid samples on its own.

    Parameters
    ----------
    operate : Callable[[np.ndarray], np.ndarray]
        Maps a vector without NaN to one of the same length.
    signal : np.ndarray
        Signal (frames,), NaN = missing.

    Returns
    -------
    np.ndarray
        Result (frames,); NaN where the signal is NaN.
    """
    out = np.full(len(signal), np.nan)
    for start, stop in runs(~np.isnan(signal)):
        out[start:stop] = operate(signal[start:stop])
    return out


def difference(signal: np.ndarray) -> np.ndarray:
    """Subtract from each sample the one before it.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.

    Returns
    -------
    np.ndarray
        First differences (frames,); 0 at the first sample of a run, NaN where the signal is NaN.

    References
    ----------
    skurowski2022 eq 12, 19, 26.
    """
    return per_run(lambda run: np.diff(run, prepend=run[:1]), signal)


def moving_median(signal: np.ndarray, window: int) -> np.ndarray:
    """Take the median over a window centred on each sample.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    window : int
        Length of the window, odd, samples.

    Returns
    -------
    np.ndarray
        Medians (frames,); runs are extended by their first and last sample. NaN where the signal is NaN.
    """
    from scipy import ndimage  # slow to import

    return per_run(lambda run: ndimage.median_filter(run, window, mode="nearest"), signal)


def smoothing_matrix(window: int, order: int) -> np.ndarray:
    """Compute the projection of a window of samples onto polynomials.

    Parameters
    ----------
    window : int
        Length of the window, samples.
    order : int
        Order of the polynomials.

    Returns
    -------
    np.ndarray
        Matrix (window, window) that replaces samples by the polynomial fitted to them.

    References
    ----------
    skurowski2022 eq 6, 8.
    """
    offsets = np.linspace(-1.0, 1.0, window) if window > 1 else np.zeros(1)
    basis, _ = np.linalg.qr(np.vander(offsets, order + 1))
    projection: np.ndarray = basis @ basis.T
    return projection


def high_pass(signal: np.ndarray, window: int, order: int) -> np.ndarray:
    """Subtract the Savitzky-Golay smooth from a signal; polynomials up to the order vanish, also at the ends.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    window : int
        Length of the window, odd and above the order, samples. A shorter run gets one polynomial, of a lower order if
        it has too few samples.
    order : int
        Order of the polynomials.

    Returns
    -------
    np.ndarray
        High-pass filtered signal (frames,); NaN where the signal is NaN.

    Raises
    ------
    ValueError
        If the window is even or not above the order.

    References
    ----------
    skurowski2022 eq 7.
    """
    if window % 2 == 0 or window <= order:
        raise ValueError(f"window {window} is not odd or not above the order {order}")

    from scipy import ndimage  # slow to import

    def run_high_pass(run: np.ndarray) -> np.ndarray:
        rest: np.ndarray
        if len(run) < window:
            rest = run - smoothing_matrix(len(run), min(order, len(run) - 1)) @ run
            return rest
        matrix, half = smoothing_matrix(window, order), window // 2
        smooth: np.ndarray = ndimage.convolve1d(run, matrix[half])
        smooth[:half] = matrix[:half] @ run[:window]
        smooth[-half:] = matrix[-half:] @ run[-window:]
        rest = run - smooth
        return rest

    return per_run(run_high_pass, signal)


def moving_sum(signal: np.ndarray, window: int) -> np.ndarray:
    """Sum a signal over a window centred on each sample.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    window : int
        Length of the window, odd, samples.

    Returns
    -------
    np.ndarray
        Sums (frames,); runs are extended by zeros. NaN where the signal is NaN.

    References
    ----------
    skurowski2022 eq 21, 22.
    """
    from scipy import ndimage  # slow to import

    return per_run(lambda run: ndimage.convolve1d(run, np.ones(window), mode="constant"), signal)


def second_difference(signal: np.ndarray) -> np.ndarray:
    """Subtract from each sample the mean of the two beside it, scaled so that white noise keeps its standard deviation.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.

    Returns
    -------
    np.ndarray
        Second differences (frames,), divided by the root of 6; NaN where one of the three samples is missing.
    """
    out = np.full(len(signal), np.nan)
    out[1:-1] = (signal[2:] - 2 * signal[1:-1] + signal[:-2]) / np.sqrt(6)
    return out


def band_pass(signal: np.ndarray, *, band_hz: tuple[float, float], rate: float, half_length: int) -> np.ndarray:
    """Let a band of frequencies through, without a shift in time.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    band_hz : tuple of float
        The band.
    rate : float
        Sampling rate, Hz.
    half_length : int
        Samples on either side of the middle of the filter.

    Returns
    -------
    np.ndarray
        Filtered signal (frames,). Runs are extended by their point reflection; NaN within half of `half_length` of their ends, in
        runs that are not longer than the filter, and where the signal is NaN.

    References
    ----------
    Oppenheim, Schafer (2010), Discrete-Time Signal Processing, section 7.5: the window method (Hamming).
    """
    taps = _band_pass_taps(band_hz[0] / rate, band_hz[1] / rate, half_length)

    def run_band_pass(run: np.ndarray) -> np.ndarray:
        inside = np.full(len(run), np.nan)
        if len(run) > len(taps):
            longer = np.pad(run, half_length, mode="reflect", reflect_type="odd")
            border = half_length // 2
            inside[border:-border] = _convolve(longer, taps)[border:-border]
        return inside

    return per_run(run_band_pass, signal)


def _band_pass_taps(low: float, high: float, half_length: int) -> np.ndarray:
    """Taps of a band-pass between two frequencies, cycles per sample, of gain 1 in the middle of the band."""
    lag = np.arange(-half_length, half_length + 1)
    taps = (2 * high * np.sinc(2 * high * lag) - 2 * low * np.sinc(2 * low * lag)) * np.hamming(len(lag))
    scaled: np.ndarray = taps / (taps * np.cos(np.pi * (low + high) * lag)).sum()
    return scaled


def _convolve(signal: np.ndarray, taps: np.ndarray) -> np.ndarray:
    """Convolve a signal (n,) with k < n symmetric taps where they lie inside it (n - k + 1,), by Fourier transforms of overlapping blocks."""
    block = 1 << int(np.ceil(np.log2(8 * len(taps))))
    step, count = block - len(taps) + 1, len(signal) - len(taps) + 1
    blocks = -(-count // step)
    padded = np.pad(signal, (0, (blocks - 1) * step + block - len(signal)))
    spectrum = np.fft.rfft(np.lib.stride_tricks.sliding_window_view(padded, block)[::step], axis=1)
    # The first samples of each block are those into which its end is wrapped.
    whole = np.fft.irfft(spectrum * np.fft.rfft(taps, block), block, axis=1)
    inside: np.ndarray = whole[:, len(taps) - 1 :].reshape(-1)[:count]
    return inside


def low_pass(signal: np.ndarray, *, cutoff_hz: float, rate: float, order: int = 2) -> np.ndarray:
    """Remove what is faster than a frequency, without a shift in time.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames,), NaN = missing.
    cutoff_hz : float
        Frequency at which half of the amplitude is left.
    rate : float
        Sampling rate, Hz.
    order : int
        Order of the filter, which runs forwards and backwards.

    Returns
    -------
    np.ndarray
        Filtered signal (frames,); NaN where the signal is. Runs too short for the filter are left as they are.

    References
    ----------
    Winter (2009), Biomechanics and Motor Control of Human Movement, section 3.4.4: the Butterworth filter.
    """
    from scipy.signal import butter, filtfilt  # slow to import

    coefficients = butter(order, cutoff_hz, fs=rate)
    shortest = 3 * (order + 1)

    def run_low_pass(run: np.ndarray) -> np.ndarray:
        return run if len(run) <= shortest else np.asarray(filtfilt(*coefficients, run))

    return per_run(run_low_pass, signal)
