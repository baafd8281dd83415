"""Naive twins of markermend.repair: joint normal distributions, conditioned by dense inverses."""

import numpy as np
from scipy.stats import multivariate_normal, t

from markermend.numerics.kriging import fit_covariance


def conditional_covariance(joint, n):
    """The covariance of the first n variables of a joint normal distribution given the others, by its precision."""
    return np.linalg.inv(np.linalg.inv(joint)[:n, :n])


def separate(difference, error, artifacts, likelihood_power):
    """Bayes' rule: condition on the difference under each artifact in turn, then average by the likelihoods.

    Returns the mean (n, axes) and the standard deviation (n,) of the error, and the logarithm of the mean likelihood.
    """
    rows = np.flatnonzero(~np.isnan(difference).any(axis=1))
    measured = difference[rows]
    log_likelihoods, means, second_moments, misfits = [], [], [], []
    for artifact in artifacts:
        total = (error + artifact)[np.ix_(rows, rows)]
        log_likelihoods.append(multivariate_normal(np.zeros(len(rows)), total).logpdf(measured.T).sum())
        gain = error[:, rows] @ np.linalg.inv(total)
        means.append(gain @ measured)
        second_moments.append(np.diag(error - gain @ error[rows])[:, None] + means[-1] ** 2)
        misfits.append(np.trace(measured.T @ np.linalg.solve(total, measured)) / measured.size)
    largest = max(log_likelihoods)
    likelihoods = np.exp(likelihood_power * (np.array(log_likelihoods) - largest))
    weights = likelihoods / likelihoods.sum()
    mean = np.tensordot(weights, means, 1)
    variance = (np.tensordot(weights, second_moments, 1) - mean**2).mean(axis=1)
    return (
        mean,
        np.sqrt(max(1.0, weights @ misfits) * variance),
        np.log(likelihoods.mean()) + likelihood_power * largest,
    )


def expected_distance(estimator, marker, mate, start, stop):
    """Mean and deviation (n,) of a distance by Bayes' rule, given the border samples and the usual distance."""
    scene, kriging = estimator.scene, estimator.kriging
    usual = scene.shape.distance[marker, mate]
    length = np.linalg.norm(scene.positions[:, marker] - scene.positions[:, mate], axis=1)
    covariance = fit_covariance(
        (length - usual)[:, None],
        rate=scene.rate,
        scales_s=np.array(kriging.correlation_times_s),
        max_lag_s=kriging.max_lag_s,
    )
    lags = sorted({round(lag) for lag in np.geomspace(1, max(2, kriging.border_s * scene.rate), 6)})
    border = [frame for lag in lags for frame in (start - lag, stop - 1 + lag)]
    border = [frame for frame in border if 0 <= frame < len(length) and not np.isnan(length[frame])]
    frames = np.array([*range(start, stop), *border]) / scene.rate
    joint = covariance(frames[:, None] - frames) + (covariance.noise + 1e-12) * np.eye(len(frames))
    n = stop - start
    total = joint[0, 0] - 1e-12
    known = joint[n:, n:] + 1e-5 * total * np.eye(len(border))
    gain = joint[:n, n:] @ np.linalg.inv(known)
    variance = np.diag(joint[:n, :n] - gain @ joint[n:, :n])
    deviation = np.sqrt(variance + estimator.options.min_deviation_mm**2)
    return usual + gain @ (length[border] - usual), deviation


def log_density(misfit, degrees_of_freedom):
    """Log density of Student's t relative to its mode."""
    return t.logpdf(misfit, degrees_of_freedom) - t.logpdf(0, degrees_of_freedom)
