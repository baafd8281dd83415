"""Trust in members: weights, scales and expected errors from small numbers that can be checked by hand."""

import numpy as np
import pytest

from markermend.filling.member_weights import (
    deviation_scale,
    expected_errors,
    inverse_power_weights,
    squared_errors,
    typical_errors,
)

NAN = np.nan


def test_errors_are_summed_over_what_each_member_told():
    truths = [np.zeros((2, 3)), np.zeros((1, 3))]
    guesses = [np.array([[[3, 4, 0], [0, 0, 2]], [[NAN] * 3, [0, 1, 0]]]), np.array([[[0, 0, 1]], [[NAN] * 3]])]
    errors = squared_errors(truths, guesses, 2)
    assert errors.tolist() == [[[29, 1], [2, 1]], [[1, 0], [1, 0]]]
    assert typical_errors(errors) == pytest.approx([np.sqrt(10), 1])
    assert np.isnan(typical_errors(errors[1:])[1])
    assert np.isnan(typical_errors(squared_errors([], [], 2))).all()


def test_shares_fall_with_a_power_of_the_error():
    assert inverse_power_weights(np.array([1.0, 2.0, 4.0]), power=3, max_ratio=3, min_error_mm=0.1).tolist() == [
        1,
        0.125,
        0,
    ]
    assert inverse_power_weights(np.array([1e-9, 0.1, NAN]), power=3, max_ratio=3, min_error_mm=0.1).tolist() == [
        1,
        1,
        0,
    ]
    assert inverse_power_weights(np.array([NAN, NAN]), power=3, max_ratio=3, min_error_mm=0.1).tolist() == [1, 1]


def test_the_scale_lies_between_the_belief_and_what_was_found():
    assert deviation_scale(np.array([]), 2) == 1
    assert deviation_scale(np.array([NAN]), 0) == 1
    assert deviation_scale(np.array([4.0, NAN, 6.0]), 2) == pytest.approx(np.sqrt(12 / 4))
    assert deviation_scale(np.array([4.0, 6.0]), 0) == pytest.approx(np.sqrt(5))


def test_members_that_state_nothing_err_when_the_others_do():
    stated = np.array([[1.0, 2.0], [NAN, NAN], [NAN, NAN]])
    typical = np.sqrt(3) * np.array([1.5, 3.0, NAN])
    found = expected_errors(stated, typical, np.full((3, 2), 1 / 3))
    assert found[0].tolist() == [1, 2]
    assert found[1] == pytest.approx([2, 4])
    assert found[2] == pytest.approx([2, 4])


def test_where_nobody_states_an_error_the_usual_one_stands():
    found = expected_errors(np.full((2, 3), NAN), np.sqrt(3) * np.array([1.0, 2.0]), np.full((2, 3), 0.5))
    assert found == pytest.approx(np.array([[1.0] * 3, [2.0] * 3]))
    assert np.isnan(expected_errors(np.full((1, 2), NAN), np.array([NAN]), np.ones((1, 2)))).all()
