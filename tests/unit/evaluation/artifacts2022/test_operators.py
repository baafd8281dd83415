"""Findings of a person against those of the algorithm: both, only one, by class."""

import numpy as np

from markermend.core.events import Event
from markermend.evaluation.artifacts2022 import operators
from markermend.evaluation.artifacts2022.operators import Agreement

HUMAN = {"peaks": [Event("A", 10, 11, 1.0), Event("A", 50, 52, 1.0)], "steps": [Event("B", 100, 150, 1.0)]}
MACHINE = {"peaks": [Event("A", 9, 12, 1.0)], "slow": [Event("B", 140, 200, 1.0), Event("A", 300, 400, 1.0)]}


def test_findings_are_matched_by_marker_and_frames():
    table = operators.compare(HUMAN, MACHINE)
    assert table["peaks"] == Agreement(
        2, 1, human_confirmed=1, same_class=1, algorithm_confirmed=1, only_human=1, only_algorithm=0
    )
    assert table["steps"] == Agreement(
        1, 0, human_confirmed=1, same_class=0, algorithm_confirmed=0, only_human=0, only_algorithm=0
    )
    assert table["slow"] == Agreement(
        0, 2, human_confirmed=0, same_class=0, algorithm_confirmed=0, only_human=0, only_algorithm=2
    )
    assert table["all"] == Agreement(
        3, 3, human_confirmed=2, same_class=1, algorithm_confirmed=1, only_human=1, only_algorithm=2
    )


def test_adjacent_findings_share_no_frame():
    table = operators.compare({"peaks": [Event("A", 5, 10, 1.0)]}, {"peaks": [Event("A", 10, 12, 1.0)]})
    assert table["all"].human_confirmed == 0 and table["all"].only_human == table["all"].only_algorithm == 1


def test_other_classes_have_a_row_of_their_own():
    table = operators.compare({}, {"labels": [Event("A", 5, 10, 1.0)]})
    assert list(table) == ["peaks", "noise", "steps", "slow", "labels", "all"] and table["labels"].only_algorithm == 1


def test_the_synthetic_person_sees_all_that_was_put_in(walker):
    clean = walker.recording
    recording, findings = operators.synthetic_operator(
        clean, amplitude_mm=10, share_percent=10, rng=np.random.default_rng(4)
    )
    changed = (recording.positions != clean.positions).any(axis=2)
    seen = np.zeros(changed.shape, bool)
    for event in (event for own in findings.values() for event in own):
        seen[event.start : event.stop, clean.markers.index(event.marker)] = True
    assert not (changed & ~seen).any() and changed.any()


def test_rows_name_recording_operator_and_detectors():
    table = operators.agreement_rows("walk", "truth", "paper", operators.compare(HUMAN, MACHINE))
    assert list(table.columns) == list(operators.COLUMNS)
    assert table["class"].tolist() == ["peaks", "noise", "steps", "slow", "all"] and set(table["operator"]) == {"truth"}
