"""Labels are printable, unique and distinguished from unlabelled trajectories."""

from hypothesis import given, settings
from hypothesis import strategies as st

from markermend.formats.labels import is_unlabelled, tidy_labels

PATTERNS = [r"\*\d*", r"[CU]_\d+", r"unlabell?ed.*"]


def test_labels_are_stripped():
    assert tidy_labels(["LASI  ", " RASI", "C7\0\0"]) == (["LASI", "RASI", "C7"], [])


def test_repeated_labels_are_numbered_and_warned_of():
    names, warnings = tidy_labels(["LASI", "RASI", "LASI ", "LASI"])
    assert names == ["LASI", "RASI", "LASI#2", "LASI#3"]
    assert len(warnings) == 1 and "LASI" in warnings[0] and "RASI" not in warnings[0]


def test_a_number_that_a_label_already_has_is_not_given_again():
    names, _ = tidy_labels(["A", "A", "A#2", "A#2", "unnamed#1", ""])
    assert names == ["A", "A#3", "A#2", "A#2#2", "unnamed#1", "unnamed#2"]


def test_empty_labels_are_named():
    names, warnings = tidy_labels(["", "C7", "   "])
    assert names == ["unnamed#1", "C7", "unnamed#2"]
    assert warnings == ["2 trajectories have an empty label and were named unnamed#1 and so on."]


def test_control_characters_become_blanks():
    names, warnings = tidy_labels(["L\nASI", "R\tKNE", "T\x1b10"])
    assert names == ["L ASI", "R KNE", "T 10"]
    assert "L ASI" in warnings[0]


@settings(max_examples=200, deadline=None)
@given(st.lists(st.text(alphabet="A#12 \n\x00é", max_size=4), max_size=12))
def test_names_are_unique_printable_and_stable(raw):
    names, _ = tidy_labels(raw)
    assert len(names) == len(raw) == len(set(names))
    assert all(name and name.isprintable() and name == name.strip() for name in names)
    assert tidy_labels(names) == (names, [])


def test_unlabelled_trajectories_are_recognised():
    for name in ["*12", "*", "*0#2", "Anna:*3", "C_12", "u_7", "Unlabeled 1033", "unlabelled:8"]:
        assert is_unlabelled(name, PATTERNS), name
    for name in ["C7", "LASI", "C_7_left", "Anna:LASI", "U", "T*1"]:
        assert not is_unlabelled(name, PATTERNS), name
    assert not is_unlabelled("*12", [])
