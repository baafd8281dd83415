"""Polynomials through windows: what they leave, what an excursion and an edge are off them, and which windows exceed."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import courses, edges, excursions
from markermend.predictors import Scene
from signals import RATES, settings

PEAKS, STEPS = settings("peaks", "default"), settings("steps", "default")


def measured(residual, positions, rate, own):
    """The courses of one marker (frames, 3)."""
    scene = Scene(positions[:, None], rate, [np.zeros(0, int)])
    maps = edges.central(rate, own) if own is STEPS else excursions.of_longest(rate, own)
    return courses.measure(scene, residual[:, None], maps=maps, settings=own)


def rough(frames, seed):
    return np.random.default_rng(seed).normal(0, 0.05, (frames, 3))


@pytest.mark.parametrize("places", [(6,), (0, 3, 12)])
def test_off_and_misfit_are_those_of_a_fitted_polynomial(places):
    maps = excursions.contrasts(4, 16, places, 3)
    window = np.random.default_rng(1).normal(0, 1, 16)
    for k, place in enumerate(places):
        others = np.setdiff1d(np.arange(16), np.arange(place, place + 4))
        fit = np.polyfit(others, window[others], 3)
        np.testing.assert_allclose(maps.off[k] @ window, (window - np.polyval(fit, np.arange(16)))[place : place + 4])
        left = ((window - np.polyval(fit, np.arange(16)))[others] ** 2).sum()
        assert ((maps.misfit[k] @ window) ** 2).sum() == pytest.approx(left)


def test_an_edge_is_that_of_a_polynomial_with_a_jump():
    maps, at = edges.contrasts(12, (4, 6), 3), np.arange(12)
    window = 0.1 * at**3 - at + 5 * (at >= 6)
    assert maps.off[1, 0] @ window == pytest.approx(5)
    np.testing.assert_allclose(maps.misfit[1] @ window, 0, atol=1e-9)
    assert np.abs(maps.misfit[0] @ window).max() > 0.1


@pytest.mark.parametrize("rate", RATES)
def test_excursions_are_cut_to_the_samples_that_are_off(rate):
    residual = rough(400, 2)
    places = [(0, 1), (100, 101), (200, 202), (398, 400)]
    for start, stop in places:
        residual[start:stop] += [4, 0, -3]
    found = excursions.find(measured(residual, residual, rate, PEAKS), 0, rate=rate, settings=PEAKS)
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
    assert excursions.find(measured(residual, positions, 100.0, PEAKS), 0, rate=100.0, settings=PEAKS) == []


@pytest.mark.parametrize("rate", RATES)
def test_edges_are_found_where_they_are_and_beside_gaps(rate):
    residual = rough(400, 5)
    residual[100:] += [3, 4, 0]
    residual[200:] -= [3, 4, 0]
    residual[3:] += [0, 6, 0]
    found = edges.find(measured(residual, residual, rate, STEPS), 0, rate=rate, settings=STEPS)
    assert [edge.frame for edge in found] == [3, 100, 200]
    np.testing.assert_allclose(found[1].jump, [3, 4, 0], atol=0.3)


def test_a_higher_threshold_finds_less_and_only_what_the_lower_finds():
    residual = rough(400, 6) * 5
    residual[::37] += [2.6, 0, 0]
    course = measured(residual, residual, 100.0, PEAKS)
    low, high = (
        {one.start for one in excursions.find(course, 0, rate=100.0, settings=replace(PEAKS, sigmas=sigmas))}
        for sigmas in (2, 4)
    )
    assert high < low


def test_lengths_are_dense_enough():
    assert excursions.lengths(1) == [1]
    assert excursions.lengths(5) == [1, 2, 3, 4, 5]
    assert excursions.lengths(12) == [1, 2, 3, 4, 6, 9, 12]
