"""Decisions that cannot both be followed."""

from fnmatch import fnmatchcase
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from markermend.planning.contradictions import Line, find_contradictions, patterns_overlap
from markermend.planning.decision_cells import parse
from support.table_rules import CASES

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


@pytest.mark.parametrize(("one", "other", "shared"), CASES["markers"])
def test_names_and_patterns_that_share_a_name_overlap(one, other, shared):
    assert patterns_overlap(one, other) == patterns_overlap(other, one) == shared


@pytest.mark.parametrize(("one", "other", "shared"), CASES["frames"])
def test_stretches_that_share_a_frame_overlap(one, other, shared):
    lines = []
    for number, (frames, verb) in enumerate(((one, "accept"), (other, "reject"))):
        cells = {
            "recording": "r",
            "marker": "LANK",
            "decision": verb,
            "first_frame": frames[0],
            "last_frame": frames[1],
        }
        lines.append(Line(number, dict(parse({name: cell for name, cell in cells.items() if cell}, ()))))
    assert bool(list(find_contradictions(lines))) == shared
