"""A person's decisions in repair: what is confirmed is repaired whatever the limits, what is kept is kept bit for bit."""

import numpy as np
import pytest

from markermend.core.decisions import EVER, Decision
from markermend.core.events import Event
from markermend.core.recording import MISSING, ORIGINS, changed
from markermend.prediction.scene import Prediction
from support.repairs import MARKER, METHODS, START, STOP, body, distorted, error, mend

SLOW = {"slow": [Event(MARKER, START, STOP, 4.0)]}
SWAP = [Event("2b", START, STOP, 9.0, "xyz", "3a"), Event("3a", START, STOP, 9.0, "xyz", "2b")]


def decide(verb, value="", note="", marker=MARKER, start=START, stop=STOP):
    return Decision(marker, start, stop, verb, value, note)


@pytest.fixture(scope="module")
def clean():
    return body()


@pytest.fixture(scope="module")
def drifting(clean):
    return distorted(clean, 20.0)


class Vague:
    """A predictor that says the marker is 12 mm off, give or take 10 mm (standard deviation)."""

    name, continuous = "vague", True

    def __init__(self, recording):
        self.positions = recording.positions

    def predict(self, scene, marker, start, stop):
        return Prediction(self.positions[start - 1 : stop + 1, marker] + [12, 0, 0], np.full(stop - start + 2, 10.0))


@pytest.mark.parametrize(
    "limits", [{"max_altered_share": 0.00001}, {"max_error_mm": 1e-6}, {"max_repair_s": 0.1}, {}], ids=str
)
def test_what_a_person_accepts_is_repaired_whatever_the_limits(clean, drifting, limits):
    result = mend(drifting, SLOW, decisions=[decide("accept", note="taped")], **limits)
    assert error(clean, result).max() < 1
    (repair,) = result.repairs
    assert (repair.method, repair.decisions) == ("local_ridge", ("accept (taped)",))
    assert result.repairs_left == []


def test_the_limit_still_holds_for_all_else(clean, drifting):
    other = Event("1a", 900, 940, 5.0)
    found = {"slow": [*SLOW["slow"], other]}
    result = mend(drifting, found, decisions=[decide("accept")], max_altered_share=0.00001)
    assert [repair.marker for repair in result.repairs] == [MARKER]
    (left,) = result.repairs_left
    assert left.marker == "1a" and "repair.max_altered_share" in left.reason.text and not left.decisions


def test_no_guard_vetoes_a_person(clean):
    methods = {**METHODS, "slow": ["vague"]}
    result = mend(clean, SLOW, methods=methods, extra=Vague(clean), decisions=[decide("accept")])
    assert np.allclose(error(clean, result), 12)
    assert result.error[START, clean.markers.index(MARKER)] == pytest.approx(18.0)


def test_what_a_person_rejects_stays_as_measured(drifting):
    result = mend(drifting, SLOW, decisions=[decide("reject", "slow", "he hops")])
    assert not changed(drifting, result).any() and result.repairs == []
    (left,) = result.repairs_left
    assert (left.reason.text, left.outcome) == ("a person decided: reject slow (he hops)", "left")
    assert left.decisions == ("reject slow (he hops)",)
    assert mend(drifting, SLOW, decisions=[decide("reject", "peak")]).repairs


def test_a_rejected_swap_stays_on_both_markers(clean):
    result = mend(clean, {"labels": SWAP}, decisions=[decide("reject", "swap", marker="3a")])
    assert not changed(clean, result).any()
    assert [left.marker for left in result.repairs_left] == ["2b", "3a"]


def test_protected_frames_stay_and_what_is_around_them_is_repaired(clean, drifting):
    protect = decide("protect", start=610, stop=615)
    result = mend(drifting, SLOW, decisions=[protect, decide("accept")])
    m = clean.markers.index(MARKER)
    assert np.array_equal(result.positions[610:615, m], drifting.positions[610:615, m])
    assert [(r.start, r.stop) for r in result.repairs] == [(START, 610), (615, STOP)]
    (left,) = result.repairs_left
    assert (left.start, left.stop, left.reason.text) == (610, 615, "a person decided: protect")


