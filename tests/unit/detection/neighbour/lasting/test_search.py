"""The search agrees with regressions in which every course is a column of its own."""

import numpy as np
import pytest

from markermend.detection.neighbour.lasting.search import DisplacementSearch, _Grid
from markermend.options.detection.displacement import DisplacementOptions
from markermend.prediction.lasting_displacement.course import Course, rise
from markermend.prediction.lasting_displacement.displacement import estimate
from markermend.prediction.local_ridge.model import TrainingSet
from support.naive import lasting

RATE, RIDGE = 50.0, 0.01


def data(course, vector=(6.0, -2.0, 3.0), *, frames=500, seed=0):
    """Two neighbours that move, and a marker that follows them, with 0.3 mm of noise and a displacement."""
    rng = np.random.default_rng(seed)
    time_s = np.arange(frames) / RATE
    pose = np.sin(time_s[:, None] * rng.uniform(2, 9, 6) + rng.uniform(0, 6, 6)) * rng.uniform(2, 9, 6)
    local = pose @ rng.normal(0, 0.3, (6, 3)) + rng.normal(0, 0.3, (frames, 3)) + course.at(time_s)[:, None] * vector
    columns = np.concatenate([pose, local], axis=1)
    return TrainingSet(
        np.arange(2), np.arange(2), np.zeros((2, 3)), np.zeros(9), columns, np.ones(frames), np.arange(frames)
    )


@pytest.mark.parametrize("course", [Course(4.0), Course(3.0, stop_s=7.0), Course(6.0, rise_s=2.0)])
def test_the_course_and_the_vector_are_found(course):
    own = data(course)
    found = DisplacementSearch(RATE, RIDGE, DisplacementOptions()).best(own, np.zeros((500, 0)))
    assert found.course.middle_s == pytest.approx(course.middle_s, abs=0.2)
    assert found.course.rise_s == course.rise_s
    assert found.course.stop_s == pytest.approx(course.stop_s, abs=0.2)
    assert found.vector == pytest.approx([6, -2, 3], abs=0.3)
    assert found.explained > 0.9
    assert 0 < found.error_mm < 0.5


def test_what_is_known_is_not_found_again():
    own, course = data(Course(4.0)), Course(4.0)
    known = course.at(own.training / RATE)[:, None]
    assert DisplacementSearch(RATE, RIDGE, DisplacementOptions()).best(own, known) is None


def test_too_short_a_recording_has_no_two_sides():
    own = data(Course(0.2), frames=25)
    assert DisplacementSearch(RATE, RIDGE, DisplacementOptions()).best(own, np.zeros((25, 0))) is None


@pytest.mark.parametrize("course", [Course(4.0), Course(3.0, stop_s=7.0), Course(6.0, rise_s=2.0)])
def test_an_estimate_is_that_of_a_whole_regression(course):
    own = data(Course(4.0))
    found = estimate(own, course, rate=RATE, ridge=RIDGE, options=DisplacementOptions())
    column = course.at(own.training / RATE)
    gain, total, vector = lasting.explained(own.target, own.local[:, :-3], column, found.weights, ridge=RIDGE)
    assert found.vector == pytest.approx(vector, rel=1e-6)
    assert found.explained == pytest.approx(gain / total, rel=1e-6)


def test_all_courses_are_compared_as_whole_regressions_would():
    own, search = data(Course(4.0)), DisplacementSearch(RATE, RIDGE, DisplacementOptions(moments=5))
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
