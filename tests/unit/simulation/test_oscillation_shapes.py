"""Shaking: sizes, durations and frequencies as stated."""

import numpy as np
import pytest

from markermend.simulation import oscillation_shapes
from support.faults import site

BOUNDS = {
    oscillation_shapes.swelling_sine: ((50, 200), (1.8, 6)),
    oscillation_shapes.band_limited_noise: ((50, 200), (2, 15)),
    oscillation_shapes.white_noise: ((30, 200), (2, 25)),
    oscillation_shapes.alternating_jumps: ((30, 200), (2, 13)),
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


@pytest.mark.parametrize("shape", [oscillation_shapes.swelling_sine, oscillation_shapes.band_limited_noise])
def test_wobble_is_between_5_and_12_hz(shape):
    for seed in range(10):
        change = shape(site(seed))
        power = (np.abs(np.fft.rfft(change, 1024, axis=0)) ** 2).sum(axis=1)
        frequency = np.fft.rfftfreq(1024, 0.01)
        assert power[(frequency > 3) & (frequency < 14)].sum() > 0.9 * power.sum()
