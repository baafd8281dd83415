"""Warnings that most recordings have are said once for the data set."""

from markermend.report.shared_warnings import find_shared_warnings, kind_of


def entries(*warnings: list[str], status: str = "cleaned") -> list[dict]:
    return [{"status": status, "warnings": own} for own in warnings]


def test_kinds_differ_in_more_than_numbers() -> None:
    assert kind_of("12 rows lack cells; 1.5 Hz") == kind_of("7 rows lack cells; 100 Hz")
    assert kind_of("Never seen: CLAV.") != kind_of("Never seen: C7.")


def test_a_warning_of_most_recordings_is_said_once_and_left_out_of_each() -> None:
    found = [
        *entries(
            ["3 rows lack cells.", "Never seen: CLAV."],
            ["Never seen: CLAV.", "Never seen: CLAV."],
            ["4 rows lack cells."],
        ),
        *entries(["Odd.", "Never seen: CLAV."]),
        *entries(["Never seen: CLAV."] * 9, ["x"], ["x"], status="set aside"),
    ]
    shared = find_shared_warnings(found)
    assert shared.texts() == ["3 of 4 recordings: Never seen: CLAV."]
    assert [shared.without(entry["warnings"]) for entry in found[:4]] == [
        ["3 rows lack cells."], [], ["4 rows lack cells."], ["Odd."]
    ]  # fmt: skip


def test_the_first_of_a_kind_stands_for_all() -> None:
    shared = find_shared_warnings(entries(["3 rows."], ["4 rows.", "2 rows."], ["5 rows."], []))
    assert shared.texts() == ["3 of 4 recordings: 3 rows."]


def test_few_recordings_share_nothing() -> None:
    assert find_shared_warnings(entries(["x"], ["x"], ["x"])).texts() == []
    assert find_shared_warnings([]).texts() == []
    assert find_shared_warnings(entries(["x"], ["x"], [], [])).texts() == []
