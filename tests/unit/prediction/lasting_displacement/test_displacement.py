"""The displacement of a given course is that of one regression on pose and course."""

import pytest

from markermend.options.detection.displacement import DisplacementOptions
from markermend.prediction.lasting_displacement.course import Course
from markermend.prediction.lasting_displacement.displacement import estimate
from support.naive import lasting
from support.training_sets import RATE, RIDGE, displaced_marker


@pytest.mark.parametrize("course", [Course(4.0), Course(3.0, stop_s=7.0), Course(6.0, rise_s=2.0)])
def test_an_estimate_is_that_of_a_whole_regression(course):
    own = displaced_marker(Course(4.0))
    found = estimate(own, course, rate=RATE, ridge=RIDGE, options=DisplacementOptions())
    column = course.at(own.training / RATE)
    gain, total, vector = lasting.explained(own.target, own.local[:, :-3], column, found.weights, ridge=RIDGE)
    assert found.vector == pytest.approx(vector, rel=1e-6)
    assert found.explained == pytest.approx(gain / total, rel=1e-6)
