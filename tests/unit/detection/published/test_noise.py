"""Heavy noise as published: exactly these stretches on a known signal."""

from dataclasses import replace

import numpy as np
import pytest

from support.signals import RATES, detect_signal, find_in, frames, motion, options_of


def noisy(rate, sd, hundredths, seed):
    signal, start, length = motion(rate), frames(700, rate), frames(hundredths, rate)
    signal[start : start + length] += np.random.default_rng(seed).normal(0, sd, length)
    return signal, start, start + length


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("sd", [3, 5, 10])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_half_a_second_of_noise_is_one_stretch(rate, sd, seed):
    signal, start, stop = noisy(rate, sd, 50, seed)
    found, _ = detect_signal(signal, rate)
    assert found["peaks"] == []
    [(first, last)] = found["noise"]
    assert start <= first <= start + frames(5, rate)
    assert stop - frames(5, rate) <= last <= stop


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("sd", [3, 5, 10])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_short_noise_is_rejected(rate, sd, seed):
    assert detect_signal(noisy(rate, sd, 15, seed)[0], rate)[0]["noise"] == []


def test_two_edges_are_not_noise_though_the_filter_smears_them():
    signal = motion(100.0)
    signal[700:725] += 30
    mask, _ = find_in(signal, "noise", rate=100.0, options=options_of("noise", "coordinates"))
    assert not mask.any()


def test_noise_up_to_a_gap_and_to_the_end():
    signal = motion(100.0)
    rng = np.random.default_rng(4)
    signal[650:700] += rng.normal(0, 5, 50)
    signal[700:720] = np.nan
    signal[-60:] += rng.normal(0, 5, 60)
    mask, _ = find_in(signal, "noise", rate=100.0, options=options_of("noise", "coordinates"))
    assert mask[655:695].all()
    assert mask[-55:-5].all()
    assert mask.sum() <= 110


@pytest.mark.parametrize(("element_s", "joined"), [(0.39, True), (0.19, False)])
def test_the_element_of_the_closings_joins_the_jumps_of_a_step_or_does_not(element_s, joined):
    signal = motion(100.0)
    signal[700:735] += 30
    options = replace(options_of("noise", "paper"), element_s=element_s)
    assert find_in(signal, "noise", rate=100.0, options=options)[0][700:735].any() == joined
