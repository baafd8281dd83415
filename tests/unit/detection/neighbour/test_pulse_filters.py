"""Matched filters of pulses: innovations are those of fitted polynomials, and a wave has the amplitude that it was given."""

import numpy as np
import pytest

from markermend.detection.neighbour import pulse_filters
from markermend.numerics.window_covariance import WindowCovariance, fit_window_covariance
from support.residuals import rough


@pytest.mark.parametrize("offset", [0, 3, 6, 12])
def test_with_independent_samples_the_innovation_is_that_of_a_fitted_polynomial(offset):
    window = np.random.default_rng(1).normal(0, 1, 16)
    independent, inside = WindowCovariance(np.eye(16), 3), np.arange(offset, offset + 4)
    others = np.setdiff1d(np.arange(16), inside)
    fit = np.polyfit(others, window[others], 3)
    off = window - np.polyval(fit, np.arange(16))
    np.testing.assert_allclose(pulse_filters.innovation_map(independent, 4, 16, offset) @ window, off[inside])
    filters = pulse_filters.pulse_filters(independent, 4, 16, (offset,))
    basis = np.linalg.qr(np.vander(np.linspace(-1, 1, 16), 4))[0]
    unit = 1 - (basis[8] ** 2).sum()  # how well the middle sample follows from the others
    [misfit] = filters.misfit(window[None, None], np.array([0]))
    assert misfit**2 == pytest.approx((off[others] ** 2).sum() / unit / (16 - 4 - 4))


def test_a_wave_has_the_amplitude_that_it_was_given():
    size, at = 16, np.arange(16)
    covariance = fit_window_covariance(
        rough(2000, 9)[:, None].cumsum(axis=0), size=size, order=2, shrinkage=0.01, max_windows=5000
    )
    wave = np.sin(np.pi * (np.arange(5) + 0.5) / 5)
    for offset in (0, 6, 11):
        filters = pulse_filters.pulse_filters(covariance, 5, size, (offset,))
        window = 0.1 * at**2 - at + 3.0
        window[offset : offset + 5] += 4 * wave
        assert filters.weights[0] @ window == pytest.approx(4)
        assert filters.misfit(window[None, None], np.array([0])) == pytest.approx(0, abs=1e-3)
