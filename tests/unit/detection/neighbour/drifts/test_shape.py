"""The shape of a drift: where it begins and ends, its height, and the baseline beside it."""

import numpy as np
import pytest

from markermend.detection.neighbour.drifts import shape as drift_shape
from markermend.numerics.matched_filter import raised_cosine


def drift(start, stop, height=(6.0, 0, 8), frames=600, seed=0):
    residual = np.random.default_rng(seed).normal(0, 0.2, (frames, 3))
    residual[start:stop] += raised_cosine((np.arange(stop - start) + 0.5) / (stop - start))[:, None] * height
    return residual


@pytest.mark.parametrize(("start", "stop"), [(200, 280), (230, 350), (150, 210)])
@pytest.mark.parametrize("length", [70, 100])
def test_the_extent_is_fitted_from_a_template_of_another_length(start, stop, length):
    peak = (start + stop) // 2 + 5
    first, last = drift_shape.fit_extent(drift(start, stop), peak, length, flank=0.5)
    assert abs(first - start) <= 0.16 * (stop - start)
    assert abs(last - stop) <= 0.16 * (stop - start)


def test_a_drift_of_a_third_of_the_length_of_the_template_is_fitted_tightly():
    first, last = drift_shape.fit_extent(drift(230, 255), 240, 77, flank=0.5)
    assert abs(first - 230) <= 5
    assert abs(last - 255) <= 5


def test_gaps_do_not_disturb_the_fit():
    residual = drift(200, 280)
    residual[228:234] = np.nan
    first, last = drift_shape.fit_extent(residual, 240, 80, flank=0.5)
    assert abs(first - 200) <= 10 and abs(last - 280) <= 10


def test_the_height_is_that_of_the_middle_above_both_sides():
    residual = drift(200, 290) + np.array([50.0, -20, 7])
    assert drift_shape.height(residual, 200, 290, flank=0.5) == pytest.approx(9.3, abs=0.5)
    displaced = drift_shape.displacement(residual, 200, 290, flank=0.5)
    np.testing.assert_allclose(displaced / np.linalg.norm(displaced), [0.6, 0, 0.8], atol=0.05)
    residual[290:] = np.nan
    assert np.isnan(drift_shape.height(residual, 200, 290, flank=0.5))


def test_on_either_side_of_a_drift_the_residual_is_at_its_baseline_or_not():
    residual = drift(200, 290)
    assert drift_shape.baseline_deviation(residual, 200, 290, flank=0.5) < 0.5
    assert drift_shape.baseline_deviation(residual, 215, 260, flank=0.5) > 3


def test_the_median_is_that_of_complete_samples():
    values = np.array([[1.0, 2], [np.nan, 9], [3, 8], [5, 5]])
    assert drift_shape.known_median(values).tolist() == [3, 5]
    assert np.isnan(drift_shape.known_median(values[1:2])).all()
