"""Isolated peaks: exactly these intervals on a known signal, and on the synthetic walker."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.detection.published import peaks
from markermend.options.detection import PeaksOptions
from markermend.options.published import PublishedPeaksOptions
from support.signals import NOTHING, RATES, detect, detect_signal, frames, motion, options_of, put

# At the start, in the middle, before and after a gap, at the end.
PLACES = [
    ("LWRA", 0, 1),
    ("C7", 400, 403),
    ("LELB", 595, 600),
    ("LELB", 620, 622),
    ("RKNE", 800, 801),
    ("RASI", 1197, 1200),
]


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
def test_nothing_on_a_reach_a_frozen_marker_and_beside_gaps(rate):
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
    mask, _ = peaks.find_peaks(signal, rate=100.0, options=options_of("peaks", "paper"))
    assert np.flatnonzero(mask).tolist() == [700]
    with pytest.raises(ValueError, match="trend"):
        peaks.find_peaks(signal, rate=100.0, options=replace(options_of("peaks", "paper"), trend_removal="none"))


def test_found_on_the_walker_and_not_blamed_on_neighbours(walker):
    recording = put(walker.recording, PLACES, lambda length: np.ones((length, 1)) * [12, 4, -9])
    recording.positions[600:620, recording.markers.index("LELB")] = np.nan
    found, _ = detect(recording, only=("peaks",))
    assert [(e.marker, e.start, e.stop) for e in found["peaks"]] == sorted(PLACES)
    assert all("x" in e.axes and e.score >= 1 for e in found["peaks"])


def test_three_siblings_with_a_peak_at_once(walker):
    recording, places = walker.recording, []
    for marker, size in (("RASI", [8, 3, -6]), ("LASI", [-4, 9, 3]), ("LPSI", [5, -7, 6])):
        own = [(marker, start, start + 3) for start in (300, 700)]
        recording = put(recording, own, lambda length, size=size: np.ones((length, 1)) * size)
        places += own
    found, _ = detect(recording, only=("peaks",))
    assert [(e.marker, e.start, e.stop) for e in found["peaks"]] == sorted(places)


def test_a_glitch_of_all_markers_at_once_hides_none_of_them(walker):
    offsets = np.random.default_rng(4).normal(0, 30, (len(walker.recording.markers), 3))
    recording = replace(walker.recording, positions=walker.recording.positions.copy())
    recording.positions[700] += offsets
    found, _ = detect(recording, only=("peaks",))
    assert len(found["peaks"]) > len(recording.markers) / 2
    assert all((e.start, e.stop) == (700, 701) for e in found["peaks"])


def test_coordinates_are_merged_with_the_axes_that_fired(walker):
    recording = put(walker.recording, [("C7", 300, 303)], lambda length: np.ones((length, 1)) * [30, 0, -30])
    found, _ = detect(recording, preset="coordinates", only=("peaks",))
    assert [(e.start, e.stop, e.axes) for e in found["peaks"] if e.marker == "C7"] == [(300, 303, "xz")]


def test_options_are_those_of_the_preset():
    assert isinstance(options_of("peaks", "default"), PeaksOptions)
    assert isinstance(options_of("peaks", "paper"), PublishedPeaksOptions)
