"""Linear dynamical systems: the smoother equals filter and backward smoother, learning never gets less likely."""

import numpy as np
import pytest

from markermend.prediction.state_space.linear_dynamics import LinearDynamics, fit_linear_dynamics, maximise

LEARNING = {"dimensions": 4, "lag": 0, "iterations": 15, "tolerance": 0.0, "floor": 1e-6}


def small_system(seed=1, size=4, markers=5):
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.normal(size=(size, size)))
    root = rng.normal(size=(size, size)) * 0.1
    return LinearDynamics(
        initial_variance=rng.uniform(0.5, 2, size),
        transition=0.97 * turn,
        process_noise=root @ root.T + 0.01 * np.eye(size),
        loading=rng.normal(size=(markers, 3, size)),
        offset=rng.normal(size=(markers, 3)) * 5,
        observation_noise=rng.uniform(0.01, 0.1, markers),
    )


def draw(system, frames, seed=2):
    rng = np.random.default_rng(seed)
    state = rng.normal(size=len(system.initial_variance)) * np.sqrt(system.initial_variance)
    states = [state]
    for _ in range(frames - 1):
        state = system.transition @ state + rng.multivariate_normal(np.zeros(len(state)), system.process_noise)
        states.append(state)
    positions = system.positions(np.array(states))
    return positions + rng.normal(size=positions.shape) * np.sqrt(system.observation_noise)[:, None]


def with_holes(positions):
    gapped = positions.copy()
    gapped[8:15, 1] = np.nan
    gapped[10:13] = np.nan
    gapped[-4:, :3] = np.nan
    gapped[0, 4] = np.nan
    return gapped


def naive_smoother(system, observed):
    """Kalman filter and Rauch-Tung-Striebel smoother, frame by frame: means, covariances, crosses, log-likelihood."""
    size = len(system.initial_variance)
    mean, covariance = np.zeros(size), np.diag(system.initial_variance)
    predicted, filtered, likelihood = [], [], 0.0
    for t, frame in enumerate(observed):
        if t:
            mean = system.transition @ mean
            covariance = system.transition @ covariance @ system.transition.T + system.process_noise
        predicted.append((mean, covariance))
        seen = ~np.isnan(frame).any(axis=1)
        if seen.any():
            loading = system.loading[seen].reshape(-1, size)
            innovation = (frame - system.offset)[seen].reshape(-1) - loading @ mean
            total = loading @ covariance @ loading.T + np.diag(system.observation_noise[seen].repeat(3))
            gain = np.linalg.solve(total, loading @ covariance).T
            likelihood -= 0.5 * (
                innovation @ np.linalg.solve(total, innovation) + np.linalg.slogdet(2 * np.pi * total)[1]
            )
            mean, covariance = mean + gain @ innovation, covariance - gain @ loading @ covariance
        filtered.append((mean, covariance))
    smoothed, crosses = [filtered[-1]], []
    for t in range(len(observed) - 2, -1, -1):
        back = np.linalg.solve(predicted[t + 1][1], system.transition @ filtered[t][1]).T
        after = smoothed[-1]
        crosses.append(after[1] @ back.T)
        own = filtered[t][1] + back @ (after[1] - predicted[t + 1][1]) @ back.T
        smoothed.append((filtered[t][0] + back @ (after[0] - predicted[t + 1][0]), own))
    means, covariances = zip(*smoothed[::-1], strict=True)
    return np.array(means), np.array(covariances), np.array(crosses[::-1]), likelihood


@pytest.mark.parametrize("frames", [1, 2, 30])
def test_smoothing_equals_the_filter_and_backward_smoother(frames):
    system = small_system()
    observed = with_holes(draw(system, 30))[:frames]
    states = system.smooth(observed)
    mean, covariance, cross, likelihood = naive_smoother(system, observed)
    assert np.allclose(states.mean, mean) and np.allclose(states.covariance, covariance)
    assert np.allclose(states.lag_one_covariance.reshape(cross.shape), cross)
    assert np.isclose(states.log_likelihood, likelihood)


