"""What all pages share: the recordings in order, and every line of the table of decisions."""

import json

import pytest

from markermend.planning.recordings import BadDataSet
from markermend.report.data_set_file import data_set_script, read_decisions
from support.html_pages import HOSTILE

SUMMARIES = [
    {"page": "S/calm/page.html", "recording": "calm", "subject": "S", "attention": 1.0},
    {"page": "S/x/page.html", "recording": HOSTILE, "subject": "S"},
    {"page": "S/bad/page.html", "recording": "bad", "subject": "S", "attention": 9.0},
]


def test_the_script_sets_recordings_in_order_and_decisions():
    line = ["calm", "LANK", "1", "2", "reject", "peak", HOSTILE, "S"]
    script = data_set_script(SUMMARIES, [line])
    name, _, value = script.partition(" = ")
    content = json.loads(value.removesuffix(";\n"))
    assert name == "globalThis.markermendDataSet" and script.count("\n") == 1
    assert [names for _, *names in content["recordings"]] == [[HOSTILE, "S"], ["bad", "S"], ["calm", "S"]]
    assert content["decisions"] == [line] and content["columns"][0] == "recording"


def test_lines_have_a_cell_for_every_column(tmp_path):
    (tmp_path / "d.tsv").write_text("marker\trecording\tdecision\n'=LANK\twalk\tprotect\n")
    assert read_decisions(tmp_path / "d.tsv") == [["walk", "=LANK", "", "", "protect", "", "", "", "", ""]]
    (tmp_path / "d.tsv").write_text("marker\n")
    with pytest.raises(BadDataSet, match="no column recording"):
        read_decisions(tmp_path / "d.tsv")
