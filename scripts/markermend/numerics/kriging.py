"""Kriging: carry the residual of a regression across a gap by its own autocovariance (simple kriging in time)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

NEAR_PAIRS = 20
"""So many pairs of frames at each of the shortest lags tell the white noise."""


def autocovariance(residual: np.ndarray, lags: np.ndarray) -> np.ndarray:
    """Empirical autocovariance (k,) of a residual (frames, axes) about zero at lags (k,), frames, averaged over the axes.

    NaN = missing: pairs with a missing end do not count; NaN at a lag without any pair.
    """
    known = np.flatnonzero(~np.isnan(residual).any(axis=1))
    values = residual[known]
    place = np.full(len(residual) + lags.max(), -1)
    place[known] = np.arange(len(known))
    partner = place[known[:, None] + lags]
    products = np.einsum("na,nka->nk", values, values[partner])
    pairs = np.count_nonzero(partner >= 0, axis=0)
    total = np.where(partner >= 0, products, 0.0).sum(axis=0)
    return np.where(pairs > 0, total / np.maximum(pairs, 1) / residual.shape[1], np.nan)


def white_noise_variance(residual: np.ndarray) -> float:
    """Variance of the white noise on a residual (frames, axes), squared unit; NaN = missing.

    Of half the mean squared differences at one, two and three frames, what remains when the parts that grow with the
    second and the fourth power of the lag, those of a smooth course, cancel; from medians, so that artifacts do not
    count. Zero where too few frames lie that near.
    """
    halves = []
    for lag in (1, 2, 3):
        apart = residual[lag:] - residual[:-lag]
        apart = np.abs(apart[~np.isnan(apart).any(axis=1)])
        if len(apart) < NEAR_PAIRS:
            return 0.0
        halves.append((np.median(apart) / 0.6745) ** 2 / 2)
    return max(0.0, float(15 * halves[0] - 6 * halves[1] + halves[2]) / 10)


@dataclass(frozen=True)
class Covariance:
    """A covariance function of time: white noise plus a non-negative sum of Matern kernels of order 3/2 and 5/2.

    weights: (1 + 2 * scales,), mm^2: noise, order 3/2, order 5/2. scales_s: correlation lengths in s.
    """

    weights: np.ndarray
    scales_s: np.ndarray

    def __call__(self, lag_s: np.ndarray) -> np.ndarray:
        """Covariance, mm^2, at lags in s, without the white noise."""
        return kernels(lag_s, self.scales_s) @ self.weights[1:]

    @property
    def noise(self) -> float:
        """Variance of the white noise, mm^2."""
        return float(self.weights[0])


def kernels(lag_s: np.ndarray, scales_s: np.ndarray) -> np.ndarray:
    """Unit Matern kernels (..., 2 * scales) at lags in s: first order 3/2, then 5/2.

    No RBF kernel: its paths are so smooth that a small misfit at the border extrapolates to metres.
    """
    scaled = np.abs(lag_s)[..., None] / scales_s
    once, twice = np.sqrt(3) * scaled, np.sqrt(5) * scaled
    return np.concatenate([(1 + once) * np.exp(-once), (1 + twice + twice**2 / 3) * np.exp(-twice)], axis=-1)


def fit_covariance(residual: np.ndarray, *, rate: float, scales_s: np.ndarray, max_lag_s: float) -> Covariance:
    """Fit a covariance function to a residual's autocovariance by non-negative least squares.

    residual: (frames, axes), mm, NaN = missing. rate: Hz. max_lag_s: lags beyond it are not looked at.
    """
    from scipy.optimize import nnls  # 0.2 s to import, and most detectors never get here

    lags = int(np.clip(round(max_lag_s * rate), 2, max(2, len(residual) // 2)))
    # Lags are thinned towards the long ones, so that the short ones, which matter at the borders, are not outvoted.
    chosen = np.unique(np.round(np.geomspace(1, lags, 40)).astype(int) - 1)
    empirical = autocovariance(residual, chosen)
    chosen, empirical = chosen[~np.isnan(empirical)], empirical[~np.isnan(empirical)]
    if len(chosen) == 0:
        return Covariance(np.append(1e-12, np.zeros(2 * len(scales_s))), scales_s)
    lag_s = chosen / rate
    design = np.concatenate([(chosen == 0)[:, None].astype(float), kernels(lag_s, scales_s)], axis=1)
    weights, _ = nnls(design, empirical)
    if weights.sum() <= 0:
        weights[0] = max(empirical[0], 1e-12)
    # Next to the variance of the whole the noise is too small for the fit to see. Taken for noiseless, a residual is
    # carried on along the slope that its last samples happen to have.
    weights[0] = max(weights[0], white_noise_variance(residual))
    return Covariance(weights, scales_s)


def krige(
    covariance: Covariance, *, observed_s: np.ndarray, values: np.ndarray, target_s: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Mean (n, axes) and variance (n,) of a zero-mean process at `target_s`, given `values` (k, axes) at `observed_s`.

    The mean is that of the smooth part; the variance adds the white noise, because a true sample has it too.
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
