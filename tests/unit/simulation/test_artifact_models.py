"""Artifacts have the shape of their class and lengths and amplitudes of their distributions."""

import numpy as np
import pytest

from markermend.simulation.artifact_models import SHAPES, Recipe, draw_change, integers, normal, poisson, shape, uniform


@pytest.mark.parametrize("kind", SHAPES)
def test_shapes(kind):
    for length in (1, 2, 5, 50):
        trajectory = shape(kind, length)
        assert trajectory.max() == 1
        assert trajectory.min() > 0
        if kind == "tails":
            assert (np.diff(trajectory) > 0).all()
        else:
            np.testing.assert_allclose(trajectory, trajectory[::-1])
    if kind == "slow":
        assert np.ptp(np.diff(trajectory)[:24]) < 1e-12


@pytest.mark.parametrize(
    ("draw", "mean", "least", "most"),
    [
        (uniform(2.0, 4.0), 3.0, 2.0, 4.0),
        (integers(1, 5), 3.0, 1, 5),
        (normal(10.0, 2.0), 10.0, 0.0, 20.0),
        (poisson(50.0), 50.0, 1, 90),
    ],
)
def test_draws(draw, mean, least, most):
    rng = np.random.default_rng(6)
    values = np.array([draw(rng) for _ in range(2000)])
    assert values.mean() == pytest.approx(mean, rel=0.03)
    assert least <= values.min() and values.max() <= most


@pytest.mark.parametrize("axes", [1, 2, 3])
def test_a_change_has_its_amplitude_along_as_many_axes_as_asked(axes):
    change, amplitude = draw_change("steps", Recipe(lambda _: 8.0, lambda _: 1, axes), 40, np.random.default_rng(2))
    assert np.count_nonzero(amplitude) == axes and np.linalg.norm(amplitude) == pytest.approx(8.0)
    np.testing.assert_allclose(change, np.broadcast_to(amplitude, (40, 3)))
