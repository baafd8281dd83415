"""Stacked networks: against a plain twin, their gradient against differences, and stacks of unequal data."""

import numpy as np
import pytest

from markermend.prediction.lagged_regression import feed_forward
from markermend.prediction.lagged_regression.feed_forward import Stack, activations, initial, loss, mean_output, split
from support.naive import prediction as naive

SIZES = (7, 5, 4, 6)


@pytest.fixture
def networks():
    """Three networks: parameters, rows, targets of three values (twice in the output), weights."""
    rng = np.random.default_rng(3)
    parameters = np.stack([initial(SIZES, rng=rng) for _ in range(3)])
    return parameters, rng.normal(size=(3, 20, 7)), rng.normal(size=(3, 20, 3)), rng.uniform(size=(3, 20, 3))


def test_the_first_units_bend_at_places_spread_over_the_inputs():
    layers = split(initial((6, 8, 3), rng=np.random.default_rng(0))[None], (6, 8, 3))
    weights, offsets = layers[0][0][0], layers[0][1][0, 0]
    length = 0.7 * 8 ** (1 / 6)
    assert np.allclose(np.linalg.norm(weights, axis=0), length)
    assert np.allclose(np.sort(np.abs(offsets)), np.sort(np.abs(length * np.linspace(-1, 1, 8))))
    assert np.abs(layers[1][0]).max() <= 1


def test_each_network_says_what_its_plain_twin_says(networks):
    parameters, rows, _, _ = networks
    said = activations(parameters, SIZES, rows)[-1]
    for k in range(3):
        for n in range(20):
            assert said[k, n] == pytest.approx(naive.feed_forward(parameters[k], SIZES, rows[k, n]))
    assert np.allclose(mean_output(parameters, SIZES, rows, size=3), (said[..., :3] + said[..., 3:]) / 2)


def test_the_gradient_is_what_small_differences_say(networks):
    parameters, rows, target, weight = networks
    value, gradient = loss(parameters, SIZES, rows, target, weight)
    said = activations(parameters, SIZES, rows)[-1].reshape(3, 20, 2, 3)
    expected = ((said - target[:, :, None]) ** 2).mean(axis=2) / 2
    assert np.allclose(value, (expected * weight).sum(axis=(1, 2)))
    for place in range(0, parameters.shape[1], 3):
        ahead, behind = parameters.copy(), parameters.copy()
        ahead[:, place] += 1e-5
        behind[:, place] -= 1e-5
        steps = [loss(moved, SIZES, rows, target, weight)[0] for moved in (ahead, behind)]
        assert np.allclose(gradient[:, place], (steps[0] - steps[1]) / 2e-5, atol=1e-7)


@pytest.mark.parametrize("cached", [1, 300, 10**9])
def test_a_stack_of_unequal_data_is_as_each_alone(networks, monkeypatch, cached):
    monkeypatch.setattr(feed_forward, "CACHED", cached)
    parameters, rows, target, _ = networks
    counts = (20, 5, 12)
    units = np.array([[1, 0.5, 0.1], [0.2, 1, 1], [1, 1, 0.3]])
    stack = Stack([(rows[k, :n], target[k, :n]) for k, n in enumerate(counts)], SIZES, units)
    for which in ([0, 1, 2], [0, 2], [1]):
        value, gradient = stack.loss(parameters[which], np.array(which))
        error = stack.error(parameters[which], np.array(which))
        for place, k in enumerate(which):
            n, one = counts[k], slice(k, k + 1)
            alone = loss(parameters[one], SIZES, rows[one, :n], target[one, :n], np.tile(units[k] ** 2 / n, (1, n, 1)))
            assert value[place] == pytest.approx(alone[0][0])
            assert np.allclose(gradient[place], alone[1][0])
            off = mean_output(parameters[one], SIZES, rows[one, :n], size=3)[0] - target[k, :n]
            assert error[place] == pytest.approx(((off * units[k]) ** 2).sum(axis=1).mean())
