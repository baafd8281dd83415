"""Labels frame by frame and as events: one states the other."""

import numpy as np

from markermend.core.events import Event
from markermend.detection.labelling.states import cycles, exchange_events, labelling

NAMES = ("a", "b", "c", "d")


def ring(labels, start, stop):
    return [
        Event(one, start, stop, 2.0, partner=other) for one, other in zip(labels, labels[1:] + labels[:1], strict=True)
    ]


def test_events_and_labels_state_each_other():
    events = sorted([*ring("ab", 5, 20), *ring("cd", 10, 12), *ring("abc", 30, 40)], key=lambda event: event.order)
    under, score = labelling(events, (50, 4), NAMES)
    assert under[35].tolist() == [1, 2, 0, 3]
    assert exchange_events(under, score, NAMES) == events


def test_a_cycle_that_outlasts_another_is_one_event():
    under = np.tile(np.arange(4), (20, 1))
    under[:, :2] = 1, 0
    under[5:9, 2:] = 3, 2
    found = exchange_events(under, np.full((20, 4), 3.0), NAMES)
    assert [(e.marker, e.start, e.stop) for e in found] == [("a", 0, 20), ("b", 0, 20), ("c", 5, 9), ("d", 5, 9)]


def test_cycles_of_a_permutation():
    assert cycles(np.array([1, 0, 2, 4, 5, 3])) == [(0, 1), (3, 4, 5)]
    assert cycles(np.arange(3)) == []
