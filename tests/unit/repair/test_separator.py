"""Measured samples without the artifact on them: nearer to the truth than the prediction alone, gaps and borders kept."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.options.repair import SeparationOptions
from markermend.repair.separation import (
    SHAPE_COVARIANCES,
)
from support.repairs import MARKER, METHODS, START, STOP, body, distorted, error, mend

OPTIONS = SeparationOptions(
    local_ridge_changes=({},),
    amplitudes_mm=(3, 12, 48),
    roughness_mm=(0.1, 1),
    border_s=0.1,
    margin_fractions=(0,),
    likelihood_power=1,
)


@pytest.fixture(scope="module")
def clean():
    return body()


RAMP = np.concatenate([np.arange(1, 21), np.arange(20, 0, -1)])[:, None] / 20
DAMAGE = {
    "noise": ("separate_noise", 0.6, np.random.default_rng(4).normal(0, 6.0, (40, 3))),
    "steps": ("separate_step", 0.1, np.full((40, 3), 12.0)),
    "slow": ("separate_slow", 0.9, RAMP * [12.0, -9.0, 6.0]),
}


@pytest.fixture(scope="module")
def wobbling(clean):
    """One marker moves by some mm in ways of its own, of which nothing is in the neighbours."""
    push = np.random.default_rng(6).normal(0, 4.0, (clean.frames + 30, 3))
    own = np.stack([np.convolve(axis, np.hanning(31) / np.sqrt(11.25), "valid") for axis in push.T], axis=1)
    return distorted(clean, own[: clean.frames], 0, clean.frames)


@pytest.mark.parametrize("kind", DAMAGE)
def test_what_was_measured_mends_the_prediction(wobbling, kind):
    method, share, change = DAMAGE[kind]
    recording, found = distorted(wobbling, change), {kind: [Event(MARKER, START, STOP, 4.0)]}
    plain, parted = (mend(recording, found, methods={**METHODS, kind: [own]}) for own in ("local_ridge", method))
    assert parted.repairs[0].method == method
    before, alone, after = (np.sqrt((error(wobbling, one) ** 2).mean()) for one in (recording, plain, parted))
    assert after < share * alone and after < share * before


def test_wobble_is_removed_although_it_is_no_white_noise(wobbling):
    wobble = 5 * np.sin(2 * np.pi * 8.0 * np.arange(40) / wobbling.rate)[:, None] * np.array([0.6, 0.0, 0.8])
    recording, found = distorted(wobbling, wobble), {"noise": [Event(MARKER, START, STOP, 4.0)]}
    mended, white = (
        mend(recording, found, methods={**METHODS, "noise": ["separate_noise"]}, separation=options)
        for options in (OPTIONS, replace(OPTIONS, oscillations_hz=()))
    )
    before, after, without = (np.sqrt((error(wobbling, one) ** 2).mean()) for one in (recording, mended, white))
    assert after < 0.5 * before and after < 0.7 * without


@pytest.mark.parametrize("kind", DAMAGE)
def test_several_ridges_predict_together(wobbling, kind):
    """Each alone is offered by itself; all together are neither worse than the worst nor any of them alone."""
    method, _, change = DAMAGE[kind]
    recording, found = distorted(wobbling, change), {kind: [Event(MARKER, START, STOP, 4.0)]}
    alone, other, both = (
        mend(
            recording,
            found,
            methods={**METHODS, kind: [method]},
            separation=replace(OPTIONS, local_ridge_changes=ridges),
        )
        for ridges in ([{}], [{"inputs": 4}], [{}, {"inputs": 4}])
    )
    apart = [np.sqrt((error(wobbling, one) ** 2).mean()) for one in (alone, other, both)]
    assert apart[2] <= max(apart[:2]) and apart[2] not in apart[:2]


@pytest.mark.parametrize("method", SHAPE_COVARIANCES)
def test_a_gap_within_stays_a_gap(clean, method):
    recording = distorted(clean, 12.0)
    m = clean.markers.index(MARKER)
    recording.positions[612:618, m] = np.nan
    result = mend(recording, {"steps": [Event(MARKER, START, STOP, 4.0)]}, methods={**METHODS, "steps": [method]})
    assert result.repairs[0].method == method
    assert np.isnan(result.positions[612:618, m]).all() and not np.isnan(result.positions[START:612, m]).any()


def test_what_is_too_long_to_separate_is_left_to_others(clean):
    found = {"steps": [Event(MARKER, START, STOP, 4.0)]}
    given = replace(OPTIONS, max_frames=STOP - START - 1)
    methods = {**METHODS, "steps": ["separate_step"]}
    result = mend(distorted(clean, 12.0), found, methods=methods, separation=given)
    (left,) = result.repairs_left
    assert left.reason.text == "no repair is accurate enough (separate_step: not applicable)"


def test_a_slow_change_may_begin_before_it_was_found(clean):
    """What of it is left beside the finding would pull the prediction along, if it counted as the true trajectory."""
    trajectory = np.concatenate([np.arange(1, 27), np.arange(26, 0, -1)])[:, None] / 26 * [12.0, -9.0, 6.0]
    recording, found = distorted(clean, trajectory, START - 6, STOP + 6), {"slow": [Event(MARKER, START, STOP, 4.0)]}
    given = replace(OPTIONS, amplitudes_mm=(3, 10, 30), roughness_mm=(0.3, 2), border_s=0.15)
    exact, wider = (
        mend(
            recording,
            found,
            methods={**METHODS, "slow": ["separate_slow"]},
            separation=replace(given, margin_fractions=margins),
        )
        for margins in ([0], [0, 0.1])
    )
    assert error(clean, wider).max() < 0.5 * error(clean, exact).max()
    outside = np.r_[:START, STOP : clean.frames]
    assert np.array_equal(wider.positions[outside], recording.positions[outside])


def test_next_to_a_gap_a_slow_change_begins_where_the_marker_is_seen(clean):
    m, recording = clean.markers.index(MARKER), distorted(clean, RAMP * [12.0, -9.0, 6.0])
    recording.positions[STOP : STOP + 20, m] = np.nan
    result = mend(
        recording, {"slow": [Event(MARKER, START, STOP, 4.0)]}, methods={**METHODS, "slow": ["separate_slow"]}
    )
    assert result.repairs[0].method == "separate_slow"
    assert np.isnan(result.positions[STOP : STOP + 20, m]).all() and error(clean, result).max() < 1
