"""Recordings are divided into bounded batches, of which another recording changes one."""

import pytest

from markermend.planning.batches import batches

PLACES = [f"S{number % 7}/r{number:04}" for number in range(1000)]


@pytest.mark.parametrize("count", [1, 9, 10])
def test_few_recordings_are_one_batch(count):
    assert batches(PLACES[:count], max_size=10) == {"1_of_1": PLACES[:count]}


def test_no_recordings_are_no_batch():
    assert batches([], max_size=10) == {}


def test_many_recordings_are_divided_each_into_one_batch_of_bounded_size():
    found = batches(PLACES, max_size=100)
    assert len(found) == 32
    assert sorted(place for own in found.values() for place in own) == sorted(PLACES)
    assert all(own == sorted(own, key=PLACES.index) for own in found.values())
    assert max(map(len, found.values())) <= 100


def test_no_batch_is_larger_however_the_checksums_fall():
    """With 2,000 subjects of five recordings, twice as many batches as the average needs."""
    places = [f"S{number % 2000}/r{number}" for number in range(10_000)]
    halves = [batches(places[:count], max_size=250) for count in range(400, 10_001, 800)]
    assert max(len(own) for found in halves for own in found.values()) <= 250
    for count in (100, 1000):
        assert max(map(len, batches(places[:count], max_size=5).values())) <= 5


def test_the_recordings_of_a_subject_stay_together_where_they_are_few():
    found = batches([f"S{number % 200}/r{number}" for number in range(1000)], max_size=100)
    subjects = [{place.split("/")[0] for place in own} for own in found.values()]
    assert sum(map(len, subjects)) == 200 and max(map(len, found.values())) <= 100


def test_another_recording_changes_one_batch():
    before, after = batches(PLACES, max_size=100), batches([*PLACES, "S9/new"], max_size=100)
    assert before.keys() == after.keys()
    changed = [name for name in before if before[name] != after[name]]
    assert [after[name] for name in changed] == [[*before[name], "S9/new"] for name in changed] and len(changed) == 1
