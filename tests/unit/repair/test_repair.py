"""Repair: each class undone on a body whose truth is known, nothing else touched, every refusal with its reason."""

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.core.recording import MEASURED, ORIGINS
from support.repairs import MARKER, START, STOP, body, distorted, error, mend
from support.treated import expected


@pytest.fixture(scope="module")
def clean():
    return body()


def check_only(recording, result, start, stop, origin, marker=MARKER):
    """Everything outside the interval is the original bit for bit; inside it is marked as repaired, with an error."""
    m = recording.markers.index(marker)
    inside = np.zeros(result.origin.shape, bool)
    inside[start:stop, m] = True
    assert np.array_equal(result.positions[~inside], recording.positions[~inside])
    assert (result.origin[~inside] == MEASURED).all()
    assert (result.error[~inside] == 0).all()
    assert (result.origin[start:stop, m] == ORIGINS.index(origin)).all()
    assert (result.error[start:stop, m] > 0).all()
    assert (result.error95 >= result.error).all()


@pytest.mark.parametrize("kind", ["noise", "slow"])
def test_prediction_replaces_noise_and_drift(clean, kind):
    rng = np.random.default_rng(1)
    recording = distorted(clean, rng.normal(0, 10, (STOP - START, 3)))
    result = mend(recording, {kind: [Event(MARKER, START, STOP, 3.0)]})
    check_only(recording, result, START, STOP, kind)
    assert error(clean, result).max() < 1
    (change,) = result.repairs
    assert expected(change).keys() == {"local_ridge"}
    assert (change.marker, change.start, change.stop, change.kind, change.score) == (MARKER, START, STOP, kind, 3.0)
    assert (change.outcome, change.method, change.samples, change.reason) == (
        "repaired",
        "local_ridge",
        STOP - START,
        None,
    )
    m = clean.markers.index(MARKER)
    span = slice(START, STOP), m
    moved = np.linalg.norm(result.positions[span] - recording.positions[span], axis=1).max()
    figures = moved, result.error[span].max(), result.error95[span].max()
    assert (change.largest_change_mm, change.expected_error_mm, change.expected_error95_mm) == pytest.approx(
        figures, abs=5e-4
    )


def test_spline_replaces_a_peak_and_states_a_fair_error(clean):
    recording = distorted(clean, 15.0, 700, 703)
    result = mend(recording, {"peaks": [Event(MARKER, 700, 703, 5.0)]})
    check_only(recording, result, 700, 703, "peak")
    miss = error(clean, result, 700, 703)
    stated = result.error95[700:703, clean.markers.index(MARKER)]
    assert miss.max() < 0.5
    assert stated.max() < 1
    assert (miss < 2 * stated).all()


def test_a_step_is_taken_off_and_its_measured_detail_stays(clean):
    recording = distorted(clean, np.array([9.0, -4.0, 2.0]))
    result = mend(recording, {"steps": [Event(MARKER, START, STOP, 5.0)]})
    check_only(recording, result, START, STOP, "step")
    assert result.repairs[0].method == "separate_step"
    m = clean.markers.index(MARKER)
    shift = result.positions[START:STOP, m] - clean.positions[START:STOP, m]
    assert np.abs(shift).max() < 0.3
    assert np.ptp(shift, axis=0).max() < 0.3


def test_a_step_with_noise_on_it_loses_both(clean):
    rng = np.random.default_rng(2)
    recording = distorted(clean, 9.0 + rng.normal(0, 6, (STOP - START, 3)))
    result = mend(recording, {"steps": [Event(MARKER, START, STOP, 5.0)]})
    assert error(clean, result).max() < 1


def test_the_neighbours_artifact_does_not_leak_into_a_repair(clean):
    recording = distorted(distorted(clean, 30.0), 40.0, marker="1a")
    events = [Event(MARKER, START, STOP, 5.0), Event("1a", START, STOP, 5.0)]
    result = mend(recording, {"slow": events})
    assert error(clean, result).max() < 1.5
    assert error(clean, result, marker="1a").max() < 1.5


def test_nothing_found_gives_the_recording_back(clean):
    result = mend(clean, {})
    assert np.array_equal(result.positions, clean.positions)
    assert not result.origin.any() and not result.error.any()
    assert result.repairs == result.repairs_left == []
