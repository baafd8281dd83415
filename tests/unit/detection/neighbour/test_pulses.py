"""Pulses: a few samples off the smooth trajectory, trimmed to those, and no edges, humps or noise."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.shape import Shape
from markermend.detection.neighbour import pulses
from markermend.detection.neighbour.level_evidence import LevelEvidence
from markermend.numerics.window_covariance import WindowCovariance, fit_window_covariance
from markermend.prediction.scene import Scene
from support.residuals import PEAKS, alone, peak_statistics, rough
from support.signals import RATES


@pytest.mark.parametrize("offset", [0, 3, 6, 12])
def test_with_independent_samples_the_innovation_is_that_of_a_fitted_polynomial(offset):
    window = np.random.default_rng(1).normal(0, 1, 16)
    independent, inside = WindowCovariance(np.eye(16), 3), np.arange(offset, offset + 4)
    others = np.setdiff1d(np.arange(16), inside)
    fit = np.polyfit(others, window[others], 3)
    off = window - np.polyval(fit, np.arange(16))
    np.testing.assert_allclose(pulses.innovation_map(independent, 4, 16, offset) @ window, off[inside])
    filters = pulses.pulse_filters(independent, 4, 16, (offset,))
    basis = np.linalg.qr(np.vander(np.linspace(-1, 1, 16), 4))[0]
    unit = 1 - (basis[8] ** 2).sum()  # how well the middle sample follows from the others
    [misfit] = filters.misfit(window[None, None], np.array([0]))
    assert misfit**2 == pytest.approx((off[others] ** 2).sum() / unit / (16 - 4 - 4))


def test_a_wave_has_the_amplitude_that_it_was_given():
    size, at = 16, np.arange(16)
    covariance = fit_window_covariance(
        rough(2000, 9)[:, None].cumsum(axis=0), size=size, order=2, shrinkage=0.01, max_windows=5000
    )
    wave = np.sin(np.pi * (np.arange(5) + 0.5) / 5)
    for offset in (0, 6, 11):
        filters = pulses.pulse_filters(covariance, 5, size, (offset,))
        window = 0.1 * at**2 - at + 3.0
        window[offset : offset + 5] += 4 * wave
        assert filters.weights[0] @ window == pytest.approx(4)
        assert filters.misfit(window[None, None], np.array([0])) == pytest.approx(0, abs=1e-3)


def find(statistics, *, rate=100.0, options=PEAKS, scene=None):
    longest = round(options.max_dip_duration_s * rate) + 2 * max(pulses.MIN_CONTEXT, round(options.context_s * rate))
    covariance = fit_window_covariance(statistics.residual, size=longest, order=2, shrinkage=0.01, max_windows=5000)
    scene = alone(statistics.positions[:, 0], rate) if scene is None else scene
    evidence = LevelEvidence(scene, 0, statistics.residual[:, 0], options.level, options.shape)
    return pulses.find_pulses(statistics, 0, covariance, evidence, options=options)


def test_a_dip_of_which_residual_and_distances_give_evidence_is_found_below_the_threshold():
    rng = np.random.default_rng(5)
    residual, mates = rough(400, 5), rng.normal(0, 200, (5, 3))
    residual[150:159] += np.concatenate([[0.25, 0.5, 0.75], np.ones(4), [0.67, 0.33]])[:, None] * [1.7, 0, 0]
    positions = np.concatenate([residual[:, None], np.broadcast_to(mates, (400, 5, 3))], axis=1)
    distance = np.linalg.norm(positions[0, :, None] - positions[0], axis=2)
    statistics = peak_statistics(residual, residual, 100.0)
    found = []
    for deviation in (0.5, 50.0):
        spread = np.full((6, 6), deviation)
        shape = Shape(distance, spread, spread)
        scene = Scene(positions, 100.0, [np.zeros(0, int)] * 6, shape=shape)
        found.append([(one.start, one.stop) for one in find(statistics, scene=scene)])
    assert found == [[(150, 159)], []]


def test_a_dip_is_found_with_its_ramps():
    residual = rough(400, 5)
    dip = np.concatenate([[0.25, 0.5, 0.75], np.ones(4), [0.67, 0.33]])
    residual[150:159] += dip[:, None] * [40.0, 0, -30]
    [found] = find(peak_statistics(residual, residual, 100.0))
    assert (found.start, found.stop) == (150, 159)


@pytest.mark.parametrize("rate", RATES)
def test_pulses_are_trimmed_to_the_samples_that_are_off(rate):
    residual = rough(400, 2)
    places = [(0, 1), (100, 101), (200, 202), (398, 400)]
    for start, stop in places:
        residual[start:stop] += [4, 0, -3]
    found = find(peak_statistics(residual, residual, rate), rate=rate)
    assert sorted((one.start, one.stop) for one in found) == places
    np.testing.assert_allclose(
        [one.deviation.mean(axis=0) for one in found if one.start == 100], [[4, 0, -3]], atol=0.5
    )


@pytest.mark.parametrize("shape", ["edge", "impact", "hump", "noise", "of the neighbour"])
def test_what_is_no_pulse(shape):
    residual = rough(400, 3)
    positions = residual.copy()
    if shape == "edge":
        residual[200:] += 10
    elif shape == "impact":
        residual += 3 * np.maximum(np.arange(400) - 200, 0)[:, None]
    elif shape == "hump":
        residual += 10 * np.exp(-(((np.arange(400) - 200) / 8) ** 2))[:, None]
    elif shape == "noise":
        residual += np.random.default_rng(4).normal(0, 5, residual.shape)
    else:
        residual[200:203] += 10
    positions = residual if shape != "of the neighbour" else positions
    statistics = peak_statistics(residual, positions, 100.0)
    assert find(statistics) == []


def test_a_higher_threshold_finds_less_and_only_what_the_lower_finds():
    residual = rough(400, 6) * 5
    residual[::37] += [2.6, 0, 0]
    statistics = peak_statistics(residual, residual, 100.0)
    low, high = (
        {one.start for one in find(statistics, options=replace(PEAKS, max_shift_ratio=0, threshold_sigmas=sigmas))}
        for sigmas in (3, 7)
    )
    assert high < low
