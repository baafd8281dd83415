"""Separate where a marker was from the artifact on it: both are random courses, of which much is known.

Distorted samples still tell something. What was measured differs from what the neighbours predict by the error of the
prediction and by the artifact. The error goes together over time as the marker's residual does elsewhere, and is small
near both borders; the artifact has the course of its class. Both are taken as Gaussian, so that the likeliest
parting of the difference, and what remains unsure, are linear algebra. Several predictions are parted each by itself and
then averaged: where they err each in its own way, their mean errs less.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.numerics.kriging import Covariance
from markermend.options.repair import SeparationOptions


def bridge(n: int) -> np.ndarray:
    """Covariance (n, n) of smooth courses that begin and end at zero: sines whose amplitudes fall with their order squared."""
    order = np.arange(1, n + 1)
    sines = np.sin(np.pi * np.outer(order, order) / (n + 1)) / order**2
    return sines @ sines.T


def tent(n: int) -> np.ndarray:
    """Covariance (n, n) of a course that rises evenly to its middle and falls likewise (skurowski2022, section 4.1.3)."""
    course = 1 - np.abs(2 * (np.arange(n) + 0.5) / n - 1)
    return np.outer(course, course)


COURSES: Mapping[str, Sequence[Callable[[int], np.ndarray]]] = {
    "separate_noise": [np.eye],
    "separate_step": [lambda n: np.ones((n, n))],
    "separate_slow": [bridge, tent],
}
"""Covariances (n, n) that an artifact of amplitude 1 may have over its frames, by the method that takes it away."""


def artifacts(
    method: str, n: int, options: SeparationOptions, extents: Sequence[tuple[int, int]]
) -> Iterator[np.ndarray]:
    """Covariances (n, n), mm^2, of the artifacts that a method of COURSES deems equally likely among n frames.

    extents: half-open intervals of the n frames over which the artifact may last.
    """
    for course, (first, last) in itertools.product(COURSES[method], extents):
        covariance = np.zeros((n, n))
        covariance[first:last, first:last] = course(last - first)
        for amplitude, rough in itertools.product(options.amplitudes_mm, options.roughness_mm):
            yield amplitude**2 * covariance + rough**2 * np.eye(n)


def pinned(covariance: Covariance, *, known_s: np.ndarray, wanted_s: np.ndarray) -> np.ndarray:
    """Correlation (n, n) of a process at `wanted_s` that is known at `known_s`, s; its white noise is not known anywhere."""
    total = covariance(np.zeros(1))[0] + covariance.noise
    within = covariance(wanted_s[:, None] - wanted_s) + covariance.noise * np.eye(len(wanted_s))
    # As in kriging: the fitted covariance is never exact.
    between = covariance(known_s[:, None] - known_s) + (covariance.noise + 1e-5 * total) * np.eye(len(known_s))
    across = covariance(wanted_s[:, None] - known_s)
    within -= across @ np.linalg.solve(between, across.T)
    deviation = np.sqrt(np.maximum(np.diag(within), 1e-9 * total))
    return within / deviation / deviation[:, None]


@dataclass(frozen=True)
class Parted:
    """An error of prediction told from an artifact: expected error (n, axes), mm; its variance per axis (n,), mm^2; and the
    logarithm of how likely the difference was.
    """

    mean: np.ndarray
    variance: np.ndarray
    evidence: float


def separate(difference: np.ndarray, error: np.ndarray, tried: Iterable[np.ndarray], *, trust: float) -> Parted:
    """Part a difference (n, axes), mm, into an error of prediction and an artifact.

    difference: NaN = not measured. error: covariance (n, n), mm^2, of the error. tried: covariances (n, n) of artifacts,
    equally likely before; the error is averaged over them by how likely each makes the difference. trust: see
    SeparationOptions. The variance is wider where none of them makes it likely.
    """
    known = ~np.isnan(difference).any(axis=1)
    seen, across = difference[known], error[:, known]
    jitter = 1e-9 * np.trace(error) / len(error) * np.eye(len(seen))
    likely, misfit, means, variances = [], [], [], []
    for artifact in tried:
        total = (error + artifact)[np.ix_(known, known)] + jitter
        solved = np.linalg.solve(total, np.concatenate([seen, across.T], axis=1))
        weighted, gain = solved[:, : seen.shape[1]], solved[:, seen.shape[1] :].T
        misfit.append((seen * weighted).sum() / seen.size)
        likely.append(-0.5 * seen.size * misfit[-1] - seen.shape[1] / 2 * np.linalg.slogdet(total)[1])
        means.append(gain @ seen)
        variances.append(np.diag(error) - (gain * across).sum(axis=1))
    weights, evidence = _weights(trust * np.array(likely))
    mean = np.tensordot(weights, means, 1)
    apart = ((np.stack(means) - mean) ** 2).mean(axis=2)
    # Where nothing that was tried explains the difference, it is known less well than it seems.
    wider = max(1.0, weights @ misfit)
    return Parted(mean, np.maximum(wider * (weights @ (np.stack(variances) + apart)), 1e-12), evidence)


def averaged(courses: Sequence[np.ndarray], parts: Sequence[Parted]) -> tuple[np.ndarray, np.ndarray]:
    """Mean (n, axes), mm, of several courses by the evidence for each, and its standard deviation per axis (n,), mm.

    courses: (n, axes), mm, each a prediction and the expected error of `parts` on it. By as much as they differ the
    squared error of their mean is less than the mean of theirs (Krogh & Vedelsby 1995), if they state theirs truly;
    since they err alike in part, it is never taken for less than half of it.
    """
    weights, _ = _weights(np.array([part.evidence for part in parts]))
    mean = np.tensordot(weights, courses, 1)
    apart = weights @ ((np.stack(courses) - mean) ** 2).mean(axis=2)
    variance = weights @ np.stack([part.variance for part in parts])
    return mean, np.sqrt(variance**2 / (variance + np.minimum(apart, variance)))


def _weights(evidence: np.ndarray) -> tuple[np.ndarray, float]:
    """Weights of sum 1 from logarithms of likelihoods (k,), and the logarithm of the mean likelihood."""
    likely = np.exp(evidence - evidence.max())
    return likely / likely.sum(), float(evidence.max() + np.log(likely.mean()))
