"""Mean and weights of a mixture, against the published formulas frame by frame."""

import numpy as np
import pytest
from scipy.stats import gaussian_kde

from markermend.filling.distance_likelihood import pma_likelihood
from markermend.filling.mixture import weighted_mean
from markermend.numerics.kernel_density import kernel_density

RNG = np.random.default_rng(8)


def naive_pma(positions, references, samples):
    """tits2018 eq 20-24, one frame and one member at a time."""
    members, frames, _ = positions.shape
    mean, weights = np.zeros((frames, 3)), np.zeros((members, frames))
    for n in range(frames):
        for k in range(members):
            weights[k, n] = 1.0
            for j in range(references.shape[1]):
                distance = np.sqrt(((references[n, j] - positions[k, n]) ** 2).sum())
                weights[k, n] *= gaussian_kde(samples[j], bw_method="silverman")(distance)[0]
        for k in range(members):
            mean[n] += positions[k, n] * weights[k, n] / weights[:, n].sum()
    return mean, weights


@pytest.fixture
def distances():
    return [np.random.default_rng(8).normal(100 + 40 * j, 3 + j, 300) for j in range(3)]


def test_weights_and_mean_equal_the_formulas(distances):
    densities = [kernel_density(sample, max_samples=1000) for sample in distances]
    references = RNG.normal(0, 5, (30, 3, 3)) + np.diag([100.0, 140.0, 180.0])
    positions = RNG.normal(0, 6, (4, 30, 3))
    likelihood = pma_likelihood(positions, references, densities, window=1, floor=0.0)
    mean, weights = weighted_mean(positions, likelihood)
    expected, raw = naive_pma(positions, references, distances)
    assert np.allclose(likelihood, raw)
    assert np.allclose(mean, expected)
    assert np.allclose(weights.sum(axis=0), 1)


def test_members_without_a_prediction_are_left_out():
    positions = np.zeros((3, 4, 3))
    positions[1] += 6
    positions[2] = np.nan
    mean, weights = weighted_mean(positions, np.ones((3, 4)))
    assert np.allclose(mean, 3) and np.allclose(weights[2], 0)
    positions[0, 2] = np.nan
    assert np.allclose(weighted_mean(positions, np.ones((3, 4)))[0], 6)
    assert np.isnan(weighted_mean(positions * np.nan, np.ones((3, 4)))[0]).all()
    assert np.allclose(weighted_mean(np.zeros((2, 4, 3)), np.zeros((2, 4)))[1], 0.5)
