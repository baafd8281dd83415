"""What is declared of options is read back: types, bounds, defaults and texts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import pytest

from markermend.options.config import SECTIONS
from markermend.options.declaration import Above, Laboratory, Seconds, Unit
from markermend.options.description import describe, full_meaning, marked


@dataclass(frozen=True)
class Base:
    """A base."""

    length_s: Seconds = 1
    """Length of
    the whole.

    Change it when it is too
    long (lower)."""

    weight: Annotated[float, Above(0)] = 2
    """Weight."""


@dataclass(frozen=True)
class Derived(Base):
    """Derived."""

    name: Annotated[str, Laboratory] = "x"
    """Name."""

    weight: Annotated[float, Unit("kg", "kilograms")] = 3
    """Weight; any."""


@dataclass(frozen=True)
class Silent:
    """Without a text."""

    weight: float = 1


def test_a_description_has_text_unit_bounds_default_and_tier():
    length, weight = describe(Base)
    assert (length.name, length.kind, length.default) == ("length_s", float, 1)
    assert (length.meaning, length.change_when) == ("Length of the whole", "it is too long (lower)")
    assert marked(length.marks, Unit).symbol == "s" and not length.laboratory
    assert (weight.meaning, weight.change_when, marked(weight.marks, Above).limit) == ("Weight", "", 0)


def test_a_class_keeps_the_texts_of_its_base_and_may_replace_them():
    name, weight, length = describe(Derived)
    assert name.laboratory and (weight.default, full_meaning(weight)) == (3, "Weight [kg]; any")
    assert full_meaning(length) == "Length of the whole [s]"


def test_an_option_without_text_is_an_error():
    with pytest.raises(ValueError, match="weight"):
        describe(Silent)


def nested(cls):
    yield cls
    for option in describe(cls):
        if option.nested is not None:
            yield from nested(option.nested)


@pytest.mark.parametrize("name", SECTIONS)
def test_every_text_is_a_sentence_and_every_class_says_what_it_is_about(name):
    for cls in nested(SECTIONS[name]):
        assert (cls.__doc__ or "").partition("\n")[0].endswith(".")
        for option in describe(cls):
            assert option.meaning and not option.meaning.endswith(".")
            assert "\n" not in option.meaning and "|" not in option.meaning
