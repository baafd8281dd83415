"""Units, rates and counts of a header."""

import pytest

from markermend.core.recording import BadRecording
from markermend.formats.text.header_values import count_named, rate_named, unit_named
from markermend.formats.text.lines import Sheet

SHEET = Sheet("walk.trc", b"", (b"",), b"\n", "utf-8")


def test_units() -> None:
    assert unit_named(SHEET, " Meters ") == "m"
    with pytest.raises(BadRecording, match=r"walk\.trc: the unit 'furlong'"):
        unit_named(SHEET, "furlong")


@pytest.mark.parametrize(
    ("text", "rate"), [("100", 100.0), ("59,94", 59.94), ("0", None), ("-1", None), ("1e999", None)]
)
def test_rates(text: str, rate: float | None) -> None:
    assert rate_named(text) == rate


@pytest.mark.parametrize(("text", "count"), [("30", 30), ("", None), ("-3", None), ("3.0", None), ("9" * 13, None)])
def test_counts(text: str, count: int | None) -> None:
    assert count_named(text) == count
