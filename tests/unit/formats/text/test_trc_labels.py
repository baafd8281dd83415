"""Labels of a TRC header find their columns, or the file is refused with the true reason."""

import pytest

from markermend.core.recording import BadRecording
from markermend.formats.text.trc_labels import BETWEEN_BLANKS, IN_ORDER, labelled_columns


@pytest.mark.parametrize(
    ("line", "names", "first", "warnings"),
    [
        ("Frame#\tTime\tA\t\t\tB\t\t", ("A", "B"), 2, ()),
        ("Frame#\tA\t\t\tB\t\t", ("A", "B"), 1, ()),
        ("Frame#\tTime\tA\t\t\t\t\t\tB\t\t", ("A", "", "B"), 2, ()),
        ("Frame#\tTime\tLeft knee\t\t\tB\t\t", ("Left knee", "B"), 2, ()),
        ("Frame#\tTime\tA\tB", ("A", "B"), 2, (IN_ORDER,)),
        ("Frame#\t\tTime\t\tA\t\tB\t\t", ("A", "B"), 2, (IN_ORDER,)),
        ("Frame#\t\tTime\t\t\tA\t\t\tB\t\t", ("A", "B"), 2, (IN_ORDER,)),
        ("Frame#\tTime\tA   B  C", ("A", "B", "C"), 2, (BETWEEN_BLANKS,)),
        ("Frame#\tTime\tLeft knee   Left ankle", ("Left knee", "Left ankle"), 2, (BETWEEN_BLANKS,)),
        ("Frame#\tTime\tA B C", ("A", "B", "C"), 2, (BETWEEN_BLANKS,)),
        ("Frame#\tTime   A   B", ("A", "B"), 2, (BETWEEN_BLANKS,)),
        ("Frame#   Time   A   B", ("A", "B"), 2, (BETWEEN_BLANKS,)),
        ("Frame#   A   B", ("A", "B"), 1, (BETWEEN_BLANKS,)),
        ("Frame#\tTime\tA  B\tC", ("A", "B", "C"), 2, (BETWEEN_BLANKS,)),
    ],
)
def test_labels_and_columns(line: str, names: tuple[str, ...], first: int, warnings: tuple[str, ...]) -> None:
    found = labelled_columns("a.trc", line.split("\t"), width=first + 3 * len(names), promised=len(names))
    assert (found.names, found.first, found.warnings) == (names, first, warnings)
    assert found.starts == [first + 3 * i for i in range(len(names))]


def test_a_label_of_several_words_is_one_where_the_header_states_no_more_markers() -> None:
    found = labelled_columns("a.trc", ["Frame#", "Time", "left knee"], width=8, promised=1)
    assert found.names == ("left knee",)


@pytest.mark.parametrize("width", [11, 14])
def test_blanks_in_labels_above_their_columns_separate_nothing(width: int) -> None:
    """Though the rows have more columns than labels."""
    found = labelled_columns("a.trc", ["Frame#", "Time", "Left  knee", "", "", "B", "", ""], width=width, promised=2)
    assert found.names == ("Left  knee", "B") and found.warnings == ()


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("Frame#\tTime\tA   B   C", r"separated by blanks and give 3 markers, but the rows have 4\."),
        ("Frame#\tTime\tA\tB\tC", "3 labels do not stand above columns"),
        ("Frame#\tTime\t\t\t", "no marker is labelled"),
        ("Frame#", "no marker is labelled"),
    ],
)
def test_refused(line: str, reason: str) -> None:
    with pytest.raises(BadRecording, match=reason):
        labelled_columns("a.trc", line.split("\t"), width=14, promised=4)
