"""Failures are counted beside the results, one line each."""

from markermend.command.failures import count_failure


def test_each_failure_is_a_line_whatever_its_reason(tmp_path):
    for reason in ("disk full", "a\tb\nc"):
        count_failure(tmp_path / "S01/walk", "fill", reason)
    assert (tmp_path / "S01/walk/failures.tsv").read_text() == "fill\tdisk full\nfill\ta b c\n"
