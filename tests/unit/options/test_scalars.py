"""Numbers and texts are brought into their type, or refused with the bound that they miss and what would do."""

from typing import Any, Literal

import pytest

from markermend.options.declaration import AtLeast, AtMost, NotEmpty, RegularExpression, Unit
from markermend.options.scalars import read_scalar, wrong_type

SECONDS = Unit("s", "seconds")


@pytest.mark.parametrize(
    ("kind", "value", "read"),
    [
        (int, 3.0, 3),
        (float, 2, 2.0),
        (bool, True, True),
        (str, "a", "a"),
        (Literal["a", "b"], "b", "b"),
        (Any, [1], [1]),
    ],
)
def test_values_in_their_type(kind, value, read):
    found, problems = read_scalar(kind, (), value, "place")
    assert (found, type(found), problems) == (read, type(read), [])


@pytest.mark.parametrize(
    ("kind", "marks", "value", "problem"),
    [
        (float, (AtLeast(0), SECONDS), -1.0, "place: -1 is out of bounds; it must be at least 0 s"),
        (float, (AtLeast(0), AtMost(1)), 2.0, "place: 2 is out of bounds; it must be at most 1"),
        (float, (), float("inf"), "place: inf is not a finite number"),
        (float, (SECONDS,), "2", "place: '2' is not a number of seconds, such as 0.5; write 2 without quotes"),
        (int, (), True, "place: True is not a whole number, such as 3"),
        (bool, (), "true", "place: 'true' is not true or false, such as true; write true without quotes"),
        (str, (NotEmpty(),), "", "place: it must not be empty"),
        (str, (RegularExpression(),), "(", "place: '(' is not a regular expression"),
        (Literal["a", "b"], (), "c", "place: 'c' is none of a, b"),
    ],
)
def test_values_that_cannot_be_used(kind, marks, value, problem):
    (found,) = read_scalar(kind, marks, value, "place")[1]
    assert found.startswith(problem)


def test_one_text_in_place_of_a_list():
    assert wrong_type(tuple[str, ...], (), "C7", "place") == "place: 'C7' is not a list of texts, such as [\"C7\"]"
