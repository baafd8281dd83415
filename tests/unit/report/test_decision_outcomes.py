"""What a person is told about the decisions: how much each settled, and which did nothing and why."""

import csv
import io

import numpy as np
import pytest

from markermend.core.changes import Change, Outcome
from markermend.core.recording import Recording
from markermend.planning.decision_table import COLUMNS
from markermend.report.decision_outcomes import drafts, outcomes

CHANGES = [
    Change("LANK", 4, 6, ("peak",), Outcome.REPAIRED, decisions=("accept (hop)",)),
    Change("LANK", 8, 9, ("peak",), Outcome.LEFT, decisions=("reject peak",)),
    Change("RANK", 2, 4, ("gap",), Outcome.FILLED, decisions=("method spline", "accept gap")),
    Change("RANK", 7, 9, ("gap",), Outcome.LEFT),
]


def result(**facts):
    own = {"recording": "walk", "subject": "Bob", **facts}
    return Recording(("LANK", "RANK"), np.zeros((10, 2, 3)), 100.0, 701, own)


def decide(verb, value="", marker="LANK", first=701, last=710, note=""):
    parts = {"marker": marker, "decision": verb, "value": value, "note": note, "first_frame": first, "last_frame": last}
    return {name: part for name, part in parts.items() if part not in ("", None)}


@pytest.mark.parametrize(
    ("entry", "settled"),
    [
        (decide("accept", note="hop"), 1),
        (decide("reject", "peak", marker="*"), 1),
        (decide("method", "spline", marker="?ANK", first=None, last=None), 1),
        (decide("accept", "gap", marker="RANK"), 1),
        (decide("protect"), 0),
    ],
)
def test_a_decision_that_did_something_is_no_warning(entry, settled):
    (outcome,) = outcomes([entry], result(), CHANGES)
    assert (outcome.settled, outcome.warning) == (settled, None)


@pytest.mark.parametrize(
    ("entry", "facts", "warning"),
    [
        (
            decide("accept"),
            {},
            "decision 'accept' on LANK, frames 701 to 710: there is no finding or gap that it changes",
        ),
        (decide("accept", note="hop", first=707), {}, "there is no finding or gap that it changes"),
        (decide("protect", marker="LANKL"), {}, "on LANKL, frames 701 to 710: no such marker; did you mean LANK?"),
        (decide("protect", marker="X*", first=None, last=None), {}, "decision 'protect' on X*: no such marker"),
        (decide("protect", first=711, last=720), {}, "the recording has frames 701 to 710"),
        (decide("protect", first=1, last=700), {}, "the recording has frames 701 to 710"),
        (decide("missing"), {"kind": "static"}, "nothing is done to a static recording"),
        (decide("class", "swap:LTOE"), {}, "no such marker: LTOE"),
    ],
)
def test_a_decision_that_did_nothing_says_why(entry, facts, warning):
    (outcome,) = outcomes([entry], result(**facts), CHANGES)
    assert outcome.settled == 0 and outcome.warning.endswith(warning)


def test_lines_for_new_decisions_fit_the_table():
    text = drafts(
        [Change("LANK", 4, 6, ("peak",), Outcome.LEFT), Change('R"A\tNK', 0, 1, ("gap",), Outcome.LEFT)], result()
    )
    rows = [dict(zip(COLUMNS, row, strict=True)) for row in csv.reader(io.StringIO(text), delimiter="\t")]
    assert [(row["recording"], row["subject"], row["decision"]) for row in rows] == [("walk", "Bob", "")] * 2
    assert [(row["marker"], row["first_frame"], row["last_frame"], row["value"]) for row in rows] == [
        ("LANK", "705", "706", ""),
        ('R"A\tNK', "701", "701", "gap"),
    ]
