"""The published detectors of sudden changes, one after the other: what they get right on the test signals, and what wrong."""

from dataclasses import replace

import numpy as np
import pytest

from support.signals import detect_signal, frames, motion, options_of

RATES = (50.0, 100.0)


def around(found, rate):
    """What was found from 7.5 to 10.5 s, by class; elsewhere the published thresholds find things in clean motion."""
    low, high = frames(750, rate), frames(1050, rate)
    return {kind: [(start, stop) for start, stop in own if low < start and stop < high] for kind, own in found.items()}


def with_added(rate, shape, hundredths):
    """Motion with something added from 8 s on, and the interval."""
    signal, start = motion(rate), frames(800, rate)
    stop = start + frames(hundredths, rate)
    signal[start:stop] += shape(stop - start)
    return signal, start, stop


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("width", [50, 150, 199])
def test_right_long_rectangles_are_steps(rate, width):
    signal, start, stop = with_added(rate, lambda length: 10.0, width)
    found, left = detect_signal(signal, rate, "paper")
    assert around(found, rate) == {"peaks": [], "noise": [], "steps": [(start, stop)]}
    assert left == []


@pytest.mark.parametrize("rate", RATES)
def test_right_too_long_a_rectangle_is_two_open_steps(rate):
    signal, start, stop = with_added(rate, lambda length: 10.0, 201)
    found, left = detect_signal(signal, rate, "paper")
    assert around(found, rate) == {"peaks": [], "noise": [], "steps": []}
    assert left == [start, stop]


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("sd", [3, 5, 10])
def test_right_noise_of_half_a_second_is_found_beside_peaks_in_it_and_shorter_is_none(rate, sd):
    rng = np.random.default_rng(1)
    signal, start, stop = with_added(rate, lambda length: rng.normal(0, sd, length), 50)
    found = around(detect_signal(signal, rate, "paper")[0], rate)
    pieces = sorted([*found["noise"], *found["peaks"]])
    covered = sum(last - first for first, last in pieces)
    assert found["noise"] and covered >= 0.8 * (stop - start)
    assert start <= pieces[0][0] <= start + 2 and stop - 2 <= pieces[-1][1] <= stop
    signal, _, _ = with_added(rate, lambda length: rng.normal(0, sd, length), 15)
    assert around(detect_signal(signal, rate, "paper")[0], rate)["noise"] == []


@pytest.mark.parametrize("rate", RATES)
def test_right_near_opposite_peaks_and_long_excursions_are_no_isolated_peaks(rate):
    signal, start, _ = with_added(rate, lambda length: 10.0, 1)
    signal[start + frames(8, rate)] -= 10
    assert around(detect_signal(signal, rate, "paper")[0], rate)["peaks"] == []
    signal, _, _ = with_added(rate, lambda length: 10.0, 7)
    assert around(detect_signal(signal, rate, "paper")[0], rate)["peaks"] == []


@pytest.mark.parametrize("width", [35, 38])
@pytest.mark.parametrize(("element_s", "kind"), [(0.19, "steps"), (0.39, "noise")])
def test_short_rectangles_are_taken_for_noise_with_the_printed_element_only(width, element_s, kind):
    signal, start, stop = with_added(100.0, lambda length: 10.0, width)
    options = {"noise": replace(options_of("noise", "paper"), element_s=element_s)}
    found = around(detect_signal(signal, 100.0, "paper", options)[0], 100.0)
    assert found == {"peaks": [], "noise": [], "steps": [], kind: [(start, stop)]}


def test_wrong_clean_motion_is_full_of_findings():
    """A threshold of a few standard deviations is exceeded somewhere in any signal; the printed closing joins these places."""
    options = {"noise": replace(options_of("noise", "paper"), element_s=0.39)}
    found, _ = detect_signal(motion(100.0), 100.0, "paper", options)
    flagged = sum(stop - start for own in found.values() for start, stop in own)
    assert found["peaks"]
    assert flagged > 0.3 * 2000


def test_wrong_peaks_are_missed_the_more_the_longer_they_are():
    """Differences after the median keep some of the trend, so a peak's two changes do not balance."""
    share = {}
    for width in (1, 5):
        right = 0
        for start in range(300, 1700, 50):
            signal = motion(100.0)
            signal[start : start + width] += 10
            right += (start, start + width) in detect_signal(signal, 100.0, "paper")[0]["peaks"]
        share[width] = right / 28
    assert 0.4 < share[1] < 0.9
    assert share[5] < 0.7 * share[1]
