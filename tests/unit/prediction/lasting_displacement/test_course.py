"""Courses rise and end where they say, and a drift exceeds one half between its times."""

import numpy as np
import pytest

from markermend.prediction.lasting_displacement.course import Course, bump

TIME = np.arange(0, 10, 0.01)


@pytest.mark.parametrize(
    ("course", "values"),
    [
        (Course(4.0), {3.99: 0, 4.0: 1, 9.9: 1}),
        (Course(4.0, stop_s=7.0), {3.99: 0, 6.99: 1, 7.0: 0}),
        (Course(4.0, rise_s=2.0), {2.9: 0, 4.0: 0.5, 4.5: 0.75, 5.1: 1}),
        (Course(4.0, rise_s=2.0, stop_s=7.0), {2.9: 0, 4.0: 0.5, 6.9: 1, 7.1: 0}),
    ],
)
def test_a_course_at_some_times(course, values):
    np.testing.assert_allclose(course.at(np.array(list(values))), list(values.values()), atol=1e-9)


@pytest.mark.parametrize("width", [1.0, 1.5])
def test_a_drift_exceeds_one_half_between_its_times(width):
    above = TIME[bump(TIME, 3.0, 5.0, width) > 0.5]
    assert (above[0], above[-1]) == pytest.approx((4 - width, 4 + width), abs=0.02)
    assert bump(np.array([4.0, 0.0, 9.0]), 3.0, 5.0, width).tolist() == [1.0, 0.0, 0.0]
