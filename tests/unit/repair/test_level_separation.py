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
    """A prediction whose error is as large as the flicker, but changes slowly, but for noise."""
    noise = np.random.default_rng(7).normal(0, 0.1, true.shape)
    return true + np.linspace(8.0, -5.0, len(true))[:, None] + noise


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


def test_jitter_to_and_fro_has_no_levels():
    rng = np.random.default_rng(10)
    signs = np.where(np.arange(100) % 2, 1.0, -1.0) * np.where(rng.random(100) < 0.2, -1.0, 1.0)
    jitter = (signs * rng.uniform(0.4, 1.6, 100))[:, None] * VECTOR + rng.normal(0, 0.2, (100, 3))
    measured = np.pad(jitter, ((1, 1), (0, 0)))
    assert separate_levels(measured, np.zeros_like(measured), outside=(True, True), options=OPTIONS) is None


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


def test_stretches_that_are_unevenly_displaced_are_moved_back_by_their_own_jumps():
    rng = np.random.default_rng(8)
    sizes = np.repeat([1.1, 0.0, 0.9, 0.0, 1.08, 0.0, 0.92, 0.0], 12)
    true = np.cumsum(rng.normal(0, 3, (len(sizes) + 2, 3)), axis=0)
    measured = true + np.pad(sizes, 1)[:, None] * VECTOR
    expected = true + rng.normal(0, 0.05, true.shape)
    proposal = separate_levels(measured, expected, outside=(True, True), options=OPTIONS)
    np.testing.assert_allclose(proposal.positions, true[1:-1], atol=0.25)
    assert 0.02 < proposal.error[0] < 0.2


def test_a_change_as_large_as_half_a_jump_is_none():
    rng = np.random.default_rng(9)
    states = np.repeat([1, 0, 1, 0, 1, 0], 10)
    true = np.cumsum(rng.normal(0, 3, (len(states) + 2, 3)), axis=0)
    expected = true + rng.normal(0, 0.1, true.shape)
    expected[25:] += 0.6 * VECTOR
    proposal = separate_levels(
        true + np.pad(states, 1)[:, None] * VECTOR, expected, outside=(True, True), options=OPTIONS
    )
    np.testing.assert_allclose(proposal.positions, true[1:-1], atol=0.8)
