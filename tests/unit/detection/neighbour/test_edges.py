"""Edges: jumps of known size, where they are and beside gaps."""

import numpy as np
import pytest

from markermend.detection.neighbour import edges
from markermend.numerics.window_covariance import fit_window_covariance
from support.residuals import STEPS, rough, step_statistics
from support.signals import RATES


def test_a_step_has_the_amplitude_that_it_was_given():
    size, at = 16, np.arange(16)
    covariance = fit_window_covariance(
        rough(2000, 9)[:, None].cumsum(axis=0), size=size, order=2, shrinkage=0.01, max_windows=5000
    )
    filters = edges.step_filters(covariance, size, (4, 8))
    window = 0.1 * at**2 - at + 3.0 + 5 * (at >= 8)
    assert filters.weights[1] @ window == pytest.approx(5)
    other, own = filters.misfit(np.array([window, window])[:, None], np.array([0, 1]))
    assert own == pytest.approx(0, abs=1e-3)
    assert other > 0.3


@pytest.mark.parametrize("rate", RATES)
def test_edges_are_found_where_they_are_and_next_to_gaps(rate):
    residual = rough(400, 5)
    residual[100:] += [3, 4, 0]
    residual[200:] -= [3, 4, 0]
    residual[3:] += [0, 6, 0]
    found = edges.find_edges(step_statistics(residual, residual, rate), 0, rate=rate, options=STEPS)
    assert [edge.frame for edge in found] == [3, 100, 200]
    np.testing.assert_allclose(found[1].jump, [3, 4, 0], atol=0.3)


def test_weak_edges_are_found_with_a_part_of_the_threshold():
    residual = rough(400, 5)
    residual[100:] += [1.4, 0, 0]
    statistics = step_statistics(residual, residual, 100.0)
    assert edges.find_edges(statistics, 0, rate=100.0, options=STEPS) == []
    [edge] = edges.find_edges(statistics, 0, rate=100.0, options=STEPS, fraction=0.6)
    assert edge.frame == 100 and 0.6 < edge.score < 1


@pytest.mark.parametrize("ramp", [1, 2, 3])
def test_a_jump_with_a_ramp_is_one_edge_without_sidelobes(ramp):
    residual = rough(400, 5)
    residual += np.clip((np.arange(400) - 200 + 1) / (ramp + 1), 0, 1)[:, None] * [12, 16, 0]
    [edge] = edges.find_edges(step_statistics(residual, residual, 100.0), 0, rate=100.0, options=STEPS, fraction=0.6)
    assert (edge.frame, edge.ramp) == (200, ramp)
    np.testing.assert_allclose(edge.jump, [12, 16, 0], atol=1)
