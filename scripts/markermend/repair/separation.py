r"""Separation of the trajectory of a marker from the artifact on it, by Gaussian processes.

Distorted samples still hold information. The difference between what was measured and what the neighbours predict is the
sum of the error of the prediction and of the artifact. The error is correlated over time as the marker's residual is
elsewhere, and is known at both borders; the artifact has the shape of its class. Both are taken as Gaussian: with the
covariances :math:`E` of the error and :math:`A` of the artifact the expected error given the difference :math:`d` is
:math:`E (E + A)^{-1} d`, and its covariance is :math:`E - E (E + A)^{-1} E`. The covariance of the artifact is not known, so
several are tried, and the results are averaged by their likelihoods. Several predictions are separated each by itself and
then averaged, because the mean of predictions that err independently errs less.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.numerics.kriging import Covariance
from markermend.options.repair import SeparationOptions


def bridge_covariance(n: int) -> np.ndarray:
    """Give the covariance of smooth shapes that begin and end at zero.

    Parameters
    ----------
    n : int
        Number of frames.

    Returns
    -------
    ndarray of float, shape (n, n)
        The covariance of a sum of sines whose amplitudes fall with the square of their order.
    """
    order = np.arange(1, n + 1)
    sines = np.sin(np.pi * np.outer(order, order) / (n + 1)) / order**2
    return sines @ sines.T


def tent_covariance(n: int) -> np.ndarray:
    """Give the covariance of a shape that rises linearly to its middle and falls likewise.

    Parameters
    ----------
    n : int
        Number of frames.

    Returns
    -------
    ndarray of float, shape (n, n)
        The covariance of that shape with an amplitude of variance 1.

    References
    ----------
    skurowski2022, section 4.1.3: the published shape of slow changes.
    """
    shape = 1 - np.abs(2 * (np.arange(n) + 0.5) / n - 1)
    return np.outer(shape, shape)


def plateau_covariance(n: int, *, ramp: int) -> np.ndarray:
    """Give the covariance of a constant shape that begins and ends with a ramp.

    Parameters
    ----------
    n : int
        Number of frames.
    ramp : int
        Frames on the way at either end.

    Returns
    -------
    ndarray of float, shape (n, n)
        The covariance of that shape with an amplitude of variance 1.
    """
    at = np.arange(1, n + 1)
    shape = np.minimum(np.minimum(at, at[::-1]) / (ramp + 1), 1)
    return np.outer(shape, shape)


SHAPE_COVARIANCES: Mapping[str, Callable[[SeparationOptions], Sequence[Callable[[int], np.ndarray]]]] = {
    "separate_noise": lambda options: [np.eye],
    "separate_step": lambda options: [partial(plateau_covariance, ramp=ramp) for ramp in options.step_ramps_frames],
    "separate_slow": lambda options: [bridge_covariance, tent_covariance],
}
"""Covariances (n, n) of artifacts of amplitude 1 over n frames, by the method that removes such artifacts."""


def oscillation_covariance(n: int, *, frequency_hz: float, coherence_s: float, rate: float) -> np.ndarray:
    """Give the covariance of an oscillation whose amplitude and phase change over time.

    Parameters
    ----------
    n : int
        Number of frames.
    frequency_hz : float
        Its frequency.
    coherence_s : float
        Time over which amplitude and phase stay alike.
    rate : float
        Sampling rate, Hz.

    Returns
    -------
    ndarray of float, shape (n, n)
        The covariance of that process with variance 1.
    """
    lag_s = np.subtract.outer(np.arange(n), np.arange(n)) / rate
    return np.cos(2 * np.pi * frequency_hz * lag_s) * np.exp(-((lag_s / coherence_s) ** 2) / 2)


def artifact_covariances(
    method: str, n: int, options: SeparationOptions, extents: Sequence[tuple[int, int]], *, rate: float
) -> Iterator[np.ndarray]:
    """Give the covariances of the artifacts that are tried; all are equally likely a priori.

    Parameters
    ----------
    method : str
        A key of SHAPE_COVARIANCES.
    n : int
        Number of frames.
    options : SeparationOptions
        Amplitudes and roughness of artifacts.
    extents : sequence of tuple of int
        Half-open intervals of the n frames over which the artifact may last.
    rate : float
        Sampling rate, Hz.

    Yields
    ------
    ndarray of float, shape (n, n)
        A covariance, mm^2.
    """
    for shape, (first, last) in itertools.product(SHAPE_COVARIANCES[method](options), extents):
        covariance = np.zeros((n, n))
        covariance[first:last, first:last] = shape(last - first)
        for amplitude, roughness in itertools.product(options.amplitudes_mm, options.roughness_mm):
            yield amplitude**2 * covariance + roughness**2 * np.eye(n)
    if method == "separate_noise":
        for frequency in options.oscillations_hz:
            coherence = options.oscillation_coherence_s
            shaken = oscillation_covariance(n, frequency_hz=frequency, coherence_s=coherence, rate=rate)
            yield options.oscillation_mm**2 * shaken + min(options.roughness_mm) ** 2 * np.eye(n)


def conditional_correlation(covariance: Covariance, *, known_s: np.ndarray, wanted_s: np.ndarray) -> np.ndarray:
    """Give the correlation of a process that is known at some times.

    Parameters
    ----------
    covariance : Covariance
        The covariance of the process over time; its white noise is not known at any time.
    known_s : ndarray of float, shape (k,)
        Times at which the process is known, s.
    wanted_s : ndarray of float, shape (n,)
        Times for which the correlation is wanted, s.

    Returns
    -------
    ndarray of float, shape (n, n)
        The correlation given the known values.
    """
    total = covariance(np.zeros(1))[0] + covariance.noise
    within = covariance(wanted_s[:, None] - wanted_s) + covariance.noise * np.eye(len(wanted_s))
    # As in kriging: the fitted covariance is never exact.
    between = covariance(known_s[:, None] - known_s) + (covariance.noise + 1e-5 * total) * np.eye(len(known_s))
    across = covariance(wanted_s[:, None] - known_s)
    within -= across @ np.linalg.solve(between, across.T)
    deviation = np.sqrt(np.maximum(np.diag(within), 1e-9 * total))
    correlation: np.ndarray = within / deviation / deviation[:, None]
    return correlation


@dataclass(frozen=True)
class Separation:
    """The error of a prediction, separated from an artifact.

    Attributes
    ----------
    mean : ndarray of float, shape (n, axes)
        The expected error, mm.
    variance : ndarray of float, shape (n,)
        Its variance per axis, mm^2.
    log_likelihood : float
        The logarithm of the mean likelihood of the difference under the artifacts that were tried, but for a constant.
    """

    mean: np.ndarray
    variance: np.ndarray
    log_likelihood: float


def separate(
    difference: np.ndarray, error: np.ndarray, artifacts: Iterable[np.ndarray], *, likelihood_power: float
) -> Separation:
    """Separate the error of a prediction from an artifact.

    Parameters
    ----------
    difference : ndarray of float, shape (n, axes)
        What was measured less what was predicted, mm; NaN = not measured.
    error : ndarray of float, shape (n, n)
        The covariance of the error, mm^2, the same on each axis.
    artifacts : iterable of ndarray
        The covariances (n, n) of artifacts that are tried, mm^2, equally likely a priori.
    likelihood_power : float
        The power to which likelihoods count, see `SeparationOptions`.

    Returns
    -------
    Separation
        The error averaged over the artifacts by their likelihoods. The variance is larger where none of them explains the
        difference.
    """
    known = ~np.isnan(difference).any(axis=1)
    measured, across = difference[known], error[:, known]
    jitter = 1e-9 * np.trace(error) / len(error) * np.eye(len(measured))
    log_likelihoods, misfits, means, variances = [], [], [], []
    for artifact in artifacts:
        total = (error + artifact)[np.ix_(known, known)] + jitter
        solved = np.linalg.solve(total, np.concatenate([measured, across.T], axis=1))
        whitened, gain = solved[:, : measured.shape[1]], solved[:, measured.shape[1] :].T
        misfits.append((measured * whitened).sum() / measured.size)
        log_determinant = np.linalg.slogdet(total)[1]
        log_likelihoods.append(-0.5 * measured.size * misfits[-1] - measured.shape[1] / 2 * log_determinant)
        means.append(gain @ measured)
        variances.append(np.diag(error) - (gain * across).sum(axis=1))
    weights, log_likelihood = _weights(likelihood_power * np.array(log_likelihoods))
    mean = np.tensordot(weights, means, 1)
    spread = ((np.stack(means) - mean) ** 2).mean(axis=2)
    # Where no artifact that was tried explains the difference, the error is known less well than it seems.
    factor = max(1.0, weights @ misfits)
    variance = np.maximum(factor * (weights @ (np.stack(variances) + spread)), 1e-12)
    return Separation(mean, variance, log_likelihood)


def average_by_likelihood(
    trajectories: Sequence[np.ndarray], separations: Sequence[Separation]
) -> tuple[np.ndarray, np.ndarray]:
    """Average several trajectories by the likelihoods of their separations.

    Parameters
    ----------
    trajectories : sequence of ndarray
        Trajectories (n, axes), mm: each a prediction plus its expected error.
    separations : sequence of Separation
        The separation that each comes from.

    Returns
    -------
    mean : ndarray of float, shape (n, axes)
        Their mean, mm.
    deviation : ndarray of float, shape (n,)
        Its standard deviation per axis, mm. The squared error of the mean is less than the mean of the squared errors,
        by as much as the trajectories are spread; since their errors are partly shared, it is never reduced by more
        than half.

    References
    ----------
    Krogh and Vedelsby 1995: the decomposition of the error of an ensemble.
    """
    weights, _ = _weights(np.array([separation.log_likelihood for separation in separations]))
    mean = np.tensordot(weights, trajectories, 1)
    spread = weights @ ((np.stack(trajectories) - mean) ** 2).mean(axis=2)
    variance = weights @ np.stack([separation.variance for separation in separations])
    return mean, np.sqrt(variance**2 / (variance + np.minimum(spread, variance)))


def _weights(log_likelihoods: np.ndarray) -> tuple[np.ndarray, float]:
    """Weights of sum 1 from logarithms of likelihoods (k,), and the logarithm of the mean likelihood."""
    likelihoods = np.exp(log_likelihoods - log_likelihoods.max())
    return likelihoods / likelihoods.sum(), float(log_likelihoods.max() + np.log(likelihoods.mean()))
