"""Drifts: sizes and durations as stated, from nothing to nothing."""

import numpy as np
import pytest

from markermend.simulation import drift_shapes
from support.faults import site

BOUNDS = {
    drift_shapes.raised_cosine(1.0, 2.0, 10.0): ((100, 200), (9.9, 10)),
    drift_shapes.skewed_bump(1.0, 2.0, 10.0): ((100, 200), (9.9, 10.0001)),
}
"""Bounds of durations in frames and of sizes in mm."""


@pytest.mark.parametrize("shape", BOUNDS)
def test_durations_and_sizes(shape):
    (shortest, longest), (low, high) = BOUNDS[shape]
    for seed in range(30):
        change = shape(site(seed))
        assert change.shape == (len(change), 3)
        assert shortest <= len(change) <= longest
        assert low <= np.linalg.norm(change, axis=1).max() <= high


def test_drifts_begin_and_end_near_zero():
    for shape in (drift_shapes.raised_cosine(1.0, 1.0, 10.0), drift_shapes.skewed_bump(1.0, 1.0, 10.0)):
        size = np.linalg.norm(shape(site()), axis=1)
        assert max(size[0], size[-1]) < 0.5
        assert np.abs(np.diff(size)).max() < 0.5
