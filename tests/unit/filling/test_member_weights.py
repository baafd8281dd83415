"""Weights of members, scales and expected errors: against naive twins, and from numbers that can be checked by hand."""

import numpy as np
import pytest

from markermend.filling.member_weights import (
    deviation_scale,
    expected_errors,
    inverse_power_weights,
    squared_errors,
    typical_errors,
)
from support.naive.filling import expected_error

NAN = np.nan


def naive_typical_error(truths, predictions, member):
    """Root mean square distance of one member to the truth, sample by sample; NaN where it predicted none."""
    squares = []
    for truth, predicted in zip(truths, predictions, strict=True):
        for n in range(len(truth)):
            if not np.isnan(predicted[member, n]).any():
                squares.append(sum((predicted[member, n, axis] - truth[n, axis]) ** 2 for axis in range(3)))
    return np.sqrt(sum(squares) / len(squares)) if squares else np.nan


def naive_weights(typical, power, max_ratio, least):
    """Weights of members, one by one."""
    known = [max(error, least) for error in typical if error == error]
    weights = []
    for error in typical:
        if not known:
            weights.append(1.0)
        elif error != error or max(error, least) > max_ratio * min(known):
            weights.append(0.0)
        else:
            weights.append((min(known) / max(error, least)) ** power)
    return weights


@pytest.fixture(params=range(4))
def rng(request):
    return np.random.default_rng(request.param)


def test_weights_equal_the_naive_twin(rng):
    truths = [rng.normal(0, 1, (n, 3)) for n in (3, 5, 1)]
    scale = rng.uniform(0.1, 3, (5, 1, 1))
    predictions = [truth + scale * rng.normal(0, 1, (5, len(truth), 3)) for truth in truths]
    for predicted in predictions:
        predicted[rng.random(predicted.shape[:2]) < 0.3] = np.nan
        predicted[4] = np.nan
    found = typical_errors(squared_errors(truths, predictions, 5))
    expected = [naive_typical_error(truths, predictions, member) for member in range(5)]
    assert found == pytest.approx(expected, nan_ok=True)
    weights = inverse_power_weights(found, power=2.5, max_ratio=2.0, min_error_mm=0.4)
    assert weights == pytest.approx(naive_weights(expected, 2.5, 2.0, 0.4))


def test_expected_errors_equal_the_naive_twin(rng):
    stated, typical, weights = rng.uniform(0.5, 3, (5, 8)), rng.uniform(0.5, 3, 5), rng.random((5, 8))
    stated[rng.random(stated.shape) < 0.4] = np.nan
    stated[:, 3] = np.nan
    typical[[0, 3]] = np.nan
    found = expected_errors(stated, typical, weights)
    for member in range(5):
        for n in range(8):
            expected = expected_error(stated, typical, weights, member, n)
            assert found[member, n] == pytest.approx(expected, nan_ok=True)


def test_errors_are_summed_over_what_each_member_predicted():
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


def test_the_scale_lies_between_the_prior_and_the_data():
    assert deviation_scale(np.array([]), 2) == 1
    assert deviation_scale(np.array([NAN]), 0) == 1
    assert deviation_scale(np.array([4.0, NAN, 6.0]), 2) == pytest.approx(np.sqrt(12 / 4))
    assert deviation_scale(np.array([4.0, 6.0]), 0) == pytest.approx(np.sqrt(5))


def test_members_that_state_no_error_vary_as_the_others_do():
    stated = np.array([[1.0, 2.0], [NAN, NAN], [NAN, NAN]])
    typical = np.sqrt(3) * np.array([1.5, 3.0, NAN])
    found = expected_errors(stated, typical, np.full((3, 2), 1 / 3))
    assert found[0].tolist() == [1, 2]
    assert found[1] == pytest.approx([2, 4])
    assert found[2] == pytest.approx([2, 4])


def test_where_no_error_is_stated_the_typical_one_stands():
    found = expected_errors(np.full((2, 3), NAN), np.sqrt(3) * np.array([1.0, 2.0]), np.full((2, 3), 0.5))
    assert found == pytest.approx(np.array([[1.0] * 3, [2.0] * 3]))
    assert np.isnan(expected_errors(np.full((1, 2), NAN), np.array([NAN]), np.ones((1, 2)))).all()
