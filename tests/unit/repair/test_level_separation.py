"""Flicker between two levels is undone by the jumps between them; what is no flicker is left to other methods."""

import numpy as np
import pytest

from markermend.options.repair import SeparationOptions
from markermend.repair.level_separation import separate_levels

OPTIONS = SeparationOptions()
VECTOR = np.array([6.0, -4.0, 3.0])
STATES = np.array([0, 1, 1, 0, 0, 1, 1, 1, 0, 1, 0, 0, 1, 0])


@pytest.fixture
def true():
    """A path of fourteen samples, with a little noise."""
    time = np.linspace(0, 1, len(STATES))[:, None]
    return 300 * np.sin(3 * time + [0, 1, 2]) + np.random.default_rng(5).normal(0, 0.1, (len(STATES), 3))


def wrong_prediction(true):
    """A prediction whose error is as large as the flicker, but changes slowly."""
    return true + np.linspace(8.0, -5.0, len(true))[:, None]


@pytest.mark.parametrize("outside", [(True, True), (True, False), (False, True)])
def test_samples_at_the_wrong_level_are_moved_back(true, outside):
    measured = true + STATES[:, None] * VECTOR
    proposal = separate_levels(measured, wrong_prediction(true), outside=outside, options=OPTIONS)
    np.testing.assert_allclose(proposal.positions, true[1:-1], atol=0.8)
    right = STATES[1:-1] == 0
    np.testing.assert_array_equal(proposal.positions[right], measured[1:-1][right])
    assert proposal.error.shape == (len(true) - 2,) and 0 < proposal.error[0] < 1.5


def test_nothing_is_proposed_without_two_levels(true):
    expected = wrong_prediction(true)
    noise = np.random.default_rng(6).normal(0, 4.0, true.shape)
    step = (np.arange(len(true)) >= 5)[:, None] * VECTOR
    for measured in (true + noise, true + step, true):
        assert separate_levels(measured, expected, outside=(True, True), options=OPTIONS) is None


def test_nothing_is_proposed_where_the_right_level_is_not_known(true):
    measured, expected = true + STATES[:, None] * VECTOR, wrong_prediction(true)
    assert separate_levels(measured, expected, outside=(False, False), options=OPTIONS) is None
    half = measured.copy()
    half[-1] += VECTOR
    assert separate_levels(half, expected, outside=(True, True), options=OPTIONS) is None


def test_nothing_is_proposed_across_a_gap(true):
    measured = true + STATES[:, None] * VECTOR
    measured[6] = np.nan
    assert separate_levels(measured, wrong_prediction(true), outside=(True, True), options=OPTIONS) is None
