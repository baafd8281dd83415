"""Slow changes: hysteresis on a known residual, and the synthetic walker."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import slow
from signals import RATES, detect, frames, neighbours, put, settings

PLACES = [("STRN", 200, 280), ("C7", 500, 600), ("RKNE", 800, 870)]


def triangle(length, height=10.0):
    return height * (1 - np.abs(2 * (np.arange(length) + 0.5) / length - 1))


def residual(rate, seed=0):
    return np.random.default_rng(seed).normal(0, 0.2, round(20 * rate))


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("length", [100, 200])
def test_hills_and_valleys_are_regrown_to_their_feet(rate, sign, length):
    signal, start, stop = residual(rate), frames(700, rate), frames(700 + length, rate)
    signal[start:stop] += sign * triangle(stop - start)
    mask, score = slow.find_slow(signal, rate=rate, settings=settings("slow", "paper"))
    inside = np.flatnonzero(mask)
    assert np.array_equal(inside, np.arange(inside[0], inside[-1] + 1))
    assert abs(inside[0] - start) <= frames(6, rate)
    assert abs(inside[-1] - stop) <= frames(6, rate)
    assert score[mask].min() > 1


@pytest.mark.parametrize("rate", RATES)
def test_a_short_hill_a_jump_of_one_sample_and_noise_are_rejected(rate):
    signal, start = residual(rate), frames(700, rate)
    signal[start : start + frames(40, rate)] += triangle(frames(40, rate))
    signal[start + 3 * int(rate)] += 50
    assert not slow.find_slow(signal, rate=rate, settings=settings("slow", "paper"))[0].any()


def test_a_gap_ends_a_hill():
    signal = residual(100.0)
    signal[700:800] += 10
    signal[745:755] = np.nan
    mask, _ = slow.find_slow(signal, rate=100.0, settings=settings("slow", "paper"))
    assert not mask.any()


def test_found_on_the_walker_and_not_blamed_on_neighbours(walker):
    recording = put(walker.recording, PLACES, lambda length: triangle(length)[:, None] * [3, 1, -2])
    found, _ = detect(recording, only=("slow",))
    assert [e.marker for e in found["slow"]] == sorted(marker for marker, _, _ in PLACES)
    for event, (_, start, stop) in zip(found["slow"], sorted(PLACES), strict=True):
        assert start - 5 <= event.start <= start + 25
        assert stop - 25 <= event.stop <= stop + 5


def test_the_published_detector_takes_the_residuals_of_any_predictor(walker):
    recording = put(walker.recording, PLACES[1:2], lambda length: triangle(length)[:, None] * [6, 0, 0])
    found, _ = detect(recording, preset="paper", only=("slow",))
    [event] = [e for e in found["slow"] if e.marker == "C7" and e.start < 550 < e.stop]
    assert "x" in event.axes


def test_a_body_that_fits_badly_as_a_whole_sets_the_scale():
    size = np.ones((100, 4))
    size[50] = 6
    near = [np.delete(np.arange(4), m) for m in range(4)]
    assert slow.company(size, near, near=3)[[20, 50], 0].tolist() == [1, 6]


def test_nothing_on_the_clean_walker(walker):
    assert detect(walker.recording) == ({"peaks": [], "noise": [], "steps": [], "slow": []}, [])


def test_where_a_neighbour_comes_or_goes_nothing_is_found(walker):
    recording = put(walker.recording, [("STRN", 200, 280)], lambda length: triangle(length)[:, None] * [3, 1, -2])
    near = neighbours(recording.positions)[recording.markers.index("STRN")]
    for first, last, expected in ((230, 250, []), (0, 1200, ["STRN"]), (800, 900, ["STRN"])):
        positions = recording.positions.copy()
        positions[first:last, near[3]] = np.nan
        found, _ = detect(replace(recording, positions=positions), only=("slow",))
        assert [event.marker for event in found["slow"]] == expected
