"""The table of decisions: who gets which lines, and every way to be refused, with the place that is wrong."""

import re

import pytest

from markermend.core.decisions import VERBS
from markermend.export import change_table
from markermend.planning.decision_table import COLUMNS, NONE, load, standard_form
from markermend.planning.recordings import BadDataSet, Entry
from support.paths import PROJECT
from support.table_rules import CASES

ENTRIES = [
    Entry("S01", "walk", "/a.c3d"),
    Entry("S01", "run", "/b.c3d"),
    Entry("S02", "walk", "/c.c3d"),
    Entry("Bob B", "jump", "/d.c3d"),
]
METHODS = ("spline", "local_ridge", "kalman")
HEADER = "recording\tmarker\tfirst_frame\tlast_frame\tdecision\tvalue\tnote\tsubject\tby\tdate\n"


def loaded(tmp_path, *lines, header=HEADER):
    path = tmp_path / "decisions.tsv"
    path.write_text(header + "".join(line.replace("|", "\t") + "\n" for line in lines), encoding="utf-8")
    return load(str(path), ENTRIES, METHODS)


def test_each_recording_gets_its_lines_and_nothing_of_the_others(tmp_path):
    decided, warnings = loaded(
        tmp_path,
        "run|LANK|705|720|accept||looks  taped|",
        "walk|L*|||protect|||S02",
        "jump|RTOE|1|2|reject|peaks",
        "",
        "run|LANK|700|704|method|spline",
    )
    assert decided == {
        ("S01", "run"): [
            {"marker": "LANK", "decision": "method", "first_frame": 700, "last_frame": 704, "value": "spline"},
            {"marker": "LANK", "decision": "accept", "first_frame": 705, "last_frame": 720, "note": "looks taped"},
        ],
        ("S02", "walk"): [{"marker": "L*", "decision": "protect"}],
        ("Bob%20B", "jump"): [
            {"marker": "RTOE", "decision": "reject", "first_frame": 1, "last_frame": 2, "value": "peak"}
        ],
    }
    assert warnings == []


def test_order_and_repetition_of_lines_mean_nothing(tmp_path):
    lines = ["run|LANK|705|720|accept", "run|LANK|1|7|reject", "run|A|||protect"]
    assert loaded(tmp_path, *lines) == loaded(tmp_path, *lines[::-1], lines[0])


def test_a_line_says_by_whom_and_when_it_was_decided(tmp_path):
    decided, _ = loaded(tmp_path, "run|LANK|||protect||||  '=A  \u738b |2026-03-31", "run|LTOE|||protect")
    signed = {"marker": "LANK", "decision": "protect", "by": "=A \u738b", "date": "2026-03-31"}
    assert decided["S01", "run"] == [signed, {"marker": "LTOE", "decision": "protect"}]


def test_a_table_without_the_columns_of_names_is_read_as_ever(tmp_path):
    older = HEADER.removesuffix("\tby\tdate\n") + "\n"
    line = "run|LANK|705|720|accept||hop|S01"
    assert loaded(tmp_path, line, header=older) == loaded(tmp_path, line)


def test_a_table_without_lines_decides_nothing(tmp_path):
    assert loaded(tmp_path) == ({}, [])


def test_the_table_that_is_shipped_has_every_column_and_no_line():
    path = PROJECT / "config" / "decisions.tsv"
    assert path.read_text(encoding="utf-8") == "\t".join(COLUMNS) + "\n"
    assert load(str(path), ENTRIES, METHODS) == ({}, [])


def test_places_can_be_copied_from_the_table_of_changes():
    assert COLUMNS[:4] == change_table.COLUMNS[:4]


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("run|LANK|7|9|acept", "line 2, column decision: 'acept' is none of accept, reject,"),  # codespell:ignore
        ("run|LANK|7|9|acept", "did you mean 'accept'?"),  # codespell:ignore
        ("run|LANK|7|9|", "line 2, column decision: is empty"),
        ("|LANK|7|9|accept", "line 2, column recording: is empty"),
        ("run||7|9|accept", "line 2, column marker: is empty"),
        ("run|LANK|9|7|accept", "line 2, column last_frame: 7 comes before the first, 9"),
        ("run|LANK|7||accept", "line 2, column last_frame: is empty: give both frames"),
        ("run|LANK||9|accept", "line 2, column first_frame: is empty: give both frames"),
        ("run|LANK|7.5|9|accept", "line 2, column first_frame: '7.5' is not a frame number"),
        (
            "run|LANK|7|9|accept|peek",
            "line 2, column value: 'peek' is none of swap, foreign, unlabelled, adopted, repeat, jump, shift, slip, frozen, tail,",
        ),
        ("run|LANK|7|9|protect|peak", "line 2, column value: 'peak': protect takes no value"),
        ("run|LANK|7|9|missing|peak", "line 2, column value: 'peak': missing takes no value"),
        ("run|LANK|7|9|class", "line 2, column value: '' is none of foreign, repeat, jump, shift, slip, frozen, tail,"),
        ("run|LANK|7|9|class|gap", "line 2, column value: 'gap' is none of"),
        ("run|LANK|7|9|class|peak:RANK", "line 2, column value: 'peak:RANK' is none of"),
        ("run|LANK|7|9|class|swap", "line 2, column value: 'swap': a swap is between two markers"),
        ("run|L*|7|9|class|swap:RANK", "line 2, column value: 'swap:RANK': a swap is between two markers"),
        ("run|LANK|7|9|class|swap:LANK", "line 2, column value: 'swap:LANK': the other marker is the same"),
        ("run|LANK|||class|peak", "line 2, column first_frame: is empty: an artifact has a first"),
        ("run|LANK|7|9|accept||||A.L.|31.03.2026", "line 2, column date: '31.03.2026' is no day as in 2026-03-31"),
        ("run|LANK|7|9|method|splines", "line 2, column value: 'splines' is none of leave, spline,"),
        ("run|LANK|7|9|method", "line 2, column value: '' is none of leave"),
        ("walk|LANK|7|9|accept", "line 2, column subject: is empty, and 'walk' is a recording of S01, S02"),
    ],
)
def test_what_cannot_be_understood_is_refused_with_its_place(tmp_path, line, problem):
    with pytest.raises(BadDataSet, match=re.escape(problem)):
        loaded(tmp_path, line)


