"""Non-negative least squares: against scipy, and where nothing can be fitted."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import nnls

from markermend.numerics.non_negative import non_negative_least_squares


@given(st.integers(0, 500), st.integers(1, 6), st.integers(1, 30))
def test_the_fit_is_that_of_scipy(seed, columns, rows):
    rng = np.random.default_rng(seed)
    design, target = rng.normal(0, 1, (rows, columns)) + 0.5, rng.normal(0.5, 1, rows)
    found = non_negative_least_squares(design, target)
    _, least = nnls(design, target)
    assert (found >= 0).all()
    np.testing.assert_allclose(np.linalg.norm(design @ found - target), least, atol=1e-9)


def test_alike_columns_are_fitted_as_well_as_scipy_does():
    lags = np.arange(30.0)
    design = np.exp(-lags[:, None] / np.array([1.0, 1.01, 5.0, 20.0]))
    target = np.exp(-lags / 3)
    found = non_negative_least_squares(design, target)
    np.testing.assert_allclose(np.linalg.norm(design @ found - target), nnls(design, target)[1], rtol=1e-6)


def test_what_only_negative_coefficients_would_fit_gets_none():
    assert not non_negative_least_squares(np.ones((4, 2)), -np.ones(4)).any()
    assert not non_negative_least_squares(np.ones((4, 2)), np.zeros(4)).any()
