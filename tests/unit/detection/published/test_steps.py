"""Steps as published: exactly these intervals on a known signal, and open steps."""

import numpy as np
import pytest

from support.signals import NOTHING, RATES, detect, detect_signal, find_in, frames, motion, options_of, put


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("width", [15, 25, 35, 50, 150, 199])
def test_rectangles_are_steps_and_nothing_else(rate, width):
    signal, start = motion(rate), frames(700, rate)
    stop = start + frames(width, rate)
    signal[start:stop] -= 10
    assert detect_signal(signal, rate) == ({**NOTHING, "steps": [(start, stop)]}, [])


@pytest.mark.parametrize("rate", RATES)
def test_too_long_a_rectangle_is_two_open_steps(rate):
    signal, start = motion(rate), frames(700, rate)
    stop = start + frames(201, rate)
    signal[start:stop] += 10
    assert detect_signal(signal, rate) == (NOTHING, [start, stop])


@pytest.mark.parametrize("rate", RATES)
def test_one_edge_alone_is_an_open_step(rate):
    signal, start = motion(rate), frames(700, rate)
    signal[start:] += 10
    assert detect_signal(signal, rate) == (NOTHING, [start])


def test_unequal_edges_and_edges_across_a_gap_do_not_pair():
    unequal, gap = motion(100.0), motion(100.0)
    unequal[700:730] += 30
    unequal[730:] += 20
    gap[700:730] += 30
    gap[715:717] = np.nan
    for signal in (unequal, gap):
        mask, _, alone = find_in(signal, "steps", rate=100.0, options=options_of("steps", "coordinates"))
        assert not mask.any()
        assert alone.tolist() == [700, 730]


def test_the_published_shortest_step_is_longer():
    signal = motion(100.0)
    signal[700:715] += 10
    assert not find_in(signal, "steps", rate=100.0, options=options_of("steps", "paper"))[0][700:715].any()


def test_open_steps_of_coordinates_are_merged_to_those_of_markers(walker):
    recording = put(walker.recording, [("C7", 700, 1200)], lambda length: np.ones((length, 1)) * [30, 0, 40])
    _, left = detect(recording, preset="coordinates", only=("steps",))
    [step] = [step for step in left if (step.marker, step.frame) == ("C7", 700)]
    assert step.size_mm == pytest.approx(50, rel=0.1)
