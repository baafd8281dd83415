"""Markers that were knocked or crept elsewhere are left, or moved back on request, and everything else stays bit for bit."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.artifacts import DETECTORS
from markermend.core.changes import Outcome
from markermend.core.decisions import EVER, Decision
from markermend.core.events import Event
from markermend.core.reasons import Cause
from markermend.core.recording import ORIGINS, Recording
from markermend.options.repair import RepairOptions
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.repair.repair import repair_scene
from support.bodies import RATE
from support.displaced_bodies import FRAMES, NAMES, displaced, onset, scene

CLEAN = displaced("2b", np.zeros(FRAMES))
MARKER = NAMES.index("2b")
ON_REQUEST = replace(RepairOptions(), move_back_lasting=True)


def event(start, stop, kind="displaced", reference="longer part"):
    return Event("2b", start, stop, 2.0, kind=kind, amount_mm=17.0, reference=reference)


def repaired(positions, *found, options=ON_REQUEST, decisions=()):
    recording = Recording(tuple(NAMES), positions, RATE, facts={"recording": "walk"})
    ridge = LocalRidge(options.predictors.local_ridge)
    by_stage = {stage: [] for stage in DETECTORS} | {"steps": list(found)}
    return repair_scene(
        recording,
        scene(positions),
        found=by_stage,
        predictors={"local_ridge": ridge},
        options=options,
        decisions=decisions,
    )


def test_left_as_measured_unless_wanted():
    positions = displaced("2b", onset(1000))
    treated = repaired(positions, event(1000, FRAMES), options=RepairOptions())
    np.testing.assert_array_equal(treated.recording.positions, positions)
    [change] = treated.changes
    assert change.outcome is Outcome.LEFT and change.reason.cause is Cause.REPORTED
    assert "17.0 mm off" in change.reason.text and "for longer" in change.reason.text


@pytest.mark.parametrize("span", [(1000, FRAMES), (0, 500), (400, 900)])
def test_moved_back_with_the_body_and_nothing_else(span):
    course = np.zeros(FRAMES)
    course[slice(*span)] = 1
    positions = displaced("2b", course)
    treated = repaired(positions, event(*span))
    after, inside = treated.recording.positions, slice(*span)
    assert np.linalg.norm(after[inside, MARKER] - CLEAN[inside, MARKER], axis=1).max() < 1.0
    others = np.ones(positions.shape[:2], bool)
    others[inside, MARKER] = False
    np.testing.assert_array_equal(after[others], positions[others])
    assert set(treated.recording.origin[inside, MARKER]) == {ORIGINS.index("displaced")}
    [change] = treated.changes
    assert (change.outcome, change.method) == (Outcome.REPAIRED, "move_back")
    assert change.largest_change_mm == pytest.approx(17, abs=0.5)
    assert 0 < change.expected_error_mm < 2


@pytest.mark.parametrize("first", [False, True])
def test_a_creep_is_moved_back_as_it_rises(first):
    course = onset(900, length=200)
    positions = displaced("2b", 1 - course if first else course)
    found = event(0, 1100, "creep") if first else event(900, FRAMES, "creep")
    after = repaired(positions, found).recording.positions
    assert np.linalg.norm(after[:, MARKER] - CLEAN[:, MARKER], axis=1).max() < 2.0


def test_undecided_is_moved_only_where_a_person_says_so():
    positions, found = displaced("2b", onset(750)), event(750, FRAMES, reference="undecided")
    treated = repaired(positions, found)
    np.testing.assert_array_equal(treated.recording.positions, positions)
    assert treated.changes[0].reason.cause is Cause.UNCERTAIN
    accepted = Decision("2b", -EVER, EVER, "accept", "displaced")
    after = repaired(positions, found, options=RepairOptions(), decisions=[accepted]).recording.positions
    assert np.linalg.norm(after[:, MARKER] - CLEAN[:, MARKER], axis=1).max() < 1.0


def test_what_else_is_found_there_is_repaired_on_the_moved_trajectory():
    positions = displaced("2b", onset(1000))
    positions[1200, MARKER] += 40
    peak = Event("2b", 1200, 1201, 3.0)
    recording = Recording(tuple(NAMES), positions, RATE, facts={"recording": "walk"})
    ridge = LocalRidge(ON_REQUEST.predictors.local_ridge)
    found = {stage: [] for stage in DETECTORS} | {"steps": [event(1000, FRAMES)], "peaks": [peak]}
    options = replace(ON_REQUEST, methods={**ON_REQUEST.methods, "peaks": ("local_ridge",)})
    treated = repair_scene(recording, scene(positions), found=found, predictors={"local_ridge": ridge}, options=options)
    after = treated.recording.positions
    assert treated.recording.origin[1200, MARKER] == ORIGINS.index("peak"), treated.changes
    assert np.linalg.norm(after[1000:, MARKER] - CLEAN[1000:, MARKER], axis=1).max() < 3.0


def test_poses_that_have_nothing_in_common_say_nothing():
    positions = displaced("2b", onset(1000))
    treated = repaired(positions, event(0, FRAMES))
    np.testing.assert_array_equal(treated.recording.positions, positions)
    assert treated.changes[0].reason.cause is Cause.NO_METHOD


def test_limits_do_not_count_what_is_left():
    positions = displaced("2b", onset(1000))
    strict = replace(RepairOptions(), max_altered_share=0.001)
    treated = repaired(positions, event(1000, FRAMES), options=strict)
    assert treated.changes[0].reason.cause is Cause.REPORTED
