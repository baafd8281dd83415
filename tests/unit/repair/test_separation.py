"""Separating the error of a prediction from an artifact: exact, with true errors, and better than either alone."""

import numpy as np
import pytest

from markermend.numerics.kriging import Covariance
from markermend.options.repair import SeparationOptions
from markermend.repair.separation import (
    SHAPE_COVARIANCES,
    Separation,
    artifact_covariances,
    average_by_likelihood,
    bridge_covariance,
    conditional_correlation,
    oscillation_covariance,
    plateau_covariance,
    separate,
    tent_covariance,
)
from markermend.simulation.artifact_models import shape
from support.naive import repair as naive

N = 24
KERNEL = Covariance(np.array([0.04, 2.0, 5.0, 1.0, 0.5]), np.array([0.05, 0.3]))
OPTIONS = SeparationOptions(
    local_ridge_changes=({},),
    amplitudes_mm=(3, 12, 48),
    roughness_mm=(0.1, 1),
    border_s=0.1,
    margin_fractions=(0,),
    likelihood_power=1,
    step_ramps_frames=(0, 2),
)
EXTENTS = [(0, N), (3, N - 2)]


def errors():
    """Covariance of an error of some mm that is small at both borders."""
    deviation = 3 * np.sqrt(np.diag(covariance_between())) + 0.5
    return correlation() * deviation * deviation[:, None]


def times():
    return np.arange(N) / 100, np.concatenate([np.arange(-8, 0), np.arange(N, N + 8)]) / 100


def correlation():
    wanted, known = times()
    return conditional_correlation(KERNEL, known_s=known, wanted_s=wanted)


def covariance_between():
    """The covariance that `conditional_correlation` normalises."""
    wanted, known = times()
    place = np.concatenate([wanted, known])
    joint = KERNEL(place[:, None] - place) + KERNEL.noise * np.eye(len(place))
    return naive.conditional_covariance(joint + 1e-9 * np.eye(len(place)), N)


def test_conditional_correlation_is_the_correlation_given_the_borders():
    expected = covariance_between()
    deviation = np.sqrt(np.diag(expected))
    assert np.allclose(correlation(), expected / deviation / deviation[:, None], atol=1e-3)
    assert np.allclose(np.diag(correlation()), 1)


def test_nothing_known_leaves_the_process_as_it_is():
    wanted, _ = times()
    free = KERNEL(wanted[:, None] - wanted) + KERNEL.noise * np.eye(N)
    assert np.allclose(conditional_correlation(KERNEL, known_s=np.zeros(0), wanted_s=wanted), free / free[0, 0])


def test_a_bridge_is_smooth_and_begins_and_ends_at_nothing():
    covariance = bridge_covariance(49)
    drawn = np.random.default_rng(1).multivariate_normal(np.zeros(49), covariance, 200)
    assert np.abs(np.diff(drawn, n=2, axis=1)).max() < 0.2 * np.abs(drawn).max()
    assert np.diag(covariance).argmax() == 24 and np.diag(covariance)[[0, -1]].max() < 0.02 * covariance[24, 24]


def test_a_tent_is_one_shape_of_any_size():
    """Its covariance is that of the published shape of slow changes times a random amplitude."""
    trajectory = shape("slow", 40)
    assert np.allclose(tent_covariance(40), np.outer(trajectory, trajectory) * tent_covariance(40).max())
    assert tent_covariance(40).max() == pytest.approx(1, abs=0.06)


def test_an_oscillation_keeps_its_frequency_and_forgets_its_phase():
    covariance = oscillation_covariance(400, frequency_hz=8.0, coherence_s=0.2, rate=100.0)
    drawn = np.random.default_rng(3).multivariate_normal(np.zeros(400), covariance, 100, method="eigh")
    power = (np.abs(np.fft.rfft(drawn)) ** 2).mean(axis=0)
    assert power.argmax() == pytest.approx(8.0 * 4, abs=3)
    assert covariance[0, 0] == 1 and abs(covariance[0, 100]) < 1e-4


