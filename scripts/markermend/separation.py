"""Separate where a marker was from the artifact on it: both are random courses, of which much is known.

Distorted samples still tell something. What was measured differs from what the neighbours predict by the error of the
prediction and by the artifact. The error goes together over time as the marker's residual does elsewhere, and is small
near both borders; the artifact has the course of its class. Both are taken as Gaussian, so that the likeliest
parting of the difference, and what remains unsure, are linear algebra.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.predictors.kriging import Covariance


def bridge(n: int) -> np.ndarray:
    """Covariance (n, n) of smooth courses that begin and end at zero: sines whose amplitudes fall with their order squared."""
    order = np.arange(1, n + 1)
    sines = np.sin(np.pi * np.outer(order, order) / (n + 1)) / order**2
    return sines @ sines.T


COURSES: Mapping[str, Callable[[int], np.ndarray]] = {
    "separate_noise": np.eye,
    "separate_step": lambda n: np.ones((n, n)),
    "separate_slow": bridge,
}
"""Covariance (n, n) of an artifact of amplitude 1 over its frames, by the method that takes it away."""


@dataclass(frozen=True)
class SeparationOptions:
    """What is believed of artifacts (config section `repair`, key `separation`).

    amplitudes_mm: amplitudes that are tried. roughness_mm: standard deviations of white noise besides, by which an
    artifact may depart from the course of its class; all are tried with all amplitudes. border_s: how far into the
    observed samples either border reaches. margins: by these shares of its length a slow change may begin earlier and
    end later than was found: nobody can tell that to the sample. most_frames: longer artifacts are not parted: memory
    grows with the square of the length, time with the cube.
    """

    amplitudes_mm: Sequence[float]
    roughness_mm: Sequence[float]
    border_s: float
    margins: Sequence[float]
    most_frames: int


def artifacts(method: str, n: int, options: SeparationOptions, extents: Sequence[tuple[int, int]]) -> np.ndarray:
    """Covariances (k, n, n), mm^2, of the artifacts that a method of COURSES deems equally likely among n frames.

    extents: half-open intervals of the n frames over which the artifact may last.
    """
    courses = np.zeros((len(extents), n, n))
    for course, (first, last) in zip(courses, extents, strict=True):
        course[first:last, first:last] = COURSES[method](last - first)
    rough = [r**2 * np.eye(n) for r in options.roughness_mm]
    return np.stack([a**2 * course + white for course in courses for a in options.amplitudes_mm for white in rough])


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


def separate(difference: np.ndarray, error: np.ndarray, tried: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Part a difference (n, axes), mm, into an error of prediction and an artifact; returns the error and its deviation.

    difference: NaN = not measured. error: covariance (n, n), mm^2, of the error. tried: covariances (k, n, n) of artifacts,
    equally likely before. Mean (n, axes) and standard deviation per axis (n,) of the error to expect, averaged over the
    artifacts by how likely each makes the difference; the deviation is wider where none of them makes it likely.
    """
    known = ~np.isnan(difference).any(axis=1)
    seen, across = difference[known], error[:, known]
    jitter = 1e-9 * np.trace(error) / len(error) * np.eye(len(seen))
    likely, misfit, means, variances = np.zeros(len(tried)), np.zeros(len(tried)), [], []
    for k, artifact in enumerate(tried):
        total = (error + artifact)[np.ix_(known, known)] + jitter
        solved = np.linalg.solve(total, np.concatenate([seen, across.T], axis=1))
        weighted, gain = solved[:, : seen.shape[1]], solved[:, seen.shape[1] :].T
        misfit[k] = (seen * weighted).sum()
        likely[k] = -0.5 * misfit[k] - seen.shape[1] / 2 * np.linalg.slogdet(total)[1]
        means.append(gain @ seen)
        variances.append(np.diag(error) - (gain * across).sum(axis=1))
    weights = np.exp(likely - likely.max())
    weights /= weights.sum()
    mean = np.tensordot(weights, means, 1)
    apart = ((np.stack(means) - mean) ** 2).mean(axis=2)
    variance = weights @ (np.stack(variances) + apart)
    # Where nothing that was tried explains the difference, it is known less well than it seems.
    wider = max(1.0, weights @ misfit / seen.size)
    return mean, np.sqrt(np.maximum(wider * variance, 1e-12))
