"""What persons found is read from tables of decisions and of findings, and what means nothing there is named."""

from dataclasses import replace

import pytest

from markermend.core.events import Event
from markermend.evaluation.artifacts2022.operator_tables import read_operator
from markermend.planning.recordings import BadDataSet


def test_a_table_of_decisions_is_read(tmp_path, walker):
    recording = replace(walker.recording, facts={**walker.recording.facts, "first_frame": 1})
    a, b = recording.markers[:2]
    table = tmp_path / "decisions.tsv"
    table.write_text(
        "recording\tmarker\tfirst_frame\tlast_frame\tdecision\tvalue\n"
        f"walk\t{a}\t11\t20\tclass\tstep\nwalk\t{b}\t31\t31\taccept\tpeak\n"
        f"walk\t{b}\t50\t60\tprotect\t\nother\t{a}\t5\t6\tclass\tnoise\nwalk\t{a}\t90\t95\tmissing\t\n"
    )
    found = read_operator(table, "walk", recording)
    first = recording.first_frame
    assert {kind: [(e.marker, e.start, e.stop) for e in own] for kind, own in found.items()} == {
        "steps": [(a, 11 - first, 21 - first)],
        "peaks": [(b, 31 - first, 32 - first)],
    }


def test_a_table_of_findings_is_read(tmp_path, walker):
    recording = walker.recording
    a, first = recording.markers[0], recording.first_frame
    table = tmp_path / "changes.tsv"
    table.write_text(
        "recording\tmarker\tfirst_frame\tlast_frame\tclass\n"
        f"walk\t{a}\t{first + 10}\t{first + 10}\tpeak\nwalk\t{a}\t{first + 20}\t{first + 29}\tslow\n"
        f"walk\t{a}\t{first + 50}\t{first + 60}\tfilled\nother\t{a}\t5\t6\tnoise\n"
        f"walk\tbehind the end\t{first + recording.frames}\t{first + recording.frames}\tpeak\n"
    )
    assert read_operator(table, "walk", recording) == {
        "peaks": [Event(a, 10, 11, 1.0)],
        "slow": [Event(a, 20, 30, 1.0)],
    }


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("walk,nobody,1,2,peak", "line 2, column marker: 'nobody' is none of the recording"),
        ("walk,,1,2,peak", "line 2, column marker: is empty"),
        ("walk,C7,1,2,peek", "line 2, column class: 'peek' is none of .*; did you mean 'peak'"),
        ("walk,C7,1,two,peak", "line 2, column last_frame: 'two' is not a frame number"),
        ("walk,C7,,,peak", "line 2, column first_frame: is empty"),
        ("walk,C7,9,8,peak", "line 2, column last_frame: 8 comes before the first, 9"),
        ("walk,C7,-5,8,peak", "line 2, column first_frame: the recording begins at"),
    ],
)
def test_findings_that_mean_nothing_are_named(tmp_path, walker, line, problem):
    table = tmp_path / "findings.csv"
    table.write_text(f"recording,marker,first_frame,last_frame,class\n{line}\n")
    with pytest.raises(BadDataSet, match=problem):
        read_operator(table, "walk", walker.recording)


def test_recordings_are_found_by_their_names_whatever_their_folders_are_called(tmp_path, walker):
    table = tmp_path / "findings.tsv"
    table.write_text(
        "subject\trecording\tmarker\tfirst_frame\tlast_frame\tclass\n"
        "S 1\twalk 1\tC7\t10\t12\tpeak\nS2\twalk 1\tC7\t20\t22\tpeak\n\t\tC7\t30\t32\tpeak\n"
    )
    found = [
        sum(map(len, read_operator(table, name, walker.recording).values()))
        for name in ("walk%201", "S%201_walk%201", "walk")
    ]
    assert found == [2, 1, 0]
