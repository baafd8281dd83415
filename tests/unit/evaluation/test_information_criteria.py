"""Information criteria: by hand, and their difference."""

import math

import pytest

from markermend.evaluation.information_criteria import akaike, bayesian


def test_criteria_are_those_of_the_equations():
    assert akaike(math.e**2, 50, 7) == pytest.approx(100 + 14)
    assert bayesian(math.e**2, 50, 7) == pytest.approx(100 + 7 * math.log(50))


def test_the_bayesian_criterion_asks_more_of_a_parameter_from_eight_samples_on():
    for samples, more in ((7, False), (8, True)):
        assert (bayesian(3.0, samples, 100) > akaike(3.0, samples, 100)) == more
