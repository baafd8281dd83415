"""Failures are counted beside the results, one line each."""

import pytest

from markermend.storage.atomic import NotWritten
from markermend.storage.failure_counts import count_failure


def test_each_failure_is_a_line_whatever_its_reason(tmp_path):
    for reason in ("disk full", "a\tb\nc"):
        count_failure(tmp_path / "S01/walk", "fill", reason)
    assert (tmp_path / "S01/walk/failures.tsv").read_text(encoding="utf-8") == "fill\tdisk full\nfill\ta b c\n"


def test_where_a_failure_cannot_be_counted_that_is_said(tmp_path):
    (tmp_path / "S01").write_text("a file in the place of the folder", encoding="utf-8")
    with pytest.raises(NotWritten):
        count_failure(tmp_path / "S01/walk", "fill", "disk full")
