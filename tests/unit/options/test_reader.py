"""Options are read from what a person wrote, with all problems; what is written can be read again."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import pytest

from markermend.options.declaration import Changes, Keys, Seconds
from markermend.options.description import describe
from markermend.options.general import DecisionOptions
from markermend.options.reader import BadOptions, Reader, parse
from markermend.options.values import plain, text


@dataclass(frozen=True)
class Part:
    """A part."""

    size: int = 2
    """Size."""


@dataclass(frozen=True)
class Whole:
    """A whole."""

    name: str
    """Name."""

    limit_s: Seconds | None = 1.5
    """Limit."""

    deep: bool = False
    """Deep."""

    kind: Literal["a", "b"] = "a"
    """Kind."""

    lengths: tuple[float, ...] = (1.0, 2.0)
    """Lengths."""

    methods: Annotated[Mapping[str, tuple[str, ...]], Keys(("x", "y"))] = None
    """Methods."""

    changes: Annotated[Mapping[str, Any], Changes(Part)] = None
    """Changes."""

    part: Part = Part()
    """Part."""


OPTIONS = {option.name: option for option in describe(Whole)}


@pytest.mark.parametrize(
    ("name", "words", "value"),
    [
        ("name", "@none", "@none"),
        ("name", "12", "12"),
        ("limit_s", "none", None),
        ("limit_s", "2", 2.0),
        ("deep", "true", True),
        ("kind", "b", "b"),
        ("lengths", "[1, 2.5]", (1.0, 2.5)),
        ("methods", '{"x": ["q"]}', {"x": ("q",)}),
        ("changes", '{"size": 4}', {"size": 4}),
        ("part", '{"size": 5}', Part(5)),
        ("part", "{}", Part()),
    ],
)
def test_a_flag_is_read_and_written(name, words, value):
    read = parse(OPTIONS[name], words)
    assert read == value and type(read) is type(value)
    assert parse(OPTIONS[name], text(plain(read))) == value


@pytest.mark.parametrize(
    ("name", "words", "problem"),
    [
        ("limit_s", "soon", "limit_s: 'soon' is not a number of seconds, such as 1.5"),
        ("deep", "yes", "deep: 'yes' is not true or false, such as false"),
        ("kind", "c", "kind: 'c' is none of a, b"),
        ("lengths", "1", "lengths: 1 is not a list of numbers, such as [1, 2]"),
        ("part", "[]", "part: [] is not a mapping of keys to values"),
        ("part", '{"sizes": 1}', "part.sizes: there is no such key; did you mean size?"),
        ("methods", "[]", "methods: [] is not a mapping of names to lists of texts"),
    ],
)
def test_a_flag_that_cannot_be_used_says_so(name, words, problem):
    with pytest.raises(BadOptions, match="^" + problem.replace("[", r"\[").replace("?", r"\?")):
        parse(OPTIONS[name], words)


def test_the_decisions_on_a_recording_are_read_from_their_flag():
    (option,) = describe(DecisionOptions)
    decided = {"marker": "M2", "first_frame": 81, "last_frame": 81, "decision": "reject", "value": "peak"}
    assert parse(option, text([decided])) == (decided,)
    assert parse(option, "[]") == ()


def test_a_class_is_read_whole_and_what_is_required_is_missed():
    reader = Reader()
    whole = reader.read_class(Whole, {"name": "n", "part": {"size": 3.0}}, "place")
    assert whole.part.size == 3 and isinstance(whole.part.size, int) and reader.problems == []
    assert reader.read_class(Whole, {}, "place") is None
    assert reader.problems == ["place.name: missing"]


def test_plain_values_are_those_of_json():
    assert plain(Whole("n", changes={}, methods={"x": ("a",)})) == {
        "name": "n",
        "limit_s": 1.5,
        "deep": False,
        "kind": "a",
        "lengths": [1.0, 2.0],
        "methods": {"x": ["a"]},
        "changes": {},
        "part": {"size": 2},
    }
