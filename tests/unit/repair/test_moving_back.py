"""Markers that are displaced together are moved back as one body, or left with the reason."""

import numpy as np
import pytest

from markermend.core.decisions import Decision
from markermend.core.events import Event
from markermend.core.reasons import Cause
from markermend.core.recording import ORIGINS, changed
from support.repairs import METHODS, body, mend

SHIFT = np.array([12.0, -5.0, 8.0])
START, STOP = 500, 560
WITH_MOVING = {**METHODS, "frames": ["move_back", "spline"]}


@pytest.fixture(scope="module")
def clean():
    return body()


def displaced(clean, kind, stop):
    positions = clean.positions.copy()
    positions[START:stop] += SHIFT
    found = [Event(name, START, stop, 4.0, kind=kind, group="all", amount_mm=15.3) for name in clean.markers]
    return type(clean)(clean.markers, positions, clean.rate, facts=clean.facts), {"frames": found}


def test_a_jump_is_moved_back_and_nothing_else(clean):
    recording, found = displaced(clean, "jump", STOP)
    result = mend(recording, found, methods=WITH_MOVING)
    off = np.linalg.norm(result.positions - clean.positions, axis=2)
    assert off[START:STOP].max() < 0.3 and not off[:START].any() and not off[STOP:].any()
    assert {(one.kind, one.method, one.group) for one in result.repairs} == {("jump", "move_back", "all")}
    assert (result.origin[START:STOP] == ORIGINS.index("jump")).all()
    share = (off[START:STOP] <= result.error95[START:STOP]).mean()
    assert share > 0.9


def test_a_shift_is_left_with_its_amount_unless_a_person_accepts_it(clean):
    recording, found = displaced(clean, "shift", len(clean.positions))
    left = mend(recording, found, methods=WITH_MOVING)
    assert not changed(recording, left).any()
    assert {(one.reason.cause, one.group) for one in left.repairs_left} == {(Cause.REPORTED, "all")}
    assert left.repairs_left[0].reason.text.startswith("displaced by 15.3 mm: ")
    accepted = mend(
        recording, found, methods=WITH_MOVING, decisions=[Decision("*", START, START + 1, "accept", "shift")]
    )
    assert np.abs(accepted.positions - clean.positions).max() < 0.5


def test_a_person_may_reject_or_protect(clean):
    recording, found = displaced(clean, "jump", STOP)
    first = clean.markers[0]
    rejected = mend(recording, found, methods=WITH_MOVING, decisions=[Decision(first, START, STOP, "reject", "jump")])
    assert not changed(recording, rejected).any()
    protected = mend(recording, found, methods=WITH_MOVING, protect=[first])
    altered = changed(recording, protected).any(axis=0)
    assert not altered[0] and altered[1:].all()


def test_without_the_method_they_become_missing_and_without_neighbours_they_are_left(clean):
    recording, found = displaced(clean, "jump", STOP)
    assert np.isnan(mend(recording, found, methods={**METHODS, "frames": []}).positions[START:STOP]).all()
    recording.positions[:START] = np.nan
    recording.positions[STOP:] = np.nan
    left = mend(recording, found, methods=WITH_MOVING).repairs_left
    assert {one.reason.cause for one in left} == {Cause.NO_METHOD}


def test_markers_that_slip_together_are_repaired_together(clean):
    positions = clean.positions.copy()
    members = [clean.markers.index(name) for name in ("2a", "2b", "2c", "2d")]
    positions[600:604, members] += SHIFT
    recording = type(clean)(clean.markers, positions, clean.rate, facts=clean.facts)
    found = {"frames": [Event(clean.markers[m], 600, 604, 3.0, kind="slip", group="2") for m in members]}
    result = mend(recording, found, methods=WITH_MOVING)
    assert {(one.kind, one.method) for one in result.repairs} == {("slip", "spline")} and len(result.repairs) == 4
    assert np.abs(result.positions - clean.positions).max() < 1
