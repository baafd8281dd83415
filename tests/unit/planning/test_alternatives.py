"""One expression matches many names, and nothing else."""

import re

import pytest

from markermend.planning.alternatives import any_of

NAMES = [f"S{number % 7}/walk {number}.{number % 3}(*)/" for number in range(300)] + [
    "S1/a/",
    "S1/ab/",
    "/",
    "S/[x]|y/",
]


@pytest.mark.parametrize("names", [NAMES, NAMES[:1], NAMES[-4:]])
def test_names_are_matched_and_no_others(names):
    pattern = re.compile(any_of(names))
    for name in {*NAMES, "", "S", "S1/", "S1/walk 1.1(*)", "S1/walk 1", "S9/walk 1.1(*)/"}:
        found = pattern.match(f"{name}01_markers.parquet")
        assert (found and found[0]) == (name if name in names else None)


def test_what_is_common_is_written_once():
    assert any_of(["S1/a/", "S1/b/", "S2/a/"]) == "S(?:1/(?:a/|b/)|2/a/)"
