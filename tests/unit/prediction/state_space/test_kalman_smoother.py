"""The Kalman smoother: equal to a dense Gaussian conditional, carries a body across a blackout, honest about its error."""

import numpy as np
import pytest

from markermend.filling.constraints import constrain_time
from markermend.prediction.state_space.kalman_smoother import constant_velocity_model
from support.fillings import predictor, scene


def small_motion(seed=3):
    """A constant-velocity model, and its parameters."""
    rng = np.random.default_rng(seed)
    parts = {
        "loading": rng.normal(size=(4, 3, 2)),
        "offset": rng.normal(size=(4, 3)) * 10,
        "observation_noise": rng.uniform(0.1, 1, 4),
        "acceleration": rng.uniform(0.5, 2, 2),
        "position_variance": np.array([50.0, 80.0]),
        "velocity_variance": np.array([3.0, 2.0]),
    }
    return constant_velocity_model(**parts), parts


def dense_conditional(parts, observed, marker):
    """Posterior by conditioning the joint Gaussian of all states and observations."""
    frames, _, _ = observed.shape
    size = len(parts["acceleration"])
    step = np.kron([[1, 1], [0, 1]], np.eye(size))
    push = np.kron([[1 / 3, 1 / 2], [1 / 2, 1]], np.diag(parts["acceleration"]))
    first = np.diag(np.concatenate([parts["position_variance"], parts["velocity_variance"]]))
    covariance = np.zeros((frames, 2 * size, frames, 2 * size))
    marginal = first
    for t in range(frames):
        passed = marginal
        for later in range(t, frames):
            covariance[later, :, t], covariance[t, :, later] = passed, passed.T
            passed = step @ passed
        marginal = step @ marginal @ step.T + push
    place = covariance[:, :size, :, :size]
    joint = np.einsum("mka,tasb,nlb->tmksnl", parts["loading"], place, parts["loading"])
    joint = joint.reshape(observed.size, -1)
    known = ~np.isnan(observed).reshape(-1)
    noise = np.tile(np.repeat(parts["observation_noise"], 3), frames)
    mean = np.tile(parts["offset"].reshape(-1), frames)
    gain = np.linalg.solve((joint + np.diag(noise))[np.ix_(known, known)], joint[known]).T
    posterior = mean + gain @ (observed.reshape(-1) - mean)[known]
    variance = np.diag(joint - gain @ joint[known]) + noise
    return posterior.reshape(observed.shape)[:, marker], variance.reshape(observed.shape)[:, marker]


def test_smoothing_equals_the_dense_conditional():
    rng = np.random.default_rng(4)
    system, parts = small_motion()
    observed = rng.normal(size=(14, 4, 3)) * 10
    observed[4:9, 1] = np.nan
    observed[6:8] = np.nan
    observed[12:, 2:] = np.nan
    before = observed.copy()
    states = system.smooth(observed)
    expected, spread = dense_conditional(parts, observed, 1)
    assert np.array_equal(observed, before, equal_nan=True)
    assert np.allclose(system.positions(states.mean)[:, 1], expected)
    assert np.allclose(np.diagonal(system.position_covariance(states.covariance, 1), axis1=1, axis2=2), spread)


@pytest.mark.parametrize("left", [0, 2])
def test_a_blackout_is_bridged_better_than_by_a_straight_line(left, walker):
    positions = walker.recording.positions[:800]
    seen = scene(positions)
    for marker in (3, 12, 20):
        error, line = [], []
        for start in (200, 400, 600):
            gapped = positions.copy()
            gapped[start : start + 30] = np.nan
            kept = seen.neighbours[marker][5 : 5 + left]
            gapped[start : start + 30, kept] = positions[start : start + 30, kept]
            hidden = type(seen)(gapped, 100.0, seen.neighbours)
            truth = positions[start : start + 30, marker]
            found = predictor("kalman").predict(hidden, marker, start, start + 30)
            assert np.isfinite(found.positions).all() and (found.error > 0).all()
            straight = predictor("linear").predict(hidden, marker, start, start + 30).positions
            trajectory = constrain_time(found.positions, positions[[start - 1, start + 30], marker])
            error.append(np.linalg.norm(trajectory[1:-1] - truth, axis=1).mean())
            line.append(np.linalg.norm(straight[1:-1] - truth, axis=1).mean())
        assert np.mean(error) < 25
        assert np.mean(error) < np.mean(line) + 2


def test_the_error_grows_inside_a_blackout_and_with_its_length(walker):
    positions = walker.recording.positions[:800].copy()
    seen = scene(positions)
    positions[300:340] = np.nan
    positions[500:600] = np.nan
    hidden = type(seen)(positions, 100.0, seen.neighbours)
    short = predictor("kalman").predict(hidden, 9, 300, 340).error
    long = predictor("kalman").predict(hidden, 9, 500, 600).error
    assert short[20] > 1.5 * short[0] and long[50] > 1.5 * short[20]


@pytest.mark.parametrize(("length", "left"), [(30, 0), (80, 0), (40, 12)])
def test_the_stated_error_is_that_of_the_truth_within_a_factor(length, left, walker):
    positions = walker.recording.positions[:800]
    seen = scene(positions)
    square, stated = [], []
    for marker in (3, 12, 20):
        for start in (150, 400, 600):
            gapped = positions.copy()
            gapped[start : start + length] = np.nan
            kept = seen.neighbours[marker][:left]
            gapped[start : start + length, kept] = positions[start : start + length, kept]
            found = predictor("kalman").predict(
                type(seen)(gapped, 100.0, seen.neighbours), marker, start, start + length
            )
            square.append((found.positions[1:-1] - positions[start : start + length, marker]) ** 2)
            stated.append(found.error[1:-1] ** 2)
    ratio = np.sqrt(np.mean(square) / np.mean(stated))
    assert 0.5 < ratio < 1.6


def test_with_all_neighbours_the_pose_determines_the_place(walker):
    positions = walker.recording.positions
    found = predictor("kalman").predict(scene(positions), 9, 500, 600)
    assert np.linalg.norm(found.positions - positions[499:601, 9], axis=1).mean() < 25


def test_without_a_body_or_anything_seen_nearby_nothing_is_said(walker):
    positions = walker.recording.positions[:600].copy()
    seen = scene(positions)
    positions[100:500] = np.nan
    hidden = type(seen)(positions, 100.0, seen.neighbours)
    assert np.isnan(predictor("kalman").predict(hidden, 9, 250, 300).positions).all()
    alone = type(seen)(walker.recording.positions[:600], 100.0, [near[:1] for near in seen.neighbours])
    assert np.isnan(predictor("kalman").predict(alone, 9, 250, 300).positions).all()
