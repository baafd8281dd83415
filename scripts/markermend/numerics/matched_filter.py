"""Matched filters that find raised-cosine pulses in coloured noise.

The filter is the generalised least-squares estimate of the pulse's height together with an unknown constant: of all
weights that do not respond to a constant, those that estimate the height with the least variance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics import robust
from markermend.numerics.intervals import runs
from markermend.numerics.kriging import Covariance, fit_covariance


@dataclass(frozen=True)
class MatchedFilter:
    """A matched filter of one length, scaled to respond to the noise with variance 1.

    Attributes
    ----------
    weights : np.ndarray
        Weights (taps,) on means over `step` samples each.
    step : int
        Number of samples in each mean.
    deviation : float
        Standard deviation of the estimated height of the pulse, in the unit of the signal.
    """

    weights: np.ndarray
    step: int
    deviation: float


def raised_cosine(phase: np.ndarray) -> np.ndarray:
    """Evaluate a raised-cosine (Hann) pulse of height 1.

    Parameters
    ----------
    phase : np.ndarray
        Phases of any shape: the pulse begins at 0 and ends at 1, with slope 0.

    Returns
    -------
    np.ndarray
        Heights of the same shape; 0 outside the pulse.
    """
    height: np.ndarray = 0.5 - 0.5 * np.cos(2 * np.pi * np.clip(phase, 0.0, 1.0))
    return height


def design_filter(covariance: Covariance, *, length: int, flank: float, taps: int, rate: float) -> MatchedFilter:
    """Design the matched filter for pulses of a length.

    Parameters
    ----------
    covariance : Covariance
        Covariance function of the noise.
    length : int
        Length of the pulse, samples.
    flank : float
        Part of the length that the filter covers on either side of the pulse.
    taps : int
        Largest number, about, of means over the pulse: longer pulses are filtered at a lower rate.
    rate : float
        Sampling rate, Hz.

    Returns
    -------
    MatchedFilter
        The filter.

    References
    ----------
    Kay (1998), Fundamentals of Statistical Signal Processing: Detection Theory, section 4.4.
    """
    step = max(1, length // taps)
    taps = length // step
    pulse = raised_cosine((np.arange(taps) + 0.5) / taps)
    side = np.zeros(int(np.ceil(flank * len(pulse))))
    pulse = np.concatenate([side, pulse, side])
    lags = np.arange(len(pulse))
    smooth = covariance(lags * step / rate)
    # Without some noise the finest detail of the shape would decide where the process is very smooth.
    noise = covariance.noise / step + 1e-5 * (smooth[0] + covariance.noise) + 1e-12
    between = smooth[np.abs(lags[:, None] - lags)] + noise * np.eye(len(pulse))
    of_pulse, of_constant = np.linalg.solve(between, np.stack([pulse, np.ones(len(pulse))], axis=1)).T
    weights = of_pulse - of_constant * of_pulse.sum() / of_constant.sum()
    information = float(weights @ pulse)
    return MatchedFilter(weights / np.sqrt(information), step, 1 / np.sqrt(information))


def filter_response(signal: np.ndarray, matched: MatchedFilter) -> np.ndarray:
    """Apply a matched filter to all axes of a signal.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames, axes), NaN = missing.
    matched : MatchedFilter
        The filter.

    Returns
    -------
    np.ndarray
        Root of the summed squares of the axes' responses (frames,), in standard deviations of the noise; NaN where the
        window of the filter reaches across a gap or an end.
    """
    out = np.full(len(signal), np.nan)
    for start, stop in runs(~np.isnan(signal).any(axis=1)):
        means = (stop - start) // matched.step
        if means < len(matched.weights):
            continue
        run = signal[start : start + means * matched.step].reshape(means, matched.step, -1).mean(axis=1)
        square = sum((np.convolve(axis, matched.weights[::-1], "valid") ** 2 for axis in run.T), np.zeros(1))
        centre = start + (np.arange(len(square)) + len(matched.weights) / 2) * matched.step - 0.5
        frames = np.arange(int(np.ceil(centre[0])), int(centre[-1]) + 1)
        out[frames] = np.interp(frames, centre, np.sqrt(square))
    return out


def clipped_covariance(
    signal: np.ndarray, *, sigmas: float, rate: float, scales_s: np.ndarray, max_lag_s: float
) -> Covariance:
    """Fit the covariance function of a signal whose outliers are clipped.

    Parameters
    ----------
    signal : np.ndarray
        Signal (frames, axes), mm, NaN = missing.
    sigmas : float
        Deviations from the axes' medians are clipped to this many robust standard deviations.
    rate : float
        Sampling rate, Hz.
    scales_s : np.ndarray
        Correlation lengths (scales,) of the kernels, s.
    max_lag_s : float
        Longest lag that is fitted, s.

    Returns
    -------
    Covariance
        The covariance function.
    """
    middle = np.nanmedian(signal, axis=0)
    limit = sigmas * robust.mad_std((signal - middle).ravel())
    clipped = np.clip(signal - middle, -limit, limit)
    return fit_covariance(clipped, rate=rate, scales_s=scales_s, max_lag_s=max_lag_s)
