"""Decisions that cannot both be followed."""

from fnmatch import fnmatchcase
from itertools import product

from hypothesis import given
from hypothesis import strategies as st

from markermend.planning.contradictions import Line, find_contradictions, patterns_overlap

patterns = st.text("ab*?", max_size=4)


@given(patterns, patterns)
def test_patterns_overlap_where_some_name_fits_both(one, other):
    names = ("".join(letters) for length in range(9) for letters in product("ab", repeat=length))
    assert patterns_overlap(one, other) == any(fnmatchcase(name, one) and fnmatchcase(name, other) for name in names)


def line(number, marker, decision, frames=(1, 5)):
    first, last = frames
    return Line(number, {"marker": marker, "decision": decision, "first_frame": first, "last_frame": last})


def test_lines_on_the_same_samples_contradict_each_other():
    lines = [line(2, "LANK", "accept"), line(3, "*", "reject", (5, 7)), line(4, "LANK", "reject", (6, 7))]
    assert list(find_contradictions(lines)) == ["lines 2 and 3 contradict each other: LANK accept, * reject"]


def test_protected_samples_may_have_other_decisions():
    assert not list(find_contradictions([line(2, "LANK", "accept"), line(3, "LANK", "protect")]))
