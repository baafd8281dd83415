"""Isolated peaks as published: exactly these intervals on a known signal."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.detection.published import peaks
from support.naive import detection as naive
from support.signals import NOTHING, RATES, detect, detect_signal, find_in, frames, motion, options_of, put


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("seed", range(4))
def test_nothing_on_clean_motion(rate, seed):
    assert detect_signal(motion(rate, seed=seed), rate) == (NOTHING, [])


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("width", [1, 2, 3, 5])
def test_peaks_up_to_the_longest_are_located_exactly(rate, width):
    signal, start = motion(rate), frames(700, rate)
    stop = start + frames(width, rate)
    signal[start:stop] += 10
    assert detect_signal(signal, rate) == ({**NOTHING, "peaks": [(start, stop)]}, [])


@pytest.mark.parametrize("rate", RATES)
def test_a_longer_excursion_is_no_peak(rate):
    signal, start = motion(rate), frames(700, rate)
    signal[start : start + frames(7, rate)] += 10
    assert detect_signal(signal, rate)[0]["peaks"] == []


@pytest.mark.parametrize("rate", RATES)
def test_opposite_peaks_are_isolated_only_when_far_apart(rate):
    near, far, start = motion(rate), motion(rate), frames(700, rate)
    near[[start, start + frames(8, rate)]] += [10, -10]
    assert detect_signal(near, rate)[0]["peaks"] == []
    second = start + frames(30, rate)
    far[[start, second]] += [10, -10]
    assert detect_signal(far, rate)[0]["peaks"] == [(start, start + 1), (second, second + 1)]


@pytest.mark.parametrize("rate", RATES)
def test_nothing_on_a_reach_a_frozen_marker_and_next_to_gaps(rate):
    t = np.arange(round(20 * rate)) / rate
    u = np.clip((t - 8) / 1.0, 0, 1)
    reach = 533 * (10 * u**3 - 15 * u**4 + 6 * u**5) + np.random.default_rng(3).normal(0, 0.2, len(t))  # 1 m/s at most
    assert detect_signal(reach, rate)[0] == NOTHING
    frozen, gap, start = motion(rate), motion(rate), frames(700, rate)
    frozen[start : start + 2 * int(rate)] = frozen[start]
    assert detect_signal(frozen, rate)[0] == NOTHING
    gap[start : start + frames(50, rate)] = np.nan
    gap[start + frames(50, rate) :] += 30
    assert detect_signal(gap, rate)[0] == NOTHING
    assert detect_signal(np.full(100, np.nan), rate)[0] == NOTHING


def test_the_published_order_of_median_and_difference_is_there():
    signal = motion(100.0)
    signal[700] += 20
    mask, _ = find_in(signal, "peaks", rate=100.0, options=options_of("peaks", "paper"))
    assert np.flatnonzero(mask).tolist() == [700]
    with pytest.raises(ValueError, match="trend"):
        find_in(signal, "peaks", rate=100.0, options=replace(options_of("peaks", "paper"), trend_removal="none"))


def test_coordinates_are_merged_with_the_axes_that_fired(walker):
    recording = put(walker.recording, [("C7", 300, 303)], lambda length: np.ones((length, 1)) * [30, 0, -30])
    found, _ = detect(recording, preset="coordinates", only=("peaks",))
    assert [(e.start, e.stop, e.axes) for e in found["peaks"] if e.marker == "C7"] == [(300, 303, "xz")]


@given(st.integers(0, 200), st.sampled_from(["window", "run"]), st.sampled_from([1.5, 2.5]), st.booleans())
def test_located_peaks_equal_their_naive_twin(seed, localisation, level, joined):
    rng = np.random.default_rng(seed)
    change = rng.normal(0, 1, 120).round(2)
    options = replace(options_of("peaks", "paper"), localisation=localisation, joined_candidates=joined)
    mask, score = peaks.find_peaks(change, level, rate=100.0, options=options)
    assert mask.tolist() == naive.peaks(change, level, 5, 13, 5, localisation, joined=joined)
    assert (score[mask] > 1).all() and not score[~mask].any()


def test_a_change_that_the_median_leaks_nine_samples_away_does_not_hide_a_large_peak_where_its_own_changes_locate_it():
    change = np.zeros(200)
    change[[100, 101]] = 30, -30
    change[92] = 4
    window = options_of("peaks", "paper")
    options = replace(window, localisation="run")
    assert np.flatnonzero(peaks.find_peaks(change, 3.0, rate=100.0, options=options)[0]).tolist() == [100]
    assert not peaks.find_peaks(change, 3.0, rate=100.0, options=window)[0].any()


def test_two_peaks_a_fifth_of_a_second_apart_are_isolated_unless_candidates_are_joined():
    change = np.zeros(200)
    change[[80, 81, 101, 102]] = 30, -30, -30, 30
    options = options_of("peaks", "paper")
    found = [
        np.flatnonzero(
            peaks.find_peaks(change, 3.0, rate=100.0, options=replace(options, joined_candidates=joined))[0]
        ).tolist()
        for joined in (False, True)
    ]
    assert found == [[80, 101], []]
