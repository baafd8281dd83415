"""Scores of drifts: what stands out, and what is required where a marker does the same elsewhere."""

import numpy as np
import pytest

from markermend.detection.neighbour.drifts.scores import DriftScorer, median_response
from markermend.numerics.matched_filter import raised_cosine
from markermend.prediction.scene import Scene
from support.signals import options_of

SCORER = DriftScorer(100.0, options_of("slow", "default"))


def test_where_a_near_neighbour_is_briefly_missing_nothing_is_scored():
    positions = np.zeros((300, 3, 3))
    positions[108:112, 1] = np.nan
    positions[200:220, 2] = np.nan
    scene = Scene(positions, 100.0, [np.array([1, 2]), np.array([0, 2]), np.array([0, 1])])
    missing = SCORER.briefly_missing_neighbour(scene)
    assert missing[108:112, [0, 2]].all()
    assert np.count_nonzero(missing) == 8


@pytest.mark.parametrize(
    ("elsewhere", "expected"),
    [([], 1), ([0.9], 1), ([5, 0.9], 1.53), ([0.9, 0.4, 5], 1.53), ([2, 2], 3.4), ([50, 40], 5)],
)
def test_what_a_marker_does_elsewhere_raises_the_required_score(elsewhere, expected):
    score = np.zeros(2000)
    score[1000:1020] = 1.4
    for place, height in zip((200, 500, 1500), elsewhere, strict=False):
        score[place - 10 : place + 10] = np.minimum(np.r_[1:11, 10:0:-1] / 10, 1) * height
    required = SCORER.required_score(score, 1000, 1020)
    assert required == pytest.approx(expected)


def scored(residual, factors=None):
    """Scores of three markers among each other that do not move."""
    near = [np.array([1, 2]), np.array([0, 2]), np.array([0, 1])]
    factors = np.ones(residual.shape[:2]) if factors is None else factors
    scene = Scene(np.zeros(residual.shape), 100.0, near)
    return SCORER.score(scene, residual, factors, SCORER.motion(scene))


def quiet(seed=0):
    return np.random.default_rng(seed).normal(0, 0.3, (1500, 3, 3))


def test_a_drift_stands_out_on_its_marker_with_its_length():
    residual = quiet()
    residual[700:775, 1] += raised_cosine((np.arange(75) + 0.5) / 75)[:, None] * [6, 0, 8]
    scores = scored(residual)
    assert abs(int(scores.score[:, 1].argmax()) - 737) <= 5
    assert abs(scores.length[737, 1] - 75) <= 20
    assert scores.score[737, 1] > 3 > 1 > scores.score[:, [0, 2]].max()


def test_where_leverage_widens_the_residual_less_stands_out():
    residual = quiet()
    residual[700:775, 1] += raised_cosine((np.arange(75) + 0.5) / 75)[:, None] * [6, 0, 8]
    factors = np.ones(residual.shape[:2])
    factors[600:900] = 4
    assert scored(residual, factors).score[737, 1] < 0.4 * scored(residual).score[737, 1]


def test_rescored_with_the_same_residual_the_scores_are_the_same():
    residual = quiet()
    residual[700:775, 1] += raised_cosine((np.arange(75) + 0.5) / 75)[:, None] * [6, 0, 8]
    scores = scored(residual)
    again = SCORER.rescore(scores, residual[:, 1], np.ones(len(residual)), marker=1)
    np.testing.assert_allclose(again, scores.score[:, 1])


def test_a_residual_of_nothing_has_no_score():
    residual = quiet()
    residual[:, 2] = np.nan
    scores = scored(residual)
    assert not scores.score[:, 2].any()
    assert median_response(np.full((2, 5), np.nan)).tolist() == [1, 1]
