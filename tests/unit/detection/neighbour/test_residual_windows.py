"""Matched filters on residual windows, against generalised least squares window by window."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.detection.neighbour import edges, pulse_filters, pulses, residual_windows
from markermend.numerics.window_covariance import WindowCovariance
from support.naive import residual_windows as naive
from support.residuals import PEAKS, STEPS, peak_statistics, rough, step_statistics


def coloured(frames, seed):
    """A residual whose samples are correlated, with some sudden changes."""
    rng = np.random.default_rng(seed)
    noise = rng.normal(0, 1, (frames + 4, 3))
    residual = sum(noise[k : k + frames] for k in range(5)) / 3
    residual[60:63] += [9, -4, 2]
    residual[90:] += [5, 5, -7]
    return residual


@pytest.mark.parametrize("seed", range(3))
def test_steps_exceed_as_generalised_least_squares_says(seed):
    residual = coloured(150, seed)
    positions = residual + np.random.default_rng(seed).normal(0, 0.5, residual.shape)
    low = replace(STEPS, threshold_sigmas=1.2, floor_mm=0.5)
    statistics = step_statistics(residual, positions, 100.0, low)
    size = 2 * residual_windows.context_samples(100.0, low, min_samples=edges.MIN_CONTEXT)
    offsets = (2, size // 2, size - 3)
    filters = edges.step_filters(statistics.covariance, size, offsets)
    found = residual_windows.exceedances(statistics, 0, slice(10, 140), filters, low)
    expected = {}
    for start in range(10, 140 - size + 1):
        for number, offset in enumerate(offsets):
            window, recorded = residual[start : start + size], positions[start : start + size]
            pattern = (np.arange(size) >= offset).astype(float)
            part, deviation, misfit = naive.statistic(window, recorded, pattern, statistics.covariance)
            noise = np.hypot(misfit, statistics.local_scale[start + offset, 0])
            score = part / max(1.2 * noise * deviation, 0.5)
            if score > 1:
                expected[start + offset, number] = score
    assert len(expected) > 5
    scores = dict(zip(zip(found.frame.tolist(), found.filter.tolist(), strict=True), found.score.tolist(), strict=True))
    assert scores == pytest.approx(expected)


@pytest.mark.parametrize("length", [1, 3, 5])
def test_pulses_exceed_as_generalised_least_squares_says(length):
    residual = coloured(150, 7)
    low = replace(PEAKS, threshold_sigmas=1.5, floor_mm=0.5)
    statistics = peak_statistics(residual, residual, 100.0, low)
    size = length + 2 * residual_windows.context_samples(100.0, low, min_samples=pulses.MIN_CONTEXT)
    offset = (size - length) // 2
    filters = pulse_filters.pulse_filters(statistics.covariance, length, size, (offset,))
    found = residual_windows.exceedances(statistics, 0, slice(0, 150), filters, low)
    expected = {}
    for start in range(150 - size + 1):
        pattern = np.zeros(size)
        pattern[offset : offset + length] = np.sin(np.pi * (np.arange(length) + 0.5) / length)
        window, inside = residual[start : start + size], range(offset, offset + length)
        part, deviation, misfit = naive.statistic(window, window, pattern, statistics.covariance, free=inside)
        score = part / max(1.5 * np.hypot(misfit, statistics.local_scale[start + offset, 0]) * deviation, 0.5)
        if score > 1:
            expected[start + offset] = score
    assert len(expected) > 2
    assert dict(zip(found.frame.tolist(), found.score.tolist(), strict=True)) == pytest.approx(expected)


def test_the_misfit_about_a_frame_is_that_of_the_window_around_it_or_of_the_nearest_whole_one():
    residual = coloured(60, 2)
    residual[20:22] = np.nan
    residual[40] = np.nan
    size = 12
    covariance = WindowCovariance(np.eye(size), 2)
    filters = pulse_filters.pulse_filters(covariance, 2, size, (5,))
    misfit = residual_windows.window_misfit(residual, filters)
    assert np.array_equal(np.isnan(misfit), np.isnan(residual[:, 0]))
    for start, stop in ((0, 20), (22, 40), (41, 60)):
        for frame in range(start, stop):
            first = min(max(frame - size // 2, start), stop - size)
            window = residual[first : first + size]
            pattern = np.zeros(size)
            pattern[5:7] = np.sin(np.pi * np.array([0.25, 0.75]))
            expected = naive.statistic(window, window, pattern, covariance, free=range(5, 7))[2]
            assert misfit[frame] == pytest.approx(expected)
    assert np.isnan(residual_windows.window_misfit(residual[:11], filters)).all()


@pytest.mark.parametrize(("start", "stop"), [(0, 30), (7, 19)])
def test_window_spans_look_at_each_frame_once(start, stop):
    length, context = 12, 5
    seen = [
        frame + offset
        for span, offsets in residual_windows.window_spans(start, stop, length, context)
        for frame in range(span.start, span.stop - length + 1)
        for offset in offsets
    ]
    assert sorted(seen) == list(range(start, stop))


def test_the_recorded_part_is_what_both_have_in_common():
    recorded = np.array([[3.0, 0, 0], [-3, 0, 0], [9, 0, 0], [0, 5, 0], [1, 0, 0]])
    residual = np.array([[4.0, 0, 0], [4, 0, 0], [4, 0, 0], [4, 0, 0], [0, 0, 0]])
    np.testing.assert_allclose(residual_windows.recorded_part(recorded, residual), [3, 0, 4, 0, 0])


def test_the_artifact_of_a_neighbour_is_in_the_residual_alone_and_does_not_exceed():
    residual = rough(200, 4)
    positions = residual.copy()
    residual[100:] += 10
    statistics = step_statistics(residual, positions, 100.0)
    size = 2 * residual_windows.context_samples(100.0, STEPS, min_samples=edges.MIN_CONTEXT)
    filters = edges.step_filters(statistics.covariance, size, (size // 2,))
    assert not len(residual_windows.exceedances(statistics, 0, slice(0, 200), filters, STEPS).frame)


@pytest.mark.parametrize("frames", [12, 13, 24, 150])
def test_amplitudes_of_one_filter_are_those_of_each_window(frames):
    signal = coloured(150, 4)[:frames]
    filters = edges.step_filters(WindowCovariance(np.eye(12), 2), 12, (6,))
    expected = [[window @ filters.weights[0] for window in signal[k : k + 12].T] for k in range(frames - 11)]
    np.testing.assert_allclose(filters.amplitudes(signal)[..., 0].T, expected, atol=1e-12)
