"""Slow changes as published: hysteresis on a known residual, and whose residual is judged."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core import events
from markermend.detection.published import slow
from markermend.options.prediction.predictors import PredictorOptions
from markermend.prediction.scene import Scene
from markermend.simulation.walker import MeasurementErrors, walk
from markermend.simulation.walker_body import make_body
from support.signals import RATES, find_in, frames, neighbours, options_of, put

PAPER = options_of("slow", "paper")
ROBUST = replace(PAPER, scale_estimator="mad")
"""The scale of the residual is not widened by what is to be found."""


def triangle(length, height=10.0):
    return height * (1 - np.abs(2 * (np.arange(length) + 0.5) / length - 1))


def residual(rate, seed=0):
    return np.random.default_rng(seed).normal(0, 0.2, round(20 * rate))


@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("length", [100, 200])
def test_pulses_of_either_sign_are_regrown_to_their_ends(rate, sign, length):
    signal, start, stop = residual(rate), frames(700, rate), frames(700 + length, rate)
    signal[start:stop] += sign * triangle(stop - start)
    mask, score = find_in(signal, "slow", rate=rate, options=ROBUST)
    inside = np.flatnonzero(mask)
    assert np.array_equal(inside, np.arange(inside[0], inside[-1] + 1))
    assert abs(inside[0] - start) <= frames(6, rate)
    assert abs(inside[-1] - stop) <= frames(6, rate)
    assert score[mask].min() > 1


@pytest.mark.parametrize("rate", RATES)
def test_a_short_pulse_a_jump_of_one_sample_and_noise_are_rejected(rate):
    signal, start = residual(rate), frames(700, rate)
    signal[start : start + frames(40, rate)] += triangle(frames(40, rate))
    signal[start + 3 * int(rate)] += 50
    assert not find_in(signal, "slow", rate=rate, options=PAPER)[0].any()


def test_a_gap_ends_a_pulse():
    signal = residual(100.0)
    signal[700:800] += 10
    signal[745:755] = np.nan
    mask, _ = find_in(signal, "slow", rate=100.0, options=PAPER)
    assert not mask.any()


def test_thresholds_are_three_and_half_a_robust_deviation():
    signal = residual(100.0)
    sigma = 1.4826 * np.median(np.abs(signal - np.median(signal)))
    ramp = np.interp(np.arange(len(signal)), [600, 800, 1000], [0, 10, 0], left=0, right=0)
    mask, score = find_in(signal + ramp, "slow", rate=100.0, options=ROBUST)
    start, stop = np.flatnonzero(mask)[[0, -1]]
    assert abs(start - 600) <= 0.5 * sigma / 0.05 + 10 and abs(stop - 1000) <= 0.5 * sigma / 0.05 + 10
    assert score.max() == pytest.approx(10 / (3 * sigma), rel=0.35)  # the ramp widens the deviation


@pytest.mark.parametrize(("length", "found"), [(19, False), (21, True)])
def test_a_peak_lasts_a_fifth_of_a_second_and_a_pulse_half_a_second(length, found):
    signal = residual(100.0)
    signal[600:700] = 0.3  # above the lower threshold: 1 s
    signal[640 : 640 + length] = 5
    assert find_in(signal, "slow", rate=100.0, options=PAPER)[0].any() == found
    signal = residual(100.0)
    signal[599:661], signal[600:660] = 0, 0.3
    signal[600 : 600 + 2 * length + 10] = 5
    signal[600 + 2 * length + 10 : 661] = 0
    assert find_in(signal, "slow", rate=100.0, options=PAPER)[0].any() == found


@pytest.mark.parametrize("name", ["savitzky_golay", "moving_median"])
@pytest.mark.parametrize(("height", "expected"), [(0, set()), (10, {"x"})])
def test_a_smoother_finds_a_pulse_where_the_motion_is_slower(name, height, expected):
    own = replace(PAPER, predictor=name, smoothing_window_s=5.0, polynomial_order=2)
    sway = 2 * np.sin(0.4 * np.arange(2000) / 100.0)
    positions = np.stack([sway + residual(100.0, seed) for seed in range(3)], axis=1)[:, None]
    positions[900:1000, 0, 0] += triangle(100, height)
    scene, nothing = Scene(positions, 100.0, [np.zeros(0, int)]), np.zeros(positions.shape, bool)
    found, _ = slow.detect_slow(
        scene, markers=["A"], earlier=nothing, options=own, predictor=slow.make_predictor(own, PredictorOptions())
    )
    assert {event.axes for event in found} == expected  # a polynomial rings next to the drift as well
    assert any(event.start < 950 < event.stop for event in found) == bool(expected)


def gait(seconds=30.0, rate=100.0):
    """Five markers of a limb that goes to and fro every two seconds, each a little in its own way, with 0.2 mm of noise."""
    rng = np.random.default_rng(4)
    angle = np.pi * np.arange(round(seconds * rate))[:, None] / rate
    swing = np.stack([200 * np.sin(angle), 80 * np.sin(2 * angle + 1), 50 * np.cos(angle)], axis=2)
    soft = 5 * np.sin(angle[..., None] + rng.uniform(0, 6, (5, 3)))
    return rng.uniform(-200, 200, (5, 3)) + swing + soft + rng.normal(0, 0.2, (len(angle), 5, 3))


@pytest.mark.parametrize("name", ["replicated_network", "polynomial", "local_ridge"])
def test_a_drift_is_found_where_the_pose_recurs_without_it(name):
    positions, others = gait(), [np.delete(np.arange(5), m) for m in range(5)]
    positions[1000:1100, 2, 0] += triangle(100, 30)
    scene, own = Scene(positions, 100.0, others, segment_mates=others), replace(PAPER, predictor=name)
    source = Only(slow.make_predictor(own, PredictorOptions()), 2)
    nothing = np.zeros(positions.shape, bool)
    found, _ = slow.detect_slow(scene, markers=list("ABCDE"), earlier=nothing, options=own, predictor=source)
    [event] = [event for event in found if "x" in event.axes]
    assert event.marker == "C"
    assert abs(event.start - 1000) <= 30 and abs(event.stop - 1100) <= 30


def test_a_loose_predictor_follows_a_drift_in_a_pose_that_comes_once():
    """What the published way gets wrong: it judges what it was trained on, and the sway of a standing person identifies the frame."""
    rng = np.random.default_rng(2022)
    person = walk(
        body=make_body(rng=rng),
        duration=22.0,
        rate=100.0,
        activities=["stand"],
        errors=MeasurementErrors(noise=0.2, soft_tissue=1.0),
        rng=rng,
    )
    recording = put(person.recording, [("C7", 1000, 1100)], lambda length: triangle(length)[:, None] * [1, 0, 0])
    near, marker = neighbours(recording.positions), recording.markers.index("C7")
    scene = Scene(recording.positions, recording.rate, near, segment_mates=[own[:4] for own in near])
    height = {}
    for name in ("replicated_network", "local_ridge"):
        source = slow.make_predictor(replace(PAPER, predictor=name), PredictorOptions())
        height[name] = np.abs(source.residuals(scene, np.array([marker]))[1000:1100, marker, 0]).max()
    assert height["local_ridge"] > 9
    assert height["replicated_network"] < 5


class Only:
    """A predictor that is asked about one marker alone, to be quick."""

    def __init__(self, source, marker):
        self.source, self.marker = source, marker

    def residuals(self, scene):
        return self.source.residuals(scene, np.array([self.marker]))


def test_what_earlier_detectors_claimed_is_bridged_for_the_predictor_and_not_found_again():
    rate = 100.0
    positions = np.zeros((1500, 1, 3)) + residual(rate)[:1500, None, None]
    positions[600:700, 0, 0] += 30
    claimed = events.coordinates([events.Event("A", 600, 700, 2.0, "x")], 1500, ["A"])
    asked = []

    class Level:
        def residuals(self, scene):
            asked.append(scene.positions)
            return scene.positions

    scene = Scene(positions, rate, [np.zeros(0, int)])
    arguments = {"markers": ["A"], "options": PAPER, "predictor": Level()}
    [event], _ = slow.detect_slow(scene, earlier=np.zeros_like(claimed), **arguments)
    assert (event.start, event.stop, event.axes) == (600, 700, "x")
    assert slow.detect_slow(scene, earlier=claimed, **arguments) == ([], {})
    assert np.abs(asked[-1][600:700, 0, 0]).max() < 5
    assert np.array_equal(asked[-1][:, 0, 1:], positions[:, 0, 1:])
    assert np.isfinite(asked[-1]).all()


def test_an_unknown_predictor_is_refused():
    with pytest.raises(ValueError, match="none of replicated_network, polynomial"):
        slow.make_predictor(replace(PAPER, predictor="oracle"), PredictorOptions())


def test_the_training_of_the_network_differs_in_this_stage_only():
    shared = PredictorOptions()
    short = slow.make_predictor(replace(PAPER, replicated_network_changes={"max_iterations": 7}), shared)
    assert short.options == replace(shared.replicated_network, max_iterations=7)
    assert slow.make_predictor(PAPER, shared).options == shared.replicated_network
