"""Simple kriging in time: carry the residual of a regression across a gap by its own autocovariance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.numerics.non_negative import non_negative_least_squares

MIN_PAIRS = 20
"""Least number of pairs of frames at each of the shortest lags from which the white noise is estimated."""

DENSE_SHARE = 0.25
"""Share of known frames from which on pairs of all frames are multiplied, those with a missing sample by 0."""

FITTED_LAGS = 40
"""Number of lags at which the autocovariance is fitted, before duplicates are dropped."""


def autocovariance(residual: np.ndarray, lags: np.ndarray) -> np.ndarray:
    """Compute the empirical autocovariance of a residual about zero, averaged over its axes.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, axes), NaN = missing: pairs with a missing sample do not count.
    lags : np.ndarray
        Lags (k,), frames.

    Returns
    -------
    np.ndarray
        Autocovariance (k,), squared unit of the residual; NaN at a lag without any pair.
    """
    known = np.flatnonzero(~np.isnan(residual).any(axis=1))
    values = residual[known]
    if len(known) >= DENSE_SHARE * len(residual):
        return _dense_autocovariance(residual, known, lags)
    index = np.full(len(residual) + lags.max(), -1)
    index[known] = np.arange(len(known))
    partner = index[known[:, None] + lags]
    products = np.einsum("na,nka->nk", values, values[partner])
    pairs = np.count_nonzero(partner >= 0, axis=0)
    total = np.where(partner >= 0, products, 0.0).sum(axis=0)
    return np.where(pairs > 0, total / np.maximum(pairs, 1) / residual.shape[1], np.nan)


def _dense_autocovariance(residual: np.ndarray, known: np.ndarray, lags: np.ndarray) -> np.ndarray:
    """The autocovariance (k,) of a residual that is known in most frames: products of whole columns, with zeros where it is missing."""
    frames, axes = residual.shape
    values, seen = np.zeros((frames, axes)), np.zeros(frames)
    values[known], seen[known] = residual[known], 1.0
    flat = values.reshape(-1)
    total = np.array(
        [flat[: axes * (frames - lag)] @ flat[axes * lag :] if lag < frames else 0.0 for lag in lags.tolist()]
    )
    pairs = np.array([seen[: frames - lag] @ seen[lag:] if lag < frames else 0.0 for lag in lags.tolist()])
    return np.where(pairs > 0, total / np.maximum(pairs, 1) / axes, np.nan)


def white_noise_variance(residual: np.ndarray) -> float:
    """Estimate the variance of the white noise on a smooth residual.

    The semivariogram of noise on a smooth signal is ``noise + a lag^2 + b lag^4`` at short lags. Its values at lags
    of one, two and three frames are combined such that the terms of the signal cancel. They are computed from medians,
    so artifacts hardly count.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, axes), NaN = missing.

    Returns
    -------
    float
        Variance, squared unit of the residual; 0 where fewer than MIN_PAIRS pairs of frames have one of these lags.
    """
    semivariances = []
    for lag in (1, 2, 3):
        change = residual[lag:] - residual[:-lag]
        change = np.abs(change[~np.isnan(change).any(axis=1)])
        if len(change) < MIN_PAIRS:
            return 0.0
        semivariances.append((np.median(change) / 0.6745) ** 2 / 2)
    return max(0.0, float(15 * semivariances[0] - 6 * semivariances[1] + semivariances[2]) / 10)


@dataclass(frozen=True)
class Covariance:
    """A covariance function of time: white noise plus a non-negative sum of Matern kernels of order 3/2 and 5/2.

    Attributes
    ----------
    weights : np.ndarray
        Variances (1 + 2 * scales,), mm^2: of the noise, of the kernels of order 3/2, of those of order 5/2.
    scales_s : np.ndarray
        Correlation lengths (scales,), s.
    """

    weights: np.ndarray
    scales_s: np.ndarray

    def __call__(self, lag_s: np.ndarray) -> np.ndarray:
        """Evaluate the covariance of the smooth part, without the white noise.

        Parameters
        ----------
        lag_s : np.ndarray
            Lags of any shape, s.

        Returns
        -------
        np.ndarray
            Covariance of the same shape, mm^2.
        """
        covariance: np.ndarray = kernels(lag_s, self.scales_s) @ self.weights[1:]
        return covariance

    @property
    def noise(self) -> float:
        """Variance of the white noise, mm^2."""
        return float(self.weights[0])


def kernels(lag_s: np.ndarray, scales_s: np.ndarray) -> np.ndarray:
    """Evaluate Matern kernels of unit variance.

    The squared exponential kernel is left out: its paths are so smooth that a small misfit at the border of a gap
    extrapolates to metres.

    Parameters
    ----------
    lag_s : np.ndarray
        Lags of any shape, s.
    scales_s : np.ndarray
        Correlation lengths (scales,), s.

    Returns
    -------
    np.ndarray
        Kernels (..., 2 * scales): those of order 3/2, then those of order 5/2.

    References
    ----------
    Rasmussen & Williams (2006), Gaussian Processes for Machine Learning, eq 4.17.
    """
    scaled = np.abs(lag_s)[..., None] / scales_s
    order5 = np.sqrt(5) * scaled
    return np.concatenate([matern_3_2(scaled), (1 + order5 + order5**2 / 3) * np.exp(-order5)], axis=-1)


def matern_3_2(distance: np.ndarray) -> np.ndarray:
    """Evaluate the Matern kernel of order 3/2 and unit variance.

    Parameters
    ----------
    distance : np.ndarray
        Distances of any shape, in correlation lengths, not negative.

    Returns
    -------
    np.ndarray
        Covariance of the same shape.

    References
    ----------
    Rasmussen & Williams (2006), Gaussian Processes for Machine Learning, eq 4.17.
    """
    scaled = np.sqrt(3) * distance
    covariance: np.ndarray = (1 + scaled) * np.exp(-scaled)
    return covariance


def fit_covariance(residual: np.ndarray, *, rate: float, scales_s: np.ndarray, max_lag_s: float) -> Covariance:
    """Fit a covariance function to the autocovariance of a residual by non-negative least squares.

    Parameters
    ----------
    residual : np.ndarray
        Residual (frames, axes), mm, NaN = missing.
    rate : float
        Sampling rate, Hz.
    scales_s : np.ndarray
        Correlation lengths (scales,) of the kernels, s.
    max_lag_s : float
        Longest lag that is fitted, s.

    Returns
    -------
    Covariance
        The covariance function; a minimal white noise alone where no sample is known.
    """
    max_lag = int(np.clip(round(max_lag_s * rate), 2, max(2, len(residual) // 2)))
    # Fewer of the long lags are fitted: the short ones, which matter at the borders, must not be outvoted.
    lags = np.unique(np.round(np.geomspace(1, max_lag, FITTED_LAGS)).astype(int) - 1)
    empirical = autocovariance(residual, lags)
    lags, empirical = lags[~np.isnan(empirical)], empirical[~np.isnan(empirical)]
    if len(lags) == 0:
        return Covariance(np.append(1e-12, np.zeros(2 * len(scales_s))), scales_s)
    lag_s = lags / rate
    design = np.concatenate([(lags == 0)[:, None].astype(float), kernels(lag_s, scales_s)], axis=1)
    weights = non_negative_least_squares(design, empirical)
    if weights.sum() <= 0:
        weights[0] = max(empirical[0], 1e-12)
    # Noise that is small compared with the total variance escapes the fit. A residual taken for noiseless would be
    # extrapolated along the slope that its last samples happen to have.
    weights[0] = max(weights[0], white_noise_variance(residual))
    return Covariance(weights, scales_s)


def krige(
    covariance: Covariance, *, observed_s: np.ndarray, values: np.ndarray, target_s: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Predict a zero-mean process by simple kriging (Gaussian process regression).

    Parameters
    ----------
    covariance : Covariance
        Covariance function of the process.
    observed_s : np.ndarray
        Times of the observations (k,), s.
    values : np.ndarray
        Observations (k, axes), mm, without NaN.
    target_s : np.ndarray
        Times to predict (n,), s.

    Returns
    -------
    mean : np.ndarray
        Conditional mean (n, axes) of the smooth part, mm.
    variance : np.ndarray
        Conditional variance (n,), mm^2, including the white noise, which a true sample has too.

    References
    ----------
    Rasmussen & Williams (2006), Gaussian Processes for Machine Learning, eq 2.25, 2.26.
    """
    total = covariance(np.zeros(1))[0] + covariance.noise
    if len(observed_s) == 0:
        return np.zeros((len(target_s), values.shape[1])), np.full(len(target_s), total)
    # The fitted covariance is never exact: without some noise a near-singular system would amplify its misfit.
    jitter = 1e-5 * total + 1e-12
    between = covariance(observed_s[:, None] - observed_s[None]) + np.eye(len(observed_s)) * (covariance.noise + jitter)
    across = covariance(target_s[:, None] - observed_s[None])
    gain = np.linalg.solve(between, across.T).T
    variance = total - np.einsum("nk,nk->n", gain, across)
    return gain @ values, np.maximum(variance, covariance.noise)
