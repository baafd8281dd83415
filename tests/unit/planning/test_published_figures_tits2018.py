"""The published figures of tits2018: their columns, and that they are what was printed."""

import csv

import pytest

from support.paths import PROJECT

PATH = PROJECT / "config/evaluate/published/tits2018.tsv"


def rows():
    with PATH.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter="\t"))


def test_the_columns():
    found = rows()
    assert list(found[0]) == ["table", "sequence", "condition", "method", "value"]
    keys = [tuple(row.values())[:4] for row in found]
    assert len(set(keys)) == len(keys)
    assert all(row["table"] and row["method"] and row["value"] for row in found)


def test_the_constraints_of_tits2018_reduce_the_error_in_every_row():
    values = {(row["table"], row["sequence"], row["method"]): row["value"] for row in rows()}
    for table, largest in (("Table 2", 2.1), ("Table 3", 41.7)):
        gains = [
            float(values[table, sequence, "pma_1_2_3_4_unconstrained"]) - float(values[table, sequence, "pma_1_2_3_4"])
            for sequence in ("HDM1", "HDM2", "HDM3", "HDM4", "HDM5", "CMU1", "CMU2", "CMU3")
        ]
        assert min(gains) > 0 and max(gains) == pytest.approx(largest, abs=0.051)
