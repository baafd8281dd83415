"""The Kalman smoother: equal to a dense Gaussian conditional, carries a body across a blackout, honest about its error."""

import numpy as np
import pytest

from fillings import predictor, scene
from markermend.constraints import constrain_time
from markermend.predictors.kalman import Chain


def small_chain(seed=3):
    rng = np.random.default_rng(seed)
    loading = rng.normal(size=(4, 3, 2))
    return Chain(
        loading,
        rng.normal(size=(4, 3)) * 10,
        noise=rng.uniform(0.1, 1, 4),
        drive=rng.uniform(0.5, 2, 2),
        start=np.array([50.0, 80.0]),
        start_velocity=np.array([3.0, 2.0]),
    )


def dense_conditional(chain, observed, marker):
    """Posterior by conditioning the joint Gaussian of all states and observations."""
    frames, markers, _ = observed.shape
    size = len(chain.drive)
    step = np.kron([[1, 1], [0, 1]], np.eye(size))
    push = np.kron([[1 / 3, 1 / 2], [1 / 2, 1]], np.diag(chain.drive))
    first = np.diag(np.concatenate([chain.start, chain.start_velocity]))
    covariance = np.zeros((frames, 2 * size, frames, 2 * size))
    marginal = first
    for t in range(frames):
        passed = marginal
        for later in range(t, frames):
            covariance[later, :, t], covariance[t, :, later] = passed, passed.T
            passed = step @ passed
        marginal = step @ marginal @ step.T + push
    place = covariance[:, :size, :, :size]
    joint = np.einsum("mka,tasb,nlb->tmksnl", chain.loading, place, chain.loading)
    joint = joint.reshape(frames * markers * 3, -1)
    known = ~np.isnan(observed).reshape(-1)
    noise = np.tile(np.repeat(chain.noise, 3), frames)
    mean = np.tile(chain.middle.reshape(-1), frames)
    gain = np.linalg.solve((joint + np.diag(noise))[np.ix_(known, known)], joint[known]).T
    posterior = mean + gain @ (observed.reshape(-1) - mean)[known]
    variance = np.diag(joint - gain @ joint[known]) + noise
    shape = (frames, markers, 3)
    return posterior.reshape(shape)[:, marker], variance.reshape(shape)[:, marker]


def test_smoothing_equals_the_dense_conditional():
    rng = np.random.default_rng(4)
    chain = small_chain()
    observed = rng.normal(size=(14, 4, 3)) * 10
    observed[4:9, 1] = np.nan
    observed[6:8] = np.nan
    observed[12:, 2:] = np.nan
    before = observed.copy()
    wanted = np.array([0, 5, 7, 13])
    mean, variance = chain.smooth(observed, 1, wanted)
    expected, spread = dense_conditional(chain, observed, 1)
    assert np.array_equal(observed, before, equal_nan=True)
    assert np.allclose(mean, expected) and np.allclose(variance, spread[wanted])


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
            course = constrain_time(found.positions, positions[[start - 1, start + 30], marker])
            error.append(np.linalg.norm(course[1:-1] - truth, axis=1).mean())
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


def test_with_the_neighbours_there_the_pose_tells_the_place(walker):
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
