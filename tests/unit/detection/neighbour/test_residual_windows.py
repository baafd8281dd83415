"""Usual courses: what they leave of a window, what an excursion and an edge are off them, and which windows exceed."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.detection.neighbour import edges, pulses, residual_windows
from markermend.numerics import window_covariance
from markermend.prediction.scene import Scene
from support.signals import RATES, options_of

PEAKS, STEPS = options_of("peaks", "default"), options_of("steps", "default")


def measured(residual, positions, rate, own):
    """The courses of one marker (frames, 3)."""
    scene = Scene(positions[:, None], rate, [np.zeros(0, int)])
    maps, length = edges.central(rate, own) if own is STEPS else pulses.of_longest(rate, own)
    return residual_windows.measure(scene, residual[:, None], maps=maps, length=length, options=own)


def rough(frames, seed):
    return np.random.default_rng(seed).normal(0, 0.05, (frames, 3))


def independent(size, order):
    """The regularity of independent noise on a polynomial of an order."""
    return window_covariance.WindowCovariance(np.eye(size), order)


@pytest.mark.parametrize("place", [0, 3, 6, 12])
def test_without_regularity_excursions_are_off_a_fitted_polynomial(place):
    window = np.random.default_rng(1).normal(0, 1, 16)
    usual, inside = independent(16, 3), np.arange(place, place + 4)
    others = np.setdiff1d(np.arange(16), inside)
    fit = np.polyfit(others, window[others], 3)
    off = window - np.polyval(fit, np.arange(16))
    np.testing.assert_allclose(pulses.apart(usual, 4, 16, place) @ window, off[inside])
    maps = pulses.contrasts(usual, 4, 16, (place,))
    basis = np.linalg.qr(np.vander(np.linspace(-1, 1, 16), 4))[0]
    unit = 1 - (basis[8] ** 2).sum()  # how well the middle sample follows from the others
    assert window @ maps.misfit[0] @ window == pytest.approx((off[others] ** 2).sum() / unit / (16 - 4 - 4))


def test_a_wave_and_a_jump_have_the_size_that_they_were_given():
    size, at = 16, np.arange(16)
    course = 0.1 * at**2 - at + 3.0
    usual = window_covariance.fit_window_covariance(
        rough(2000, 9)[:, None].cumsum(axis=0), size=size, order=2, shrinkage=0.01, max_windows=5000
    )
    wave = np.sin(np.pi * (np.arange(5) + 0.5) / 5)
    for place in (0, 6, 11):
        maps = pulses.contrasts(usual, 5, size, (place,))
        window = course.copy()
        window[place : place + 5] += 4 * wave
        assert maps.size[0] @ window == pytest.approx(4)
        assert window @ maps.misfit[0] @ window == pytest.approx(0, abs=1e-6)
    maps = edges.contrasts(usual, size, (4, 8))
    window = course + 5 * (at >= 8)
    assert maps.size[1] @ window == pytest.approx(5)
    assert window @ maps.misfit[1] @ window == pytest.approx(0, abs=1e-6)
    assert window @ maps.misfit[0] @ window > 0.1


@pytest.mark.parametrize("rate", RATES)
def test_excursions_are_cut_to_the_samples_that_are_off(rate):
    residual = rough(400, 2)
    places = [(0, 1), (100, 101), (200, 202), (398, 400)]
    for start, stop in places:
        residual[start:stop] += [4, 0, -3]
    found = pulses.find(measured(residual, residual, rate, PEAKS), 0, rate=rate, options=PEAKS)
    assert sorted((one.start, one.stop) for one in found) == places
    np.testing.assert_allclose([one.off.mean(axis=0) for one in found if one.start == 100], [[4, 0, -3]], atol=0.5)


@pytest.mark.parametrize("shape", ["edge", "hump", "noise", "of the neighbour"])
def test_what_is_no_excursion(shape):
    residual = rough(400, 3)
    positions = residual.copy()
    if shape == "edge":
        residual[200:] += 10
    elif shape == "hump":
        residual += 10 * np.exp(-(((np.arange(400) - 200) / 8) ** 2))[:, None]
    elif shape == "noise":
        residual += np.random.default_rng(4).normal(0, 5, residual.shape)
    positions = residual if shape != "of the neighbour" else positions
    if shape == "of the neighbour":
        residual[200:203] += 10
    assert pulses.find(measured(residual, positions, 100.0, PEAKS), 0, rate=100.0, options=PEAKS) == []


@pytest.mark.parametrize("rate", RATES)
def test_edges_are_found_where_they_are_and_beside_gaps(rate):
    residual = rough(400, 5)
    residual[100:] += [3, 4, 0]
    residual[200:] -= [3, 4, 0]
    residual[3:] += [0, 6, 0]
    found = edges.find(measured(residual, residual, rate, STEPS), 0, rate=rate, options=STEPS)
    assert [edge.frame for edge in found] == [3, 100, 200]
    np.testing.assert_allclose(found[1].jump, [3, 4, 0], atol=0.3)


def test_a_higher_threshold_finds_less_and_only_what_the_lower_finds():
    residual = rough(400, 6) * 5
    residual[::37] += [2.6, 0, 0]
    course = measured(residual, residual, 100.0, PEAKS)
    low, high = (
        {
            one.start
            for one in pulses.find(
                course, 0, rate=100.0, options=replace(PEAKS, max_shift_ratio=0, threshold_sigmas=sigmas)
            )
        }
        for sigmas in (3, 7)
    )
    assert high < low
