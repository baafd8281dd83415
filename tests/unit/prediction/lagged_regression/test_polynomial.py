"""Polynomial least squares: against the plain solution, and what a straight line cannot learn."""

import numpy as np

from markermend.prediction.lagged_regression.polynomial import powers
from markermend.prediction.lagged_regression.predictor import TrainingSet
from support.lagged import limb, quick, scene


def test_a_straight_line_does_not_learn_it():
    assert np.abs(quick("polynomial", max_power=1).residuals(scene(limb()), np.array([0]))[:, 0, 0]).max() > 2


def test_the_fit_is_least_squares_on_one_and_the_powers():
    rng = np.random.default_rng(2)
    rows, at = rng.uniform(-2, 3, (60, 4)), rng.uniform(-2, 3, (7, 4))
    target = rng.normal(size=(60, 3))
    (regression,) = quick("polynomial", max_power=3).fit([TrainingSet(rows, target, np.arange(60), 0)])
    design, design_at = (np.concatenate([np.ones((len(x), 1)), x, x**2, x**3], axis=1) for x in (rows, at))
    expected = design_at @ np.linalg.lstsq(design, target, rcond=None)[0]
    assert np.allclose(regression.predict(at), expected)
    assert np.isnan(regression.error)


def test_powers_are_the_first_to_the_highest():
    rows = np.array([[2.0, -3.0]])
    assert [power.tolist() for power in powers(rows, 3)] == [[[2, -3]], [[4, 9]], [[8, -27]]]
