"""Information criteria: by hand, and their difference."""

import math

import numpy as np
import pytest

from markermend.evaluation.information_criteria import information_criteria


def test_criteria_are_those_of_the_equations():
    found = information_criteria(np.array([math.e**2]), np.array([50]), np.array([7]))
    assert found["aic"] == pytest.approx([100 + 14])
    assert found["bic"] == pytest.approx([100 + 7 * math.log(50)])


def test_the_bayesian_criterion_asks_more_of_a_parameter_from_eight_samples_on():
    found = information_criteria(np.full(2, 3.0), np.array([7, 8]), np.full(2, 100))
    assert (found["bic"] > found["aic"]).tolist() == [False, True]
