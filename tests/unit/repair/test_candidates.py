"""Which repair is taken: the surest, the preferred among equals, and none that leaves the recording worse."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter1d

from markermend.core.decisions import Decision
from markermend.core.events import Event, mask
from markermend.core.recording import MISSING
from markermend.options.prediction import PredictorOptions
from markermend.prediction.interpolation import KINDS
from markermend.prediction.registry import members
from markermend.prediction.scene import Prediction
from markermend.repair.candidates import Candidate, choose
from markermend.repair.methods import Proposal
from markermend.repair.separation import SHAPE_COVARIANCES
from support import bodies
from support.repairs import MARKER, METHODS, START, STOP, body, distorted, error, mend
from support.signals import detect, neighbours, put
from support.treated import expected


@pytest.fixture(scope="module")
def clean():
    return body()


class Vague:
    """A predictor that is off by some mm along x and states a standard deviation."""

    continuous = True

    def __init__(self, recording, name="vague", off=12.0, deviation=10.0):
        self.positions, self.name, self.off, self.deviation = recording.positions, name, off, deviation

    def predict(self, scene, marker, start, stop):
        positions = self.positions[start - 1 : stop + 1, marker] + [self.off, 0, 0]
        return Prediction(positions, np.full(stop - start + 2, self.deviation))


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
def test_methods_compete_and_all_are_told(clean, deviation, method):
    recording = distorted(clean, 30.0)
    vague = Vague(clean, off=0.0, deviation=deviation)
    result = mend(
        recording,
        {"slow": [Event(MARKER, START, STOP, 4.0)]},
        methods={**METHODS, "slow": ["local_ridge", "vague"]},
        extra=vague,
    )
    (told,) = result.repairs
    assert told.method == method
    assert expected(told)["vague"] == pytest.approx(1.8 * deviation, abs=1e-3)
    m = clean.markers.index(MARKER)
    assert expected(told)[method] == pytest.approx(result.error[START:STOP, m].max(), abs=1e-3)


@pytest.mark.parametrize("length", [3, 200])
def test_length_decides_between_a_spline_and_the_neighbours(clean, length):
    """Over a few frames of smooth motion the spline is surest, over seconds the neighbours are."""
    recording = distorted(clean, 25.0, START, START + length)
    found = {"noise": [Event(MARKER, START, START + length, 4.0)]}
    result = mend(recording, found, methods={**METHODS, "noise": ["local_ridge", "spline"]}, preference_factor=1.0)
    (told,) = result.repairs
    assert told.method == min(expected(told), key=expected(told).get)
    assert len(expected(told)) == 2
    if length > 100:
        assert told.method == "local_ridge"
    assert error(clean, result, START, START + length).max() < 2


@pytest.mark.parametrize("method", [*SHAPE_COVARIANCES, "savitzky_golay", "local_ridge", "polynomial", *KINDS])
def test_every_repaired_sample_has_an_expected_error(clean, method):
    (made,) = members([method], PredictorOptions()) if method in (*KINDS, "polynomial") else [None]
    recording = distorted(clean, 25.0, 700, 704)
    found = {"steps": [Event(MARKER, 700, 704, 5.0)]}
    decided = [Decision(MARKER, 700, 704, "accept", "step")]
    result = mend(recording, found, methods={**METHODS, "steps": [method]}, extra=made, decisions=decided)
    m = clean.markers.index(MARKER)
    assert expected(result.repairs[0]).keys() == {method}
    assert (result.error[700:704, m] > 0).all() and np.isfinite(result.error[700:704, m]).all()
    assert (result.error95[700:704, m] > result.error[700:704, m]).all()


@pytest.mark.parametrize("limit", [5.0, 100.0])
def test_what_a_repair_would_not_better_stays_as_measured(clean, limit):
    methods = {**METHODS, "slow": ["vague"]}
    result = mend(
        clean,
        {"slow": [Event(MARKER, START, STOP, 1.1)]},
        methods=methods,
        max_error_mm=limit,
        extra=Vague(clean),
    )
    assert np.array_equal(result.positions, clean.positions)
    (left,) = result.repairs_left
    assert left.outcome == "left" and expected(left) == {"vague": 18.0}
    assert "vague: expected error 18.0 mm for a change of 12.0 mm" in left.reason.text


def test_a_sure_repair_away_from_the_neighbours_is_undone_unless_a_person_wants_it(clean):
    recording = distorted(clean, np.array([5.0, 0.0, 0.0]))
    found = {"slow": [Event(MARKER, START, STOP, 1.1)]}
    given = {"methods": {**METHODS, "slow": ["vague"]}, "extra": Vague(clean, off=30.0, deviation=0.1)}
    result = mend(recording, found, **given)
    assert np.array_equal(result.positions, recording.positions)
    assert "30.0 mm from where the neighbours predict it, measured 5.0 mm" in result.repairs_left[0].reason.text
    wanted = mend(recording, found, decisions=[Decision(MARKER, START, STOP, "accept", "slow")], **given)
    assert wanted.repairs[0].method == "vague"


def test_a_swap_that_is_none_is_left(clean):
    swap = [Event("2b", START, STOP, 1.0, "xyz", "3a"), Event("3a", START, STOP, 1.0, "xyz", "2b")]
    result = mend(clean, {"labels": swap})
    assert np.array_equal(result.positions, clean.positions)
    assert [left.marker for left in result.repairs_left] == ["2b", "3a"]
    assert all("no better with labels exchanged" in left.reason.text for left in result.repairs_left)
    wanted = mend(clean, {"labels": swap}, decisions=[Decision("2b", START, STOP, "accept", "swap")])
    assert len(wanted.repairs) == 2


def test_a_swap_that_a_gap_interrupts_is_undone(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    positions[START + 5 : STOP - 5, a] = np.nan
    swap = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]
    result = mend(bodies.recording(clean.markers, positions), {"labels": swap})
    assert len(result.repairs) == 2
    assert np.array_equal(result.positions[:, a], clean.positions[:, a])


def test_a_peak_on_a_slow_change_becomes_a_gap_of_both(walker):
    """Combined forms (skurowski2022 figure 14), as the detectors find them."""

    def bump(length):
        return 30 * np.sin(np.pi * (np.arange(length) + 0.5) / length)[:, None] * [1, 0.4, -0.5]

    recording = put(walker.recording, [("STRN", 200, 280)], bump)
    m = recording.markers.index("STRN")
    recording.positions[240:242, m] += [20.0, -25.0, 10.0]
    found = {
        "peaks": [Event("STRN", 240, 242, 5.0)],
        "slow": [Event("STRN", 200, 280, 3.0)],
    }
    seen, _ = detect(recording, only=("peaks",))
    assert [(e.marker, e.start, e.stop) for e in seen["peaks"]] == [("STRN", 240, 242)]
    result = mend(replace(recording, facts={"recording": "walk"}), found, near=neighbours(recording.positions))
    covered = mask(found["slow"], recording.frames, recording.markers)
    assert np.array_equal(result.origin == MISSING, covered)
    assert np.array_equal(result.positions[~covered], recording.positions[~covered])
    (left,) = result.repairs_left
    assert left.kind == "peak+slow" and left.outcome == "blanked"


def test_a_step_is_taken_off_where_the_neighbours_tell_less_than_the_jumps(clean):
    """A marker on loose skin: the prediction errs by millimetres, the jumps at both ends of a step do not."""
    m, rng = clean.markers.index(MARKER), np.random.default_rng(8)
    loose = gaussian_filter1d(rng.normal(0, 1, (clean.frames, 3)), 12, axis=0)
    positions = clean.positions.copy()
    positions[:, m] += 3.0 * loose / loose.std()
    wobbly = bodies.recording(clean.markers, positions)
    result = mend(distorted(wobbly, np.array([6.0, -5.0, 4.0])), {"steps": [Event(MARKER, START, STOP, 5.0)]})
    (told,) = result.repairs
    assert told.method == "separate_step" and expected(told)["local_ridge"] > 3
    assert error(wobbly, result).max() < 0.8
