"""Which repair is taken: the one with the least expected error, the preferred among equals, and none that leaves the recording worse."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

from markermend.core.events import Event
from markermend.repair.candidates import Candidate, choose
from markermend.repair.methods import Proposal
from support import bodies
from support.repairs import MARKER, METHODS, START, STOP, Vague, body, distorted, error, mend
from support.treated import expected


@pytest.fixture(scope="module")
def clean():
    return body()


def candidate(method, expected_error, *, change=50.0, before=40.0, after=1.0, radius=3.0):
    return Candidate(Proposal(method, np.zeros((1, 3)), np.ones(1)), expected_error, change, before, after, radius)


@pytest.mark.parametrize(
    ("candidates", "taken"),
    [
        ([candidate("a", 1.2), candidate("b", 1.0)], "a"),
        ([candidate("a", 1.3), candidate("b", 1.0)], "b"),
        ([candidate("a", 1.0), candidate("b", 1.0)], "a"),
        ([candidate("a", 1.3), candidate("b", 1.0, after=41.0)], "a"),
        ([candidate("a", 1.3), candidate("b", 1.0, after=41.0, radius=50.0)], "b"),
        ([candidate("a", 1.3, change=1.0), candidate("b", 1.0)], "b"),
        ([candidate("a", 1.3), candidate("b", 1.0, change=0.5)], None),
        ([candidate("a", 1.3), candidate("b", 1.0, before=np.nan, after=np.nan)], "b"),
        ([candidate("a", 6.0)], None),
        ([], None),
    ],
)
def test_the_best_that_may_be_taken_is_and_the_preferred_among_equals(candidates, taken):
    choice = choose(candidates, max_error_mm=5.0, preference_factor=1.25)
    assert (choice and choice.proposal.method) == taken


@pytest.mark.parametrize(("deviation", "method"), [(0.001, "vague"), (3.0, "local_ridge")])
def test_methods_compete_and_all_are_recorded(clean, deviation, method):
    recording = distorted(clean, 30.0)
    vague = Vague(clean, off=0.0, deviation=deviation)
    result = mend(
        recording,
        {"slow": [Event(MARKER, START, STOP, 4.0)]},
        methods={**METHODS, "slow": ["local_ridge", "vague"]},
        extra=vague,
    )
    (change,) = result.repairs
    assert change.method == method
    assert expected(change)["vague"] == pytest.approx(1.8 * deviation, abs=1e-3)
    m = clean.markers.index(MARKER)
    assert expected(change)[method] == pytest.approx(result.error[START:STOP, m].max(), abs=1e-3)


@pytest.mark.parametrize("length", [3, 200])
def test_length_decides_between_a_spline_and_the_neighbours(clean, length):
    """Over a few frames of smooth motion the spline errs least, over seconds the neighbours do."""
    recording = distorted(clean, 25.0, START, START + length)
    found = {"noise": [Event(MARKER, START, START + length, 4.0)]}
    result = mend(recording, found, methods={**METHODS, "noise": ["local_ridge", "spline"]}, preference_factor=1.0)
    (change,) = result.repairs
    assert change.method == min(expected(change), key=expected(change).get)
    assert len(expected(change)) == 2
    if length > 100:
        assert change.method == "local_ridge"
    assert error(clean, result, START, START + length).max() < 2


def test_a_step_is_removed_where_the_prediction_is_less_certain_than_the_jumps(clean):
    """A marker on loose skin: the prediction errs by millimetres, the jumps at both ends of a step do not."""
    m, rng = clean.markers.index(MARKER), np.random.default_rng(8)
    loose = gaussian_filter1d(rng.normal(0, 1, (clean.frames, 3)), 12, axis=0)
    positions = clean.positions.copy()
    positions[:, m] += 3.0 * loose / loose.std()
    wobbly = bodies.recording(clean.markers, positions)
    result = mend(distorted(wobbly, np.array([6.0, -5.0, 4.0])), {"steps": [Event(MARKER, START, STOP, 5.0)]})
    (change,) = result.repairs
    assert change.method == "separate_step" and expected(change)["local_ridge"] > 3
    assert error(wobbly, result).max() < 0.8


def test_nothing_is_proposed_where_no_sample_was_seen(clean):
    """Such as a swap with a marker that was missing, where a person wants another method than the exchange."""
    recording = distorted(clean, np.nan)
    result = mend(recording, {"peaks": [Event(MARKER, START, STOP, 5.0)]})
    assert result.repairs == [] and np.array_equal(result.positions, recording.positions, equal_nan=True)


@pytest.mark.parametrize(("start", "stop"), [(600, 640), (0, 40), (1460, 1500)])
def test_flicker_is_undone_level_by_level(clean, start, stop):
    """At an end of a recording a single side says which level is right."""
    displaced = np.tile([False, True, True, False, True], 8)
    recording = distorted(clean, displaced[:, None] * np.array([9.0, 0.0, 12.0]), start, stop)
    methods = {**METHODS, "noise": ["separate_levels"]}
    result = mend(recording, {"noise": [Event(MARKER, start, stop, 4.0)]}, methods=methods)
    m = clean.markers.index(MARKER)
    assert error(clean, result, start, stop).max() < 0.5
    right = result.positions[start:stop, m][~displaced]
    np.testing.assert_array_equal(right, recording.positions[start:stop, m][~displaced])


def test_flicker_is_undone_where_the_prediction_is_further_off_than_the_levels(clean):
    """The jumps are known from frame to frame, where the error of the prediction cancels; its level says nothing."""
    m, displaced = clean.markers.index(MARKER), np.tile([False, True, True, False, True], 8)
    positions = clean.positions.copy()
    positions[570:670, m] -= 15.0 * np.sin(np.pi * np.arange(100) / 99)[:, None] ** 2 * np.array([0.6, 0.0, 0.8])
    moving = bodies.recording(clean.markers, positions)
    recording = distorted(moving, displaced[:, None] * np.array([6.0, 0.0, 8.0]), 600, 640)
    methods = {**METHODS, "noise": ["separate_levels"]}
    result = mend(recording, {"noise": [Event(MARKER, 600, 640, 4.0)]}, methods=methods)
    (change,) = result.repairs
    assert change.method == "separate_levels"
    assert error(moving, result, 600, 640).max() < 0.8
