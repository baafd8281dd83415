"""Sudden displacements: sizes and durations as stated, flicker of two levels."""

import numpy as np
import pytest

from markermend.simulation import displacement_shapes
from support.faults import site

BOUNDS = {
    displacement_shapes.plateau_with_ramps: ((4, 21), (5, 30)),
    displacement_shapes.sagging_dip: ((4, 21), (5, 38)),
    displacement_shapes.random_telegraph: ((30, 200), (5, 20)),
    displacement_shapes.alternating_blocks: ((30, 200), (4.5, 22)),
    displacement_shapes.constant_offset: ((20, 150), (10, 25)),
    displacement_shapes.uneven_offset: ((20, 150), (10, 33)),
    displacement_shapes.half_sine: ((1, 5), (5.9, 14.1)),
    displacement_shapes.uneven_peak: ((1, 5), (5.9, 14.1)),
    displacement_shapes.constant_jump: ((1, 30), (30, 150)),
    displacement_shapes.distant_jump: ((1, 30), (1000, 5000)),
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


def test_flicker_has_two_levels():
    size = np.linalg.norm(displacement_shapes.random_telegraph(site()), axis=1)
    assert len(np.unique(size.round(6))) == 2
    blocks = np.linalg.norm(displacement_shapes.alternating_blocks(site()), axis=1)
    assert 0.2 < (blocks == 0).mean() < 0.8
    assert np.ptp(blocks[blocks > 0]) < 0.25 * blocks.max()
