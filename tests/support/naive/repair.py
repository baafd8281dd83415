"""Naive twins of markermend.repair: joint normal distributions, conditioned by dense inverses."""

import numpy as np
from scipy.stats import multivariate_normal


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
