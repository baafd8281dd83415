"""Distances of points to others at the same time."""

from __future__ import annotations

import numpy as np

from markermend.numerics.distances import distances


def test_distances_are_those_of_each_pair() -> None:
    rng = np.random.default_rng(3)
    points, others = rng.normal(size=(5, 3)), rng.normal(size=(5, 4, 3))
    found = distances(points, others)
    for frame, other in np.ndindex(5, 4):
        difference = points[frame] - others[frame, other]
        np.testing.assert_allclose(found[frame, other], np.sqrt(difference @ difference), rtol=1e-14)


def test_distances_of_what_is_missing_are_unknown() -> None:
    points, others = np.zeros((2, 3)), np.ones((2, 2, 3))
    points[0], others[1, 0, 2] = np.nan, np.nan
    np.testing.assert_array_equal(np.isnan(distances(points, others)), [[True, True], [True, False]])


def test_no_others_have_no_distances() -> None:
    assert distances(np.zeros((2, 3)), np.zeros((2, 0, 3))).shape == (2, 0)
