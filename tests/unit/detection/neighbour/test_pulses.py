"""Pulses: a few samples off the smooth trajectory, trimmed to those, and no edges, humps or noise."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.shape import Shape
from markermend.detection.neighbour import pulses
from markermend.detection.neighbour.level_evidence import LevelEvidence
from markermend.numerics.window_covariance import fit_window_covariance
from markermend.prediction.scene import Scene
from support.residuals import PEAKS, alone, peak_statistics, rough
from support.signals import RATES


def find(statistics, *, rate=100.0, options=PEAKS, scene=None):
    longest = round(options.max_dip_duration_s * rate) + 2 * max(pulses.MIN_CONTEXT, round(options.context_s * rate))
    covariance = fit_window_covariance(statistics.residual, size=longest, order=2, shrinkage=0.01, max_windows=5000)
    scene = alone(statistics.positions[:, 0], rate) if scene is None else scene
    evidence = LevelEvidence(scene, 0, statistics.residual[:, 0], options.level, options.shape)
    return pulses.find_pulses(statistics, 0, covariance, evidence, options=options)


def among_mates(positions, *, deviation):
    """A scene of a marker (frames, 3) and five mates at rest, with distances of a standard deviation that is usual."""
    mates = np.broadcast_to(np.random.default_rng(5).normal(0, 200, (5, 3)), (len(positions), 5, 3))
    together = np.concatenate([positions[:, None], mates], axis=1)
    distance = np.linalg.norm(together[0, :, None] - together[0], axis=2)
    spread = np.full(distance.shape, deviation)
    return Scene(together, 100.0, [np.zeros(0, int)] * 6, shape=Shape(distance, spread, spread))


def test_a_dip_for_which_residual_and_distances_speak_is_found_below_the_threshold():
    residual = rough(400, 5)
    residual[150:159] += np.concatenate([[0.25, 0.5, 0.75], np.ones(4), [0.67, 0.33]])[:, None] * [1.7, 0, 0]
    statistics = peak_statistics(residual, residual, 100.0)
    found = [find(statistics, scene=among_mates(residual, deviation=own)) for own in (0.5, 50.0)]
    assert [[(one.start, one.stop) for one in each] for each in found] == [[(150, 159)], []]


def test_the_first_part_of_a_step_is_no_dip():
    residual = rough(400, 5)
    residual[150:171, 0] += np.repeat([10.0, 5.0], [9, 12])
    statistics = peak_statistics(residual, residual, 100.0)
    assert not find(statistics, scene=among_mates(residual, deviation=1.0))


@pytest.mark.parametrize(
    ("rate", "longest_peak", "dips"),
    [(50.0, 3, [4, 5, 6]), (100.0, 5, [6, 7, 8, 9, 10, 12]), (200.0, 10, [12, 14, 16, 19, 22, 24])],
)
def test_the_lengths_of_dips_grow_by_a_factor(rate, longest_peak, dips):
    lengths = pulses.pulse_lengths(rate, replace(PEAKS, dip_length_ratio=1.2))
    assert lengths == [*range(1, longest_peak + 1), *dips]


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
