"""Constraints in time and on distances against projections one by one."""

import numpy as np
import pytest

from markermend.filling.constraints import constrain_spacing, constrain_time
from markermend.numerics.kernel_density import kernel_density

RNG = np.random.default_rng(8)


def naive_spacing(position, references, shells, rounds):
    """tits2018 eq 25-27 for one frame: one projection after the other."""
    placed = position.copy()
    for _ in range(rounds):
        for reference, (inner, outer) in zip(references, shells, strict=True):
            distance = np.linalg.norm(placed - reference)
            if distance < inner:
                placed = reference + (placed - reference) * inner / distance
            elif distance > outer:
                placed = reference + (placed - reference) * outer / distance
    return placed


@pytest.fixture
def distances():
    return [np.random.default_rng(8).normal(100 + 40 * j, 3 + j, 300) for j in range(3)]


def test_the_time_constraint_is_the_ramp_of_the_paper():
    predicted, borders = RNG.normal(size=(7, 3)), RNG.normal(size=(2, 3))
    found = constrain_time(predicted, borders)
    for n in range(7):
        first, last = predicted[0] - borders[0], predicted[-1] - borders[1]
        assert np.allclose(found[n], predicted[n] - (first + n / 6 * (last - first)))
    assert np.allclose(found[[0, -1]], borders)


def test_at_an_end_of_the_recording_the_offset_is_constant():
    predicted = RNG.normal(size=(7, 3))
    borders = np.array([[np.nan] * 3, [1.0, 2, 3]])
    found = constrain_time(predicted, borders)
    assert np.allclose(found - predicted, borders[1] - predicted[-1])
    assert np.array_equal(constrain_time(predicted, np.full((2, 3), np.nan)), predicted)


def test_spacing_equals_single_projections(distances):
    densities = [kernel_density(sample, max_samples=1000) for sample in distances]
    shells = [density.quantiles((0.01, 0.99)) for density in densities]
    references = RNG.normal(0, 5, (40, 3, 3)) + np.diag([100.0, 140.0, 180.0])
    positions = RNG.normal(0, 25, (40, 3))
    before = positions.copy()
    found = constrain_spacing(positions, references, densities, low=0.01, high=0.99, rounds=5)
    assert np.array_equal(positions, before)
    for n in range(40):
        assert np.allclose(found[n], naive_spacing(positions[n], references[n], shells, 5), atol=1e-6)


def test_usual_positions_are_left_alone(distances):
    densities = [kernel_density(distances[0], max_samples=1000)]
    references = np.zeros((5, 1, 3))
    positions = np.tile([100.0, 0, 0], (5, 1))
    positions[3] = [150.0, 0, 0]
    found = constrain_spacing(positions, references, densities, low=0.05, high=0.95, rounds=1)
    assert np.array_equal(found[[0, 1, 2, 4]], positions[[0, 1, 2, 4]])
    assert found[3, 0] == pytest.approx(densities[0].quantiles((0.95,))[0])
