"""Kernel densities: against the direct sum and scipy, and their tails."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import gaussian_kde

from markermend.numerics.kernel_density import kernel_density
from support.naive import numerics as naive


@pytest.fixture
def distances():
    return [np.random.default_rng(8).normal(100 + 40 * j, 3 + j, 300) for j in range(3)]


def test_density_equals_scipy(distances):
    found = kernel_density(distances[0], max_samples=1000)
    expected = gaussian_kde(distances[0], bw_method="silverman")
    points = np.linspace(80, 120, 60)
    assert np.allclose(np.exp(found.log_density(points)), expected(points))
    quantiles = found.quantiles((0.01, 0.5, 0.99))
    for point, share in zip(quantiles, (0.01, 0.5, 0.99), strict=True):
        assert expected.integrate_box_1d(-np.inf, point) == pytest.approx(share, abs=1e-6)
    assert quad(lambda x: np.exp(found.log_density(np.array(x))), 60, 140)[0] == pytest.approx(1, abs=1e-6)


def test_a_density_of_few_samples_represents_all_and_tails_do_not_vanish(distances):
    whole, part = kernel_density(distances[0], max_samples=1000), kernel_density(distances[0], max_samples=100)
    points = np.linspace(92, 108, 20)
    assert np.allclose(np.exp(whole.log_density(points)), np.exp(part.log_density(points)), atol=0.01)
    assert np.isfinite(whole.log_density(np.array([1e4]))).all()
    assert kernel_density(np.full(50, 70.0), max_samples=100).bandwidth > 0


def test_log_density_and_quantiles_equal_the_direct_sum(distances):
    found = kernel_density(distances[1], max_samples=1000)
    for point in (120.0, 140.0, 155.0):
        expected = naive.normal_density(distances[1], found.bandwidth, point)
        assert found.log_density(np.array(point)) == pytest.approx(np.log(expected), abs=1e-9)
    assert np.isnan(found.log_density(np.array([np.nan, 140.0]))).tolist() == [True, False]
