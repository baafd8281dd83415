"""The search agrees with regressions in which every course is a column of its own."""

import numpy as np
import pytest

from markermend.detection.neighbour.lasting.search import DisplacementSearch, _Grid
from markermend.options.detection.displacement import DisplacementOptions
from markermend.prediction.lasting_displacement.course import Course, rise
from support.naive import lasting
from support.training_sets import RATE, RIDGE, displaced_marker


@pytest.mark.parametrize("course", [Course(4.0), Course(3.0, stop_s=7.0), Course(6.0, rise_s=2.0)])
def test_the_course_and_the_vector_are_found(course):
    own = displaced_marker(course)
    found = DisplacementSearch(RATE, RIDGE, DisplacementOptions()).best(own, np.zeros((500, 0)))
    assert found.course.middle_s == pytest.approx(course.middle_s, abs=0.2)
    assert found.course.rise_s == course.rise_s
    assert found.course.stop_s == pytest.approx(course.stop_s, abs=0.2)
    assert found.vector == pytest.approx([6, -2, 3], abs=0.3)
    assert found.explained > 0.9
    assert 0 < found.error_mm < 0.5


def test_what_is_known_is_not_found_again():
    own, course = displaced_marker(Course(4.0)), Course(4.0)
    known = course.at(own.training / RATE)[:, None]
    assert DisplacementSearch(RATE, RIDGE, DisplacementOptions()).best(own, known) is None


def test_too_short_a_recording_has_no_two_sides():
    own = displaced_marker(Course(0.2), frames=25)
    assert DisplacementSearch(RATE, RIDGE, DisplacementOptions()).best(own, np.zeros((25, 0))) is None


def test_all_courses_are_compared_as_whole_regressions_would():
    own, search = displaced_marker(Course(4.0)), DisplacementSearch(RATE, RIDGE, DisplacementOptions(moments=5))
    time_s, middles, weights = own.training / RATE, np.linspace(1, 9, 5), np.random.default_rng(1).uniform(0.2, 1, 500)
    courses = [rise(time_s, middles, duration) for duration in (0.0, 2.0)]
    fast = search._explained(_Grid(own, np.zeros((500, 0)), middles, 1.0, 1.0), weights, courses)

    def slow(column):
        return lasting.explained(own.target, own.local[:, :-3], column, weights, ridge=RIDGE)[:2]

    assert fast.total == pytest.approx(slow(courses[0][:, 0])[1])
    for found, column in zip(fast.rises, np.concatenate(courses, axis=1).T, strict=True):
        assert found == pytest.approx(slow(column)[0], rel=1e-6)
    for first, last in ((0, 2), (1, 4), (3, 0)):
        assert fast.returns[first, last] == pytest.approx(slow(courses[0][:, first] - courses[0][:, last])[0], rel=1e-6)
