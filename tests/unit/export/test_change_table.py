"""changes.tsv: one row for each change, in the capture program's frames, with figures for people."""

import csv
import io

import numpy as np

from markermend.core.changes import Alternative, Change, Outcome
from markermend.core.recording import Recording
from markermend.export.change_table import COLUMNS, change_table

CHANGES = [
    Change(
        "A", 5, 9, ("step",), Outcome.REPAIRED, 3.0004, "xz", None, "offset",
        (Alternative("offset", 0.5), Alternative("local_ridge", 2.345)),
        samples=4, largest_change_mm=20.785, expected_error_mm=0.5, decisions=("accept (hop)", "method offset"),
    ),
    Change("A", 12, 14, ("swap",), Outcome.EXCHANGED, 9.0, "xyz", "B", "swap", samples=2, largest_change_mm=80.0),
    Change("B", 20, 25, ("gap",), Outcome.FILLED, method="linear", samples=5, expected_error_mm=1.5),
    Change('C"\t\n', 30, 32, ("peak", "slow"), Outcome.BLANKED, 2.0, "y", samples=2),
]  # fmt: skip


def rows(changes):
    recording = Recording((), np.empty((0, 0, 3)), 100.0, 701, {"recording": "walk"})
    return list(csv.DictReader(io.StringIO(change_table(changes, recording), newline=""), delimiter="\t"))


def test_frames_are_the_capture_programs_and_both_are_part_of_the_change():
    assert [(r["marker"], r["class"], r["method"], r["first_frame"], r["last_frame"]) for r in rows(CHANGES)] == [
        ("A", "step", "offset", "706", "709"),
        ("A", "swap", "swap", "713", "714"),
        ("B", "filled", "linear", "721", "725"),
        ('C"\t\n', "peak+slow", "blanked", "731", "732"),
    ]


def test_figures_are_blank_where_there_are_none():
    step, swap, fill, blanked = rows(CHANGES)
    assert (step["recording"], step["start_s"], step["stop_s"], step["score"]) == ("walk", "0.05", "0.09", "3.0")
    assert (step["largest_change_mm"], step["expected_error_mm"], step["samples"]) == ("20.785", "0.5", "4")
    assert step["alternatives"] == "local_ridge 2.3 mm; offset 0.5 mm"
    assert step["decision"] == "accept (hop); method offset"
    assert (fill["score"], fill["largest_change_mm"], fill["alternatives"]) == ("", "", "")
    assert [row["axes"] for row in (step, swap, blanked)] == ["xz", "xyz", ""]
    assert (swap["partner"], blanked["partner"]) == ("B", "")


def test_without_changes_there_is_a_header():
    assert change_table([], Recording((), np.empty((0, 0, 3)), 1.0)) == "\t".join(COLUMNS) + "\n"
