"""The cells of one line of the table of decisions."""

import pytest

from markermend.planning.decision_cells import parse
from markermend.planning.tables import Problem, suggestion

LINE = {"recording": "walk", "marker": "LANK", "decision": "reject"}


def test_a_line_becomes_what_the_stages_read():
    row = {**LINE, "first_frame": "7", "last_frame": "9", "value": "peaks", "note": "a  b"}
    expected = {
        "marker": "LANK",
        "decision": "reject",
        "first_frame": 7,
        "last_frame": 9,
        "value": "peak",
        "note": "a b",
    }
    assert dict(parse(row, [])) == expected
    assert dict(parse(LINE, [])) == {"marker": "LANK", "decision": "reject"}


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        ({"decision": "rejects"}, "column decision: 'rejects' is none of .*did you mean 'reject'"),
        ({"first_frame": "7"}, "column last_frame: is empty"),
        ({"first_frame": "x", "last_frame": "9"}, "column first_frame: 'x' is not a frame number"),
        ({"decision": "method", "value": "magic"}, "column value: 'magic' is none of"),
    ],
)
def test_a_cell_that_cannot_be_used_is_named(cells, words):
    with pytest.raises(Problem, match=words):
        dict(parse({**LINE, **cells}, ["spline"]))


def test_a_similar_word_is_suggested():
    assert suggestion("peek", ["peak", "noise"]) == "; did you mean 'peak'?"
    assert suggestion("zzz", ["peak", "noise"]) == ""
