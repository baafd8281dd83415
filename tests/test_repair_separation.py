"""Parting a prediction's error from an artifact: exact, honest about what remains unsure, and better than either alone."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from markermend.events import Event
from markermend.predictors.kriging import Covariance
from markermend.separation import COURSES, SeparationOptions, artifacts, bridge, pinned, separate
from repairs import MARKER, METHODS, START, STOP, body, distorted, error, mend

N = 24
KERNEL = Covariance(np.array([0.04, 2.0, 5.0, 1.0, 0.5]), np.array([0.05, 0.3]))
OPTIONS = SeparationOptions(
    amplitudes_mm=[3, 12, 48], roughness_mm=[0.1, 1], border_s=0.1, margins=[0], most_frames=1000
)
EXTENTS = [(0, N), (3, N - 2)]


@pytest.fixture(scope="module")
def clean():
    return body()


def errors():
    """Covariance of an error of some mm that is small at both borders."""
    deviation = 3 * np.sqrt(np.diag(pinned_between())) + 0.5
    return correlation() * deviation * deviation[:, None]


def times():
    return np.arange(N) / 100, np.concatenate([np.arange(-8, 0), np.arange(N, N + 8)]) / 100


def correlation():
    wanted, known = times()
    return pinned(KERNEL, known_s=known, wanted_s=wanted)


def pinned_between():
    """Twin of the covariance that `pinned` normalises: a joint normal, conditioned by inverting its precision."""
    wanted, known = times()
    place = np.concatenate([wanted, known])
    joint = KERNEL(place[:, None] - place) + KERNEL.noise * np.eye(len(place))
    return np.linalg.inv(np.linalg.inv(joint + 1e-9 * np.eye(len(place)))[:N, :N])


def test_pinned_is_the_correlation_given_the_borders():
    expected = pinned_between()
    deviation = np.sqrt(np.diag(expected))
    assert np.allclose(correlation(), expected / deviation / deviation[:, None], atol=1e-3)
    assert np.allclose(np.diag(correlation()), 1)


def test_nothing_known_leaves_the_process_as_it_is():
    wanted, _ = times()
    free = KERNEL(wanted[:, None] - wanted) + KERNEL.noise * np.eye(N)
    assert np.allclose(pinned(KERNEL, known_s=np.zeros(0), wanted_s=wanted), free / free[0, 0])


def test_a_bridge_is_smooth_and_begins_and_ends_at_nothing():
    covariance = bridge(49)
    drawn = np.random.default_rng(1).multivariate_normal(np.zeros(49), covariance, 200)
    assert np.abs(np.diff(drawn, n=2, axis=1)).max() < 0.2 * np.abs(drawn).max()
    assert np.diag(covariance).argmax() == 24 and np.diag(covariance)[[0, -1]].max() < 0.02 * covariance[24, 24]


@pytest.mark.parametrize("method", COURSES)
@pytest.mark.parametrize("lost", [[], [0, 5, 6]])
def test_separating_is_bayes_rule(method, lost):
    """Each artifact in turn by conditioning one joint normal distribution, then averaged by their likelihoods."""
    rng = np.random.default_rng(5)
    covariance, tried = errors(), artifacts(method, N, OPTIONS, EXTENTS)
    difference = rng.multivariate_normal(np.zeros(N), covariance + tried[2], 3).T
    difference[lost] = np.nan
    rows = np.setdiff1d(np.arange(N), lost)
    weights, means, seconds = [], [], []
    for artifact in tried:
        seen = (covariance + artifact)[np.ix_(rows, rows)]
        weights.append(multivariate_normal(np.zeros(len(rows)), seen).logpdf(difference[rows].T).sum())
        gain = covariance[:, rows] @ np.linalg.inv(seen)
        means.append(gain @ difference[rows])
        seconds.append(np.diag(covariance - gain @ covariance[rows])[:, None] + means[-1] ** 2)
    weights = np.exp(np.array(weights) - max(weights))
    weights /= weights.sum()
    mean = np.tensordot(weights, means, 1)
    deviation = np.sqrt((np.tensordot(weights, seconds, 1) - mean**2).mean(axis=1))
    misfits = [
        np.trace(difference[rows].T @ np.linalg.solve((covariance + artifact)[np.ix_(rows, rows)], difference[rows]))
        for artifact in tried
    ]
    deviation *= max(1.0, np.sqrt(weights @ misfits / difference[rows].size))
    told, stated = separate(difference, covariance, tried)
    assert np.allclose(told, mean, atol=1e-4) and np.allclose(stated, deviation, rtol=1e-3)


@pytest.mark.parametrize("method", COURSES)
def test_what_remains_unsure_is_stated(method):
    rng = np.random.default_rng(2)
    covariance, tried = errors(), artifacts(method, N, OPTIONS, EXTENTS)
    missed = []
    for _ in range(150):
        truth = rng.multivariate_normal(np.zeros(N), covariance, 3).T
        artifact = rng.multivariate_normal(np.zeros(N), tried[rng.integers(len(tried))], 3).T
        told, stated = separate(truth + artifact, covariance, tried)
        missed.append(np.linalg.norm(told - truth, axis=1) / stated)
    # Averaged over artifacts the error is no longer normal: more of it is near and more of it is far.
    assert np.mean(np.concatenate(missed) < 1.8724) == pytest.approx(0.7, abs=0.06)
    assert np.mean(np.concatenate(missed) < 2.7955) == pytest.approx(0.95, abs=0.03)


RAMP = np.concatenate([np.arange(1, 21), np.arange(20, 0, -1)])[:, None] / 20
DAMAGE = {
    "noise": ("separate_noise", 0.6, np.random.default_rng(4).normal(0, 6.0, (40, 3))),
    "steps": ("separate_step", 0.1, np.full((40, 3), 12.0)),
    "slow": ("separate_slow", 0.9, RAMP * [12.0, -9.0, 6.0]),
}


@pytest.fixture(scope="module")
def wobbling(clean):
    """One marker moves by some mm in ways of its own, of which the neighbours know nothing."""
    push = np.random.default_rng(6).normal(0, 4.0, (clean.frames + 30, 3))
    own = np.stack([np.convolve(axis, np.hanning(31) / np.sqrt(11.25), "valid") for axis in push.T], axis=1)
    return distorted(clean, own[: clean.frames], 0, clean.frames)


@pytest.mark.parametrize("kind", DAMAGE)
def test_what_was_measured_mends_the_prediction(wobbling, kind):
    method, share, change = DAMAGE[kind]
    recording, found = distorted(wobbling, change), {kind: [Event(MARKER, START, STOP, 4.0)]}
    plain, parted = (mend(recording, found, methods={**METHODS, kind: [own]}) for own in ("local_ridge", method))
    assert parted.facts["repairs"][0]["method"] == method
    before, alone, after = (np.sqrt((error(wobbling, one) ** 2).mean()) for one in (recording, plain, parted))
    assert after < share * alone and after < share * before


@pytest.mark.parametrize("method", COURSES)
def test_a_gap_within_stays_a_gap(clean, method):
    recording = distorted(clean, 12.0)
    m = clean.markers.index(MARKER)
    recording.positions[612:618, m] = np.nan
    result = mend(recording, {"steps": [Event(MARKER, START, STOP, 4.0)]}, methods={**METHODS, "steps": [method]})
    assert result.facts["repairs"][0]["method"] == method
    assert np.isnan(result.positions[612:618, m]).all() and not np.isnan(result.positions[START:612, m]).any()


def test_what_is_too_long_to_part_is_left_to_others(clean):
    found = {"steps": [Event(MARKER, START, STOP, 4.0)]}
    given = {
        "most_frames": STOP - START - 1,
        "amplitudes_mm": [3],
        "roughness_mm": [1],
        "border_s": 0.15,
        "margins": [0],
    }
    methods = {**METHODS, "steps": ["separate_step"]}
    result = mend(distorted(clean, 12.0), found, methods=methods, separation=given)
    (left,) = result.facts["repairs_left"]
    assert left["reason"] == "no repair can be trusted (separate_step: not applicable)"


def test_a_slow_change_may_begin_before_it_was_found(clean):
    """What of it is left beside the finding would pull the prediction along, if it counted as the true course."""
    course = np.concatenate([np.arange(1, 27), np.arange(26, 0, -1)])[:, None] / 26 * [12.0, -9.0, 6.0]
    recording, found = distorted(clean, course, START - 6, STOP + 6), {"slow": [Event(MARKER, START, STOP, 4.0)]}
    given = {"most_frames": 1000, "amplitudes_mm": [3, 10, 30], "roughness_mm": [0.3, 2], "border_s": 0.15}
    exact, wider = (
        mend(recording, found, methods={**METHODS, "slow": ["separate_slow"]}, separation={**given, "margins": margins})
        for margins in ([0], [0, 0.1])
    )
    assert error(clean, wider).max() < 0.5 * error(clean, exact).max()
    outside = np.r_[:START, STOP : clean.frames]
    assert np.array_equal(wider.positions[outside], recording.positions[outside])


def test_beside_a_gap_a_slow_change_begins_where_the_marker_is_seen(clean):
    m, recording = clean.markers.index(MARKER), distorted(clean, RAMP * [12.0, -9.0, 6.0])
    recording.positions[STOP : STOP + 20, m] = np.nan
    result = mend(
        recording, {"slow": [Event(MARKER, START, STOP, 4.0)]}, methods={**METHODS, "slow": ["separate_slow"]}
    )
    assert result.facts["repairs"][0]["method"] == "separate_slow"
    assert np.isnan(result.positions[STOP : STOP + 20, m]).all() and error(clean, result).max() < 1
