"""Matched filters on residual windows, window by window: generalised least squares with polynomials as nuisance."""

import numpy as np


def fit(window, pattern, covariance, *, free=()):
    """The amplitude of a pattern in a window (n,), its variance, and the sum of squares beside it.

    The pattern, polynomials, and any of the samples `free` explain the window; the rest has the covariance, whose middle
    sample has a conditional variance of 1.
    """
    size = len(window)
    noise = covariance.covariance[:size, :size]
    basis = np.linalg.svd(np.vander(np.linspace(-1, 1, size), covariance.order + 1))[0][:, covariance.order + 1 :]
    unit = np.linalg.inv(basis.T @ noise @ basis)
    unit = unit / (basis @ unit @ basis.T)[size // 2, size // 2]
    root = np.linalg.cholesky(unit).T @ basis.T  # whitens what no polynomial explains
    own, seen = root @ pattern, root @ window
    amplitude = own @ seen / (own @ own)
    nuisance = root @ (np.eye(size)[:, list(free)] if free else pattern[:, None])
    rest = seen - nuisance @ np.linalg.lstsq(nuisance, seen, rcond=None)[0]
    return amplitude, 1 / (own @ own), rest @ rest


def statistic(residual, positions, pattern, covariance, *, free=()):
    """How much of a pattern's amplitude (3,) the marker makes, its standard deviation, and the misfit, of windows (n, 3)."""
    fits = [fit(axis, pattern, covariance, free=free) for axis in residual.T]
    recorded = np.array([fit(axis, pattern, covariance)[0] for axis in positions.T])
    amplitude = np.array([own[0] for own in fits])
    length = np.sqrt((amplitude**2).sum())
    part = min(max((recorded * amplitude).sum() / length, 0), length)
    freedom = len(pattern) - covariance.order - 1 - (len(free) or 1)
    misfit = np.sqrt(sum(own[2] for own in fits) / (3 * freedom))
    return part, np.sqrt(fits[0][1]), misfit