def test_a_plateau_is_constant_between_its_ramps():
    assert np.allclose(plateau_covariance(6, ramp=0), np.ones((6, 6)))
    trajectory = np.array([1, 2, 3, 3, 3, 2, 1]) / 3
    assert np.allclose(plateau_covariance(7, ramp=2), np.outer(trajectory, trajectory))


@pytest.mark.parametrize("method", SHAPE_COVARIANCES)
@pytest.mark.parametrize(("lost", "power"), [([], 1.0), ([0, 5, 6], 1.0), ([], 0.2)])
def test_separating_is_bayes_rule(method, lost, power):
    rng = np.random.default_rng(5)
    covariance, tried = errors(), list(artifact_covariances(method, N, OPTIONS, EXTENTS, rate=100.0))
    difference = rng.multivariate_normal(np.zeros(N), covariance + tried[2], 3).T
    difference[lost] = np.nan
    mean, deviation, log_likelihood = naive.separate(difference, covariance, tried, power)
    separated = separate(difference, covariance, tried, likelihood_power=power)
    assert np.allclose(separated.mean, mean, atol=1e-4)
    assert np.allclose(np.sqrt(separated.variance), deviation, rtol=1e-3)
    constant = power * 3 * (N - len(lost)) / 2 * np.log(2 * np.pi)
    assert separated.log_likelihood == pytest.approx(log_likelihood + constant, abs=1e-2)


@pytest.mark.parametrize("method", SHAPE_COVARIANCES)
def test_what_remains_unsure_is_stated(method):
    rng = np.random.default_rng(2)
    covariance, tried = errors(), list(artifact_covariances(method, N, OPTIONS, EXTENTS, rate=100.0))
    missed = []
    for _ in range(150):
        truth = rng.multivariate_normal(np.zeros(N), covariance, 3).T
        artifact = rng.multivariate_normal(np.zeros(N), tried[rng.integers(len(tried))], 3).T
        separated = separate(truth + artifact, covariance, tried, likelihood_power=1)
        missed.append(np.linalg.norm(separated.mean - truth, axis=1) / np.sqrt(separated.variance))
    # Averaged over artifacts the error is no longer normal: more of it is near and more of it is far.
    assert np.mean(np.concatenate(missed) < 1.8724) == pytest.approx(0.7, abs=0.06)
    assert np.mean(np.concatenate(missed) < 2.7955) == pytest.approx(0.95, abs=0.03)


def test_the_mean_of_independent_errors_has_a_smaller_deviation():
    rng = np.random.default_rng(8)
    trajectories = rng.normal(0, 2.0, (2, 4000, 3))
    mean, deviation = average_by_likelihood(
        trajectories, [Separation(trajectory, np.full(4000, 4.0), -7.0) for trajectory in trajectories]
    )
    assert np.allclose(mean, trajectories.mean(axis=0))
    assert np.sqrt((mean**2).mean()) == pytest.approx(np.sqrt(2), rel=0.03)
    assert np.sqrt(2) < np.sqrt((deviation**2).mean()) < 0.9 * 2


def test_the_mean_of_equal_errors_has_the_same_deviation():
    trajectory = np.random.default_rng(8).normal(0, 2.0, (50, 3))
    mean, deviation = average_by_likelihood(
        [trajectory, trajectory], [Separation(trajectory, np.full(50, 4.0), -7.0)] * 2
    )
    assert np.allclose(mean, trajectory) and np.allclose(deviation, 2)


def test_the_likelier_prediction_counts_for_more():
    near, far = np.zeros((5, 3)), np.ones((5, 3))
    parts = [Separation(near, np.full(5, 4.0), -10.0), Separation(far, np.full(5, 9.0), -12.0)]
    mean, deviation = average_by_likelihood([near, far], parts)
    assert np.allclose(mean, 1 / (1 + np.exp(2)))
    assert (deviation < 2.4).all() and (deviation > 1.9).all()
