"""Bumps in a residual: how clearly does one that rises and falls stand out from a process of known covariance?

A matched filter (generalised least squares in time): of all weights on the samples about a moment that do not answer to
a constant, those that find a bump of given length with the least variance. `strength` is in standard deviations.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics import robust
from markermend.numerics.intervals import runs
from markermend.numerics.kriging import Covariance, fit_covariance


@dataclass(frozen=True)
class MatchedFilter:
    """Weights (taps,) on means over `step` samples each, which answer to noise with variance 1.

    deviation: standard deviation of the height of the bump that they find.
    """

    weights: np.ndarray
    step: int
    deviation: float


def raised_cosine(at: np.ndarray) -> np.ndarray:
    """Course of a bump of height 1 from 0 to 1: at rest at either end, and 0 beyond."""
    return 0.5 - 0.5 * np.cos(2 * np.pi * np.clip(at, 0.0, 1.0))


def design_filter(covariance: Covariance, *, length: int, flank: float, taps: int, rate: float) -> MatchedFilter:
    """The filter for bumps of a length in samples; `flank` of the length is looked at on either side.

    taps: over the bump, at most about so many means are looked at.
    """
    step = max(1, length // taps)
    taps = length // step
    bump = raised_cosine((np.arange(taps) + 0.5) / taps)
    side = np.zeros(int(np.ceil(flank * len(bump))))
    bump = np.concatenate([side, bump, side])
    lags = np.arange(len(bump))
    smooth = covariance(lags * step / rate)
    # Without some noise a process that is very smooth would let the finest detail of the shape decide.
    noise = covariance.noise / step + 1e-5 * (smooth[0] + covariance.noise) + 1e-12
    between = smooth[np.abs(lags[:, None] - lags)] + noise * np.eye(len(bump))
    for_bump, for_constant = np.linalg.solve(between, np.stack([bump, np.ones(len(bump))], axis=1)).T
    weights = for_bump - for_constant * for_bump.sum() / for_constant.sum()
    information = float(weights @ bump)
    return MatchedFilter(weights / np.sqrt(information), step, 1 / np.sqrt(information))


def filter_response(signal: np.ndarray, bump: MatchedFilter) -> np.ndarray:
    """Answer (frames,) of a filter to a signal (frames, axes), all axes together; NaN where its window is not whole.

    NaN = missing: nothing is found across a gap.
    """
    out = np.full(len(signal), np.nan)
    for start, stop in runs(~np.isnan(signal).any(axis=1)):
        means = (stop - start) // bump.step
        if means < len(bump.weights):
            continue
        run = signal[start : start + means * bump.step].reshape(means, bump.step, -1).mean(axis=1)
        answer = sum((np.convolve(axis, bump.weights[::-1], "valid") ** 2 for axis in run.T), np.zeros(1))
        centre = start + (np.arange(len(answer)) + len(bump.weights) / 2) * bump.step - 0.5
        at = np.arange(int(np.ceil(centre[0])), int(centre[-1]) + 1)
        out[at] = np.interp(at, centre, np.sqrt(answer))
    return out


def clipped_covariance(
    signal: np.ndarray, *, sigmas: float, rate: float, scales_s: np.ndarray, max_lag_s: float
) -> Covariance:
    """Covariance in time of a signal (frames, axes) but for what is unusual: it is cut off at so many robust sigmas."""
    middle = np.nanmedian(signal, axis=0)
    limit = sigmas * robust.mad_std((signal - middle).ravel())
    usual = np.clip(signal - middle, -limit, limit)
    return fit_covariance(usual, rate=rate, scales_s=scales_s, max_lag_s=max_lag_s)
