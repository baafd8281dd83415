"""Exchanged labels through detection and repair: undone once for all detectors, and nowhere where they are not looked for."""

from dataclasses import replace

import numpy as np
import pytest

from markermend import api
from markermend.core.recording import changed
from support.signals import put

PAIR, SPAN = ("LTHI", "LKNE"), slice(200, 280)
SUDDEN = ["frozen", "tails", "peaks", "noise"]


@pytest.fixture(scope="module")
def recordings(walker):
    """A part of the walker with peaks, within the span too, and the same with two labels exchanged over the span."""
    whole = walker.recording
    names = [*PAIR, *[name for name in whole.markers if name.startswith("L") and name not in PAIR][:14]]
    columns = [whole.markers.index(name) for name in names]
    facts = {"recording": "walk", "subject": "S", "kind": "dynamic"}
    clean = replace(whole, markers=tuple(names), positions=whole.positions[:500, columns], facts=facts)
    places = [("LTHI", 230, 233), ("LKNE", 250, 251), (names[5], 100, 102)]
    right = put(clean, places, lambda length: np.ones((length, 1)) * [15, 6, -9])
    positions = right.positions.copy()
    positions[SPAN, [0, 1]] = positions[SPAN, [1, 0]]
    return right, replace(right, positions=positions), api.infer_mesh([clean])


def detect(recording, mesh, stages):
    return api.detect(recording, mesh, api.Options.read({"detect": stages}))


def test_all_detectors_find_what_they_find_under_the_right_labels(recordings):
    right, exchanged, mesh = recordings
    found = detect(exchanged, mesh, ["labels", *SUDDEN])
    assert [(event.marker, event.start, event.stop, event.partner) for event in found.pop("labels")] == [
        ("LKNE", 200, 280, "LTHI"), ("LTHI", 200, 280, "LKNE"),
    ]  # fmt: skip
    assert found == detect(right, mesh, SUDDEN)
    assert {event.marker for event in found["peaks"]} >= set(PAIR)


def test_without_the_stage_no_labels_are_exchanged_and_only_what_was_found_is_altered(recordings):
    _, exchanged, mesh = recordings
    found = detect(exchanged, mesh, SUDDEN)
    assert all(event.partner is None for events in found.values() for event in events)
    repaired = api.repair(exchanged, mesh, found)
    touched = np.zeros(exchanged.missing.shape, bool)
    for event in (event for events in found.values() for event in events):
        touched[event.start : event.stop, exchanged.markers.index(event.marker)] = True
    assert not (changed(exchanged, repaired.recording) & ~touched).any()
    assert all("swap" not in change.classes for change in repaired.changes)


def test_where_an_exchange_is_rejected_findings_stay_with_their_samples(recordings):
    _, exchanged, mesh = recordings
    found = detect(exchanged, mesh, ["labels", *SUDDEN])
    reject = [{"marker": "LTHI", "decision": "reject", "value": "swap"}]
    repaired = api.repair(exchanged, mesh, found, decisions=reject)
    peaks = [change for change in repaired.changes if "peak" in change.classes]
    assert {(change.marker, change.start) for change in peaks} >= {("LKNE", 230), ("LTHI", 250)}
    touched = np.zeros(exchanged.missing.shape, bool)
    for change in repaired.changes:
        touched[change.start : change.stop, exchanged.markers.index(change.marker)] |= "swap" not in change.classes
    assert not (changed(exchanged, repaired.recording) & ~touched).any()
