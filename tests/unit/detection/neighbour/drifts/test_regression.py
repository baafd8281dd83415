"""Drifts are estimated on means over bins."""

import numpy as np

from markermend.detection.neighbour.drifts.regression import bin_means, on_all_frames


def test_means_over_bins_are_those_of_known_values():
    values = np.array([1.0, 3, np.nan, 5, np.nan, np.nan, 7, 8, 9])
    np.testing.assert_allclose(bin_means(values, 2), [2, 5, np.nan, 7.5])


def test_values_are_put_at_their_frames():
    values = np.array([[1.0, 2], [3, 4]])
    np.testing.assert_equal(on_all_frames(values, np.array([0, 2]), 3), [[1, 2], [np.nan, np.nan], [3, 4]])
    assert on_all_frames(values, np.arange(2), 2) is values