@pytest.mark.parametrize(
    ("header", "problem"),
    [
        ("recording\tmarker\n", "has no column decision; columns are recording, marker, first_frame"),
        (HEADER.replace("note", "comment"), "has column comment, which means nothing; columns are recording"),
        (HEADER.replace("note", "value"), "has column value more than once"),
    ],
)
def test_the_columns_are_known_ones(tmp_path, header, problem):
    with pytest.raises(BadDataSet, match=problem):
        loaded(tmp_path, header=header)


def test_all_problems_are_reported_at_once(tmp_path):
    with pytest.raises(BadDataSet) as error:
        loaded(tmp_path, "run|A|1|2|x", "run|A|5|1|accept", "run|B|1|5|accept", "run|B|5|9|reject")
    lines = str(error.value).splitlines()
    assert lines[0].startswith(f"decisions: {tmp_path}/decisions.tsv cannot be used")
    assert [line.partition(",")[0].partition(" contra")[0] for line in lines[1:]] == [
        "line 2",
        "line 3",
        "lines 4 and 5",
    ]


@pytest.mark.parametrize(
    ("line", "warning"),
    [
        (
            "runn|LANK|7|9|accept",  # codespell:ignore
            "line 2: no recording 'runn' among the recordings; did you mean 'run'?",
        ),  # codespell:ignore
        ("zzz|LANK|7|9|accept", "line 2: no recording 'zzz' among the recordings"),
        ("walk|A|7|9|accept|||S9", "line 2: subject 'S9' has no recording 'walk', but S01, S02 has"),
    ],
)
def test_a_recording_that_is_not_there_is_a_warning(tmp_path, line, warning):
    decided, warnings = loaded(tmp_path, line)
    assert decided == {} and len(warnings) == 1
    assert warnings[0].endswith(warning)


@pytest.mark.parametrize(
    ("one", "other", "clash"),
    [*CASES["decisions"], ["accept|peak", "reject|peaks", True]],
)
def test_lines_that_cannot_both_be_followed_are_refused(tmp_path, one, other, clash):
    # A swap is stated of one marker.
    names = ("LANK", "LANK") if "swap" in one + other else ("L*", "*ANK")
    place = f"run|{names[0]}|10|20|{{}}", f"run|{names[1]}|20|30|{{}}"
    one, other = one.replace(" ", "|"), other.replace(" ", "|")
    for first, second in ((one, other), (other, one)):
        if clash:
            with pytest.raises(BadDataSet, match=r"lines 2 and 3 contradict each other: L.* .*, .*ANK "):
                loaded(tmp_path, place[0].format(first), place[1].format(second))
        else:
            loaded(tmp_path, place[0].format(first), place[1].format(second))
        loaded(tmp_path, place[0].format(first), place[1].replace("20", "21").format(second))
        loaded(tmp_path, place[0].format(first), place[1].replace(names[1], "RANK").format(second))
        loaded(tmp_path, place[0].format(first), place[1].replace("run", "jump").format(second))


def test_more_than_a_command_line_holds_is_refused(tmp_path):
    lines = [f"run|MARKER{n}|{n}|{n}|protect||{'because ' * 12}" for n in range(700)]
    with pytest.raises(BadDataSet, match=r"700 lines on S01/run are too many"):
        loaded(tmp_path, *lines)


def test_every_decision_is_explained_to_people():
    text = (PROJECT / "config" / "README.md").read_text(encoding="utf-8")
    part = text.partition("\n## Decisions")[2].partition("\n## ")[0]
    assert set(VERBS) <= set(re.findall(r"^\| `(\w+)` \|", part, re.MULTILINE))
    assert all(column in part for column in COLUMNS)


def test_the_report_gets_every_line_by_its_meaning(tmp_path):
    path = tmp_path / "decisions.csv"
    path.write_text(
        "marker,recording,decision,value,first_frame,last_frame,note\n\n=A,gone,reject,peaks,07,9, two  words \n"
    )
    assert standard_form(str(path), METHODS) == NONE + "gone\t'=A\t7\t9\treject\tpeak\ttwo words\t\t\t\n"
    path.write_text("recording,marker,decision\n")
    assert standard_form(str(path), METHODS) == NONE
