"""A number of things is in the singular for one of them, and in the plural for any other number."""

from markermend.planning.counts import counted


def test_one_thing_is_in_the_singular():
    assert [counted(number, "gap") for number in (0, 1, 2)] == ["0 gaps", "1 gap", "2 gaps"]


def test_thousands_are_separated_on_request():
    assert counted(1200, "gap") == "1200 gaps" and counted(1200, "gap", style=",") == "1,200 gaps"
