"""Numbers that stand for missing samples are found where they repeat in all coordinates, far from everything."""

import numpy as np
import pytest

from markermend.formats.placeholders import find_placeholders


def positions():
    """Three markers about a metre from the origin."""
    return np.random.default_rng(0).normal(1000, 200, (50, 3, 3))


@pytest.mark.parametrize("number", [9999.0, -9999.0, 999999.0, 1e6, -1e6])
def test_repeated_numbers_are_placeholders(number):
    samples = positions()
    samples[10:14, 1] = samples[30, 2] = number
    found = find_placeholders(samples, min_distance_mm=1000)
    assert np.argwhere(found).tolist() == [[10, 1], [11, 1], [12, 1], [13, 1], [30, 2]]


def test_positions_are_no_placeholders():
    samples = positions()
    samples[3, 0] = 9999.0  # once: a coincidence
    samples[10:14, 1] = 700.0  # amid the others
    samples[20:30, 2] = (9999.0, 9999.0, 1000.0)
    samples[40:] = np.nan
    before = samples.copy()
    assert not find_placeholders(samples, min_distance_mm=1000).any()
    assert not find_placeholders(np.full((4, 2, 3), 9999.0), min_distance_mm=1000).any()
    np.testing.assert_array_equal(samples, before)
