"""Findings that overlap are one group; the strongest stands for all, and decisions are asked about all."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from markermend.core.artifacts import names_of
from markermend.core.decisions import Decision
from markermend.core.events import Event
from markermend.repair.findings import Finding, Rulings, group_findings

FRAMES = 20
spans = st.tuples(st.integers(0, FRAMES - 6), st.integers(1, 6)).map(lambda pair: (pair[0], pair[0] + pair[1]))
events = st.builds(
    lambda marker, span, score: Event(marker, *span, score), st.sampled_from("AB"), spans, st.sampled_from([1.0, 2.0])
)
found = st.dictionaries(st.sampled_from(["peaks", "noise", "slow"]), st.lists(events, max_size=4))


def connected(members):
    """Twin: members of a marker that share frames, by joining any two until none can be joined."""
    groups = [[member] for member in members]
    while True:
        pairs = [
            (a, b)
            for a in groups
            for b in groups
            if a is not b
            and any(
                one.marker == other.marker and one.start < other.stop and other.start < one.stop
                for _, one in a
                for _, other in b
            )
        ]
        if not pairs:
            return {frozenset(group) for group in groups}
        a, b = pairs[0]
        groups = [group for group in groups if group is not a and group is not b] + [a + b]


@given(found)
def test_groups_are_the_connected_findings(some):
    members = list(dict.fromkeys((stage, event) for stage, listed in some.items() for event in listed))
    unique = {stage: [event for own, event in members if own == stage] for stage in some}
    groups = group_findings(unique)
    assert {frozenset(group.members) for group in groups} == connected(members)
    covered = np.zeros((2, FRAMES), int)
    for group in groups:
        event = group.event
        covered["AB".index(event.marker), event.start : event.stop] += 1
        assert event.score == max(own.score for _, own in group.members)
    assert covered.max(initial=0) <= 1


def test_findings_that_touch_are_not_one():
    assert len(group_findings({"peaks": [Event("A", 2, 4, 1.0)], "slow": [Event("A", 4, 9, 1.0)]})) == 2


def test_peaks_and_steps_amid_noise_are_part_of_it():
    noise = ("noise", Event("A", 3, 30, 2.0))
    amid = Finding((noise, ("peaks", Event("A", 5, 7, 9.0)), ("steps", Event("A", 20, 30, 3.0))))
    assert not amid.mixed and amid.stage == "noise" and (amid.event.start, amid.event.stop) == (3, 30)
    assert Finding((noise, ("peaks", Event("A", 29, 33, 9.0)))).mixed
    assert Finding((noise, ("slow", Event("A", 5, 20, 1.0)))).mixed
    assert not Finding((noise,)).mixed


def test_the_strongest_stands_for_all_over_the_whole_stretch():
    finding = Finding((("peaks", Event("A", 3, 5, 2.0, "x")), ("slow", Event("A", 4, 9, 7.0, "yz"))))
    assert (finding.stage, names_of(finding.classes)) == ("slow", ("peak", "slow"))
    assert finding.event == Event("A", 3, 9, 7.0, "yz")


def test_a_decision_on_one_marker_of_a_cycle_is_about_all():
    cycle = [Event("A", 2, 6, 1.0, "xyz", "B"), Event("B", 2, 6, 1.0, "xyz", "C"), Event("C", 2, 6, 1.0, "xyz", "A")]
    rulings = Rulings([Decision("C", 3, 4, "reject", "swap")], cycle)
    assert all(rulings.on([("labels", event)]).left for event in cycle)
    assert rulings.on([("peaks", Event("A", 2, 6, 1.0))]).left is None