def test_a_class_that_a_person_sets_replaces_what_was_found(clean):
    recording = distorted(clean, np.array([9.0, -4.0, 2.0]))
    found = {"noise": [Event(MARKER, START - 3, START + 9, 2.0)], "slow": [Event(MARKER, STOP - 5, STOP + 2, 3.0)]}
    result = mend(recording, found, decisions=[decide("class", "step")])
    (repair,) = result.repairs
    assert (repair.kind, repair.method, repair.start, repair.stop) == (
        "step",
        "separate_step",
        START,
        STOP,
    )
    assert error(clean, result).max() < 0.3
    assert {left.reason.text for left in result.repairs_left} == {"a person decided: class step"}


def test_an_artifact_that_no_detector_saw(clean, drifting):
    result = mend(drifting, {}, decisions=[decide("class", "slow")])
    assert error(clean, result).max() < 1
    m = clean.markers.index(MARKER)
    assert (result.origin[START:STOP, m] == ORIGINS.index("slow")).all()


def test_a_swap_that_no_detector_saw(clean):
    a, b = clean.markers.index("2b"), clean.markers.index("3a")
    positions = clean.positions.copy()
    positions[START:STOP, [a, b]] = positions[START:STOP, [b, a]]
    recording = distorted(clean, 0.0)
    recording.positions[:] = positions
    result = mend(recording, {}, decisions=[decide("class", "swap:3a")])
    assert np.array_equal(result.positions, clean.positions)
    assert [repair.decisions for repair in result.repairs] == [("class swap:3a",)] * 2


@pytest.mark.parametrize("method", ["linear", "spline", "savitzky_golay"])
def test_the_method_is_the_persons(drifting, method):
    result = mend(drifting, SLOW, decisions=[decide("method", method)])
    (repair,) = result.repairs
    assert (repair.method, repair.decisions) == (method, (f"method {method}",))


def test_one_method_for_kinds_that_overlap(clean, drifting):
    found = {"peaks": [Event(MARKER, 610, 613, 2.0)], **SLOW}
    result = mend(drifting, found, decisions=[decide("method", "local_ridge")])
    (repair,) = result.repairs
    assert (repair.kind, repair.start, repair.stop, repair.score) == ("slow", START, STOP, 4.0)
    assert error(clean, result).max() < 1


def test_a_method_that_only_fills_makes_a_gap(clean, drifting):
    result = mend(drifting, SLOW, decisions=[decide("method", "kalman")])
    m = clean.markers.index(MARKER)
    assert np.isnan(result.positions[START:STOP, m]).all()
    (left,) = result.repairs_left
    assert (left.reason.text, left.outcome) == ("to be filled by kalman", "blanked")


def test_leave_leaves(drifting):
    assert not changed(drifting, mend(drifting, SLOW, decisions=[decide("method", "leave")])).any()


def test_what_a_person_declares_missing_is_taken_away_and_not_believed(clean, drifting):
    result = mend(drifting, {}, decisions=[decide("missing")])
    m = clean.markers.index(MARKER)
    assert (result.origin[START:STOP, m] == MISSING).all()
    assert np.count_nonzero(changed(drifting, result)) == STOP - START
    (left,) = result.repairs_left
    assert (left.kind, left.outcome, left.decisions) == ("missing", "blanked", ("missing",))


def test_static_recordings_and_protected_markers_are_stronger(clean, drifting):
    everything = [
        decide("accept"),
        decide("missing", start=700, stop=710),
        decide("class", "noise", start=800, stop=820),
    ]
    assert not changed(drifting, mend(drifting, SLOW, decisions=everything, protect=["2*"])).any()
    static = type(drifting)(drifting.markers, drifting.positions, drifting.rate, facts={"kind": "static"})
    assert not changed(static, mend(static, SLOW, decisions=everything)).any()


def test_decisions_on_other_markers_change_nothing(drifting):
    plain = mend(drifting, SLOW)
    others = [Decision("0a", -EVER, EVER, verb) for verb in ("accept", "reject", "protect")]
    result = mend(drifting, SLOW, decisions=[*others, Decision("?zzz", 0, 9, "missing")])
    assert np.array_equal(plain.positions, result.positions) and plain.changes == result.changes
