"""Types of options in words."""

from collections.abc import Mapping
from typing import Literal

from markermend.options.declaration import Seconds
from markermend.options.type_words import spell


def test_types_in_words():
    assert spell(tuple[Seconds, ...]) == "a list of numbers of seconds"
    assert spell(Mapping[str, int]) == "a mapping of names to whole numbers"
    assert spell(Literal["a", "b"]) == "one of a, b"
    assert spell(int | None) == "a whole number"
