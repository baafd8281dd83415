"""The recordings of the experiments: synthetic ones, and the beginnings of given ones."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.evaluation.recordings import begin, denoise, size, synthetic
from markermend.evaluation.synthetic_options import SyntheticOptions


def test_a_synthetic_recording_is_complete_and_always_the_same():
    options = SyntheticOptions(duration_s=2)
    one, again, other = (synthetic(name, options, seed=1) for name in ("walk", "walk", "sit"))
    assert one.positions.shape == (200, 51, 3) and not np.isnan(one.positions).any()
    assert np.array_equal(one.positions, again.positions) and not np.array_equal(one.positions, other.positions)


def test_the_beginning_has_the_markers_that_are_seen(walker):
    recording = walker.recording
    positions = recording.positions.copy()
    positions[:150, 3] = np.nan
    given = replace(recording, positions=positions, unlabelled={"*1": positions[:, 0]})
    kept = begin(given, duration=1.5)
    assert kept.frames == 150 and kept.markers == recording.markers[:3] + recording.markers[4:] and not kept.unlabelled
    assert begin(given, duration=None).positions.shape == positions.shape


def test_the_size_of_a_recording(walker):
    row = size("walk", walker.recording).iloc[0]
    assert row["duration_s"] == pytest.approx(12) and row["markers"] == 51 and row["missing_percent"] == 0
    steps = np.linalg.norm(np.diff(walker.recording.positions, axis=0), axis=2)
    assert row["mean_speed_m_per_s"] == pytest.approx(steps.mean() / 10)


def test_noise_is_removed_and_motion_is_not(walker):
    recording = walker.recording
    noisy = replace(recording, positions=recording.positions + np.random.default_rng(0).normal(0, 1, recording.positions.shape))  # fmt: skip
    left = denoise(noisy, cutoff_hz=6).positions
    roughness = [np.diff(positions, 2, axis=0).std() for positions in (noisy.positions, left)]
    assert roughness[1] < 0.3 * roughness[0]
    assert np.sqrt(((left - recording.positions) ** 2).mean()) < 1  # the noise was 1 mm


def test_nothing_is_removed_without_a_frequency(walker):
    assert denoise(walker.recording, cutoff_hz=None) is walker.recording
