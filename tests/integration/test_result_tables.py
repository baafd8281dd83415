"""Tables of benchmark results come back as written, and what differs between two of them is named."""

import pytest

from benchmarks.support import result_tables
from support.paths import PROJECT

ROWS = [
    {"condition": "g3_L1", "error_mm": 4.5, "note": None, "gaps": 3},
    {"condition": "sp2_10", "error_mm": float("nan"), "note": "slow", "gaps": 2},
]


def test_rows_come_back_as_text(tmp_path):
    result_tables.write(tmp_path / "a.tsv", ROWS)
    assert result_tables.read(tmp_path / "a.tsv") == [
        {"condition": "g3_L1", "error_mm": "4.5", "note": "", "gaps": "3"},
        {"condition": "sp2_10", "error_mm": "", "note": "slow", "gaps": "2"},
    ]


def test_differences_are_named(tmp_path):
    result_tables.write(tmp_path / "a.tsv", ROWS)
    result_tables.write(
        tmp_path / "b.tsv", [{**ROWS[0], "error_mm": 4.55, "note": "x"}, {**ROWS[1], "condition": "new"}]
    )
    old, new = (result_tables.read(tmp_path / f"{name}.tsv") for name in "ab")
    found = list(result_tables.differences(old, new, keys=["condition"], within=0.02))
    assert found == [
        "g3_L1: note was empty, is x",
        "sp2_10: only in the old table",
        "new: only in the new table",
    ]
    assert list(result_tables.differences(old, old, keys=["condition"], within=0.0)) == []


@pytest.mark.parametrize("path", sorted((PROJECT / "benchmarks/results").glob("*.tsv")), ids=lambda path: path.stem)
def test_every_result_is_a_complete_table(path):
    rows = result_tables.read(path)
    assert rows and all(None not in row and None not in row.values() for row in rows)
