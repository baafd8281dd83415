"""The outcomes of decisions, on the page and in numbers: how much each settled, and which did nothing and why."""

import csv
import io
from dataclasses import replace

import numpy as np
import pytest

import qc
from markermend.core.changes import Change, Outcome
from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import Recording
from markermend.planning.decision_table import COLUMNS
from markermend.planning.tables import read_table
from markermend.report.decision_outcomes import drafts, outcomes
from support import report_files
from support.html_pages import HOSTILE, Page

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


def test_a_draft_is_read_back_whatever_the_names(tmp_path):
    made = drafts([Change("=A+1", 4, 6, ("peak",), Outcome.LEFT)], result(recording="-walk", subject="@Bob"))
    assert "\t'=A+1\t" in made
    (tmp_path / "decisions.tsv").write_text("\t".join(COLUMNS) + "\n" + made)
    ((_, row),) = read_table(str(tmp_path / "decisions.tsv"), what="decisions", columns=COLUMNS, required=COLUMNS[:2])
    assert (row["recording"], row["marker"], row["subject"]) == ("-walk", "=A+1", "@Bob")


FOUND = {"peaks": [Event("A", 30, 32, 2.0), Event("B", 40, 42, 3.0)]}

ACCEPT = {"marker": "A", "decision": "accept", "note": HOSTILE, "by": "=王 <b>", "date": "2026-03-31"}

REJECT = {"marker": "B", "decision": "reject", "first_frame": 741, "last_frame": 742}

IDLE = {"marker": "C", "decision": "accept"}


@pytest.fixture(scope="module")
def restored():
    """A recording from frame 701 on: a peak of A that a person accepted, one of B that a person rejected."""
    positions = np.random.default_rng(1).normal(0, 100, (60, 3, 3)).cumsum(axis=0)
    before = report_files.named(Recording(("A", "B", "C"), positions, 100.0, 701), "walk", "Bob")
    after = report_files.restore(before, positions + 1, FOUND, error=1.0, keep=("B",))
    repairs = [replace(change, decisions=("accept",)) for change in after.repairs]
    reason = Reason(Cause.DECIDED, "a person decided: reject")
    left = [replace(change, reason=reason, decisions=("reject",)) for change in after.repairs_left]
    return before, replace(after, changes=(*repairs, *left))


@pytest.fixture(scope="module")
def made(restored, tmp_path_factory):
    folder = tmp_path_factory.mktemp("results")
    made = report_files.write(folder, *restored, FOUND, decisions=[ACCEPT, REJECT, IDLE])
    qc.main(made.qc())
    return made


def test_the_page_says_what_was_decided_and_is_not_hurt_by_a_note(made):
    page = Page(made.page)
    assert f"a person decided: accept ({HOSTILE}; =王 <b>, 2026-03-31)" in page.text
    assert made.summary["judged"] == {"events": 2, "by": ["=王 <b>"], "dates": ["2026-03-31"]}
    assert "2 findings, gaps and stretches of frames were treated as decided by =王 <b> (2026-03-31)." in page.text
    assert "a person decided: reject" in page.text
    assert "Decisions</h2>" in made.page and "B, frames 741 to 742" in page.text
    assert {tag for tag, attributes in page.tags if "onerror" in attributes} == set()
    assert "walk\tA\t731\t732\t\t\t\tBob" in made.page


def test_what_a_person_left_needs_no_attention_and_what_did_nothing_does(made):
    summary = made.summary
    assert (summary["decisions"], summary["findings_open"]["events"]) == (3, 0)
    assert summary["warnings"] == ["decision 'accept' on C: there is no finding or gap that it changes"]
    assert summary["attention_parts"]["artifacts left"] == 0


def test_the_methods_text_mentions_decisions_only_where_there_are_some(made, restored, tmp_path):
    assert "the decisions of that person took precedence" in made.summary["methods"]["text"]
    plain = report_files.write(tmp_path, *restored, FOUND)
    qc.main(plain.qc())
    assert "Those that this run followed" in made.page and "Those that this run followed" not in plain.page
