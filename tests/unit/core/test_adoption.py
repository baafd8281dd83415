"""Adopted samples: given bit for bit where they are adopted, and taken out of what is found to be on something else."""

import numpy as np

from markermend.core.adoption import adopt, is_adopted, without_adopted
from markermend.core.events import Event


def event(marker, start, stop, kind="adopted", source="*7"):
    return Event(marker, start, stop, 1.0, kind=kind, source=source)


def test_samples_are_given_bit_for_bit_and_nothing_else_changes():
    positions = np.random.default_rng(0).normal(0, 100, (20, 2, 3))
    positions[5:12, 1] = np.nan
    track = np.random.default_rng(1).normal(0, 100, (20, 3))
    given = adopt(positions, [event("B", 5, 12)], {"*7": track}, ["A", "B"])
    assert np.array_equal(given[5:12, 1], track[5:12])
    given[5:12, 1] = np.nan
    assert np.array_equal(given, positions, equal_nan=True)


def test_only_the_class_adopted_is_carried_out():
    assert is_adopted(event("A", 0, 5))
    assert not is_adopted(event("A", 0, 5, kind="unlabelled"))
    assert not is_adopted(Event("A", 0, 5, 1.0, kind="foreign"))


def test_what_is_on_something_else_ends_where_samples_are_adopted():
    foreign = event("A", 10, 50, kind="foreign", source=None)
    other = event("B", 10, 50, kind="foreign", source=None)
    frozen = Event("A", 10, 50, 1.0)
    own = event("A", 20, 30)
    left = without_adopted([foreign, other, frozen, own], [own])
    assert [(one.marker, one.start, one.stop, one.kind) for one in left] == [
        ("A", 10, 20, "foreign"), ("A", 30, 50, "foreign"), ("B", 10, 50, "foreign"), ("A", 10, 50, None),
    ]  # fmt: skip
    assert without_adopted([foreign], [event("A", 0, 60)]) == []