@pytest.mark.parametrize(("floor", "lag"), [(1e-6, 0), (0.05, 0), (1e-6, 5)])
def test_learning_never_gets_less_likely(floor, lag):
    observed = with_holes(draw(small_system(), 80))
    before = observed.copy()
    system, likelihood = fit_linear_dynamics(observed, **{**LEARNING, "floor": floor, "lag": lag, "iterations": 40})
    assert np.array_equal(observed, before, equal_nan=True)
    assert len(likelihood) == 40 and likelihood[-1] > likelihood[0] + 10
    assert (np.diff(likelihood) > -1e-7 * np.abs(likelihood[1:])).all()
    assert system.observation_noise.min() >= floor and np.linalg.eigvalsh(system.process_noise).min() > floor * (
        1 - 1e-9
    )
    assert np.isclose(system.smooth(observed).log_likelihood, likelihood[-1])


def test_no_other_system_is_likelier_in_the_m_step():
    """The expected complete log-likelihood, sampled about the closed form, is lower everywhere."""
    observed = with_holes(draw(small_system(), 60))
    guess, _ = fit_linear_dynamics(observed, **{**LEARNING, "iterations": 1})
    states = guess.smooth(observed)
    best = maximise(observed, states, floor=1e-6)

    def expected(system):
        square = states.covariance + states.mean[:, :, None] * states.mean[:, None]
        onward = states.lag_one_covariance + states.mean[1:, :, None] * states.mean[:-1, None]
        step = system.transition
        spread = square[1:] - step @ onward.transpose(0, 2, 1) - onward @ step.T + step @ square[:-1] @ step.T
        total = np.trace(np.linalg.solve(system.process_noise, spread.sum(axis=0)))
        total += (len(observed) - 1) * np.linalg.slogdet(system.process_noise)[1]
        rest = (observed - system.positions(states.mean)) ** 2
        own = np.einsum("mkd,nde,mke->nmk", system.loading, states.covariance, system.loading)
        noise = system.observation_noise[:, None]
        return -0.5 * (total + np.nansum((rest + own) / noise + np.log(noise)))

    rng = np.random.default_rng(3)
    for name in ("transition", "process_noise", "loading", "offset", "observation_noise"):
        for _ in range(5):
            value = getattr(best, name)
            push = rng.normal(size=value.shape) * 1e-3 * np.abs(value).mean()
            push = (push + push.T) / 2 if name == "process_noise" else push
            other = LinearDynamics(**{**best.__dict__, name: value + push})
            assert expected(other) < expected(best), name


def test_missing_samples_of_a_known_system_are_recovered():
    system = small_system(markers=8)
    whole = draw(system, 300, seed=5)
    gapped = whole.copy()
    gapped[150:190, 0] = np.nan
    gapped[200:206] = np.nan
    learned, _ = fit_linear_dynamics(gapped, **{**LEARNING, "iterations": 30})
    ideal = system.positions(system.smooth(gapped).mean) - whole
    found = learned.positions(learned.smooth(gapped).mean) - whole
    for place in ((slice(150, 190), 0), (slice(200, 206),)):
        assert np.sqrt((found[place] ** 2).mean()) < 1.25 * np.sqrt((ideal[place] ** 2).mean())


def test_a_first_guess_that_looks_ahead_carries_velocities_across_a_blackout():
    """A marker on an ellipse, and nothing else: the place alone does not determine where it goes."""
    angle = np.arange(300) / 20
    trajectory = np.stack([np.sin(angle), 2 * np.sin(angle + 1), 0.3 * np.sin(2 * angle)], axis=1)
    whole = trajectory[:, None] + np.random.default_rng(6).normal(size=(300, 1, 3)) * 0.01
    gapped = whole.copy()
    gapped[140:180] = np.nan
    error = []
    for lag in (0, 5):
        system, _ = fit_linear_dynamics(gapped, **{**LEARNING, "lag": lag, "dimensions": 5, "iterations": 20})
        found = system.positions(system.smooth(gapped).mean)[140:180]
        error.append(np.sqrt(((found - whole[140:180]) ** 2).mean()))
    assert error[1] < 0.05 and error[1] < error[0] / 3
