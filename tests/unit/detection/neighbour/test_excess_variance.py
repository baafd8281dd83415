"""Excess variance in a band of frequencies: what a marker makes alone, sustained, and above what is usual of it."""

import numpy as np
import pytest

from markermend.detection.neighbour import excess_variance
from markermend.options.detection.noise import JitterOptions, WobbleOptions
from markermend.prediction.scene import Scene

RATE = 100.0
NEAR = [np.delete(np.arange(6), m) for m in range(6)]


@pytest.fixture
def still():
    """The residual of six markers that rest: 0.2 mm of white noise."""
    return np.random.default_rng(1).normal(0, 0.2, (1000, 6, 3))


def find(residual, positions=None):
    """The stretches of jitter of each marker."""
    scene = Scene(residual if positions is None else positions, RATE, NEAR)
    return excess_variance.jitter_detector(scene, JitterOptions()).find(residual)


def find_wobble(residual):
    """The stretches of wobble of each marker."""
    return excess_variance.wobble_detector(Scene(residual, RATE, NEAR), WobbleOptions()).find(residual)


def test_nothing_is_found_where_all_is_as_usual(still):
    assert not any(find(still))


def test_a_stretch_of_jitter_is_found_and_no_shorter_one(still):
    still[400:480, 2] += np.random.default_rng(2).normal(0, 2.0, (80, 3))
    still[700:706, 4] += np.random.default_rng(3).normal(0, 2.0, (6, 3))
    found = find(still)
    assert [len(own) for own in found] == [0, 0, 1, 0, 0, 0]
    assert 390 <= found[2][0].start <= 400 and 480 <= found[2][0].stop <= 490
    assert found[2][0].score > 1


def test_what_is_in_the_residual_alone_belongs_to_a_neighbour(still):
    positions = still.copy()
    still[400:480, 2] += np.random.default_rng(2).normal(0, 2.0, (80, 3))
    assert not any(find(still, positions))


def test_the_residuals_of_neighbours_excuse_nobody(still):
    """In a small rigid group the noise of one marker is in the residuals of all."""
    positions = still.copy()
    noise = np.random.default_rng(2).normal(0, 3.0, (80, 3))
    positions[400:480, 2] += noise
    still[400:480, 2] += noise
    still[400:480, [0, 1, 3, 4, 5]] -= 0.5 * noise[:, None]
    assert [len(own) for own in find(still, positions)] == [0, 0, 1, 0, 0, 0]


def test_a_marker_that_shakes_with_a_neighbour_is_excused(still):
    positions = still.copy()
    noise = np.random.default_rng(2).normal(0, 3.0, (80, 3))
    positions[400:480, [1, 2]] += noise[:, None]
    still[400:480, 2] += noise
    assert not any(find(still, positions))


@pytest.mark.parametrize(("size", "length"), [(20.0, 15), (400.0, 15), (60.0, 40), (400.0, 4)])
def test_a_displacement_is_no_shaking_however_large(still, size, length):
    """Two jumps have power in every band, but the frames between them are as quiet as any."""
    still[400 : 400 + length, 2, 0] += size
    assert not any(find(still)) and not any(find_wobble(still))


@pytest.mark.parametrize("size", [30.0, 300.0, 3000.0])
def test_a_displacement_in_a_short_recording_is_no_shaking(still, size):
    """The threshold is lowest there, and the prediction of the marker is worse while it is displaced."""
    short = still[:150]
    short[75:90, 2] += np.random.default_rng(3).normal([size, 0.0, 0.0], size / 40, (15, 3))
    assert not any(find_wobble(short)) and not any(find(short))


def test_wobble_is_found_in_its_band(still):
    wave = 4 * np.sin(2 * np.pi * 8.0 * np.arange(120) / RATE)
    still[400:520, 1, 2] += wave
    found = find_wobble(still)
    assert [len(own) for own in found] == [0, 1, 0, 0, 0, 0]
    assert abs(found[1][0].start - 400) <= 20 and abs(found[1][0].stop - 520) <= 20
    assert found[1][0].axes.argmax() == 2


def test_wobble_is_found_that_lasts_more_than_half_of_a_short_recording(still):
    still[30:150, 1, 2] += 2 * np.sin(2 * np.pi * 8.0 * np.arange(120) / RATE)
    assert [len(own) for own in find_wobble(still[:200])] == [0, 1, 0, 0, 0, 0]


def test_the_threshold_rises_with_the_length_of_the_recording(still):
    wobble = np.concatenate([np.zeros(100), np.sin(2 * np.pi * 8.0 * np.arange(120) / RATE), np.zeros(100)])
    longer = np.random.default_rng(2).normal(0, 0.2, (20000, 6, 3))
    still[:320, 1, 2] += 1.5 * wobble
    longer[:320] = still[:320]
    # Larger than the smallest wobble that counts, whatever the recording.
    (short,), (long,) = find_wobble(10 * still[:320])[1], find_wobble(10 * longer)[1]
    assert long.score < short.score


@pytest.mark.parametrize("seed", range(5))
def test_wobble_of_several_frequencies_along_all_axes_is_found(still, seed):
    """Waves of different frequencies beat: their size varies, and no frequency has most of the power."""
    rng, time = np.random.default_rng(seed), np.arange(120) / RATE
    frequency, phase = rng.uniform(5, 12, (4, 1, 3)), rng.uniform(0, 2 * np.pi, (4, 1, 3))
    still[400:520, 1] += np.sin(2 * np.pi * frequency * time[:, None] + phase).sum(axis=0)
    assert [len(own) for own in find_wobble(still)] == [0, 1, 0, 0, 0, 0]


def test_there_is_no_wobble_above_half_of_the_rate():
    scene = Scene(np.zeros((300, 2, 3)), 25.0, [np.array([1]), np.array([0])])
    assert excess_variance.wobble_detector(scene, WobbleOptions()) is None
