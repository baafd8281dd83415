"""Attribution: markers that are each predicted as the mean of the others that are observed."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.detection.neighbour.attribution import attribute
from markermend.prediction.scene import Scene
from support.naive import attribution as naive
from support.predictors import MeanOfOthers, NeedsFrames

MARKERS, SPAN, BESIDE = "ABCDE", slice(10, 20), [8, 9, 20, 21]
EVENT, OPEN = 4.0, 2.0
"""Displacements above which a marker has an event, or something unexplained, mm."""


@dataclass
class Displaced:
    """Finds markers that are displaced in the span, by residual and trajectory."""

    scene: Scene
    markers: str
    border: int = 0
    candidates: list = field(default_factory=list)
    explains: bool = True

    def measure(self, residual):
        return residual

    def update(self, statistics, residual, markers):
        return residual

    def displacement(self, statistics, m):
        moved = [v[SPAN, m, 0].mean() - v[BESIDE, m, 0].mean() for v in (statistics, self.scene.positions)]
        return float(np.nan_to_num(np.clip(moved[0], 0, max(moved[1], 0))))

    def find_events(self, statistics, m):
        displacement = self.displacement(statistics, m)
        return [Event(self.markers[m], SPAN.start, SPAN.stop, displacement, "x")] if displacement > EVENT else []

    def find_candidates(self, statistics, m):
        return self.find_events(statistics, m) if self.candidates is None else self.candidates[m : m + 1]

    def unexplained(self, statistics, m):
        return () if self.explains or self.displacement(statistics, m) <= OPEN else (SPAN.start, SPAN.stop)


def found(*levels, at=0, rounds=2, predictor=None, **more):
    """Markers with an event where some are displaced in the span."""
    positions = np.zeros((30, len(levels), 3))
    positions[:, :, 0] = at
    positions[SPAN, :, 0] += levels
    scene = Scene(positions, 100.0, [np.delete(np.arange(len(levels)), m) for m in range(len(levels))])
    detector = Displaced(scene, MARKERS[: len(levels)], **more)
    events, _ = attribute(detector, predictor=predictor or MeanOfOthers(), rounds=rounds, neighbours=len(levels) - 1)
    return sorted(event.marker for event in events)


@pytest.mark.parametrize("levels", [(12, 0, 0), (-12, 0, 0), (12, 1, -2)])
def test_no_event_is_attributed_to_neighbours(levels):
    assert found(*levels, explains=False) == (["A"] if levels[0] > 0 else [])


def test_what_a_neighbour_hides_is_found_where_something_is_unexplained():
    assert found(12, 9, 0) == ["A"]
    assert found(12, 9, 0, explains=False) == ["A", "B"]
    assert found(12, 7, 0, explains=False) == ["A"]


def test_both_of_two_that_compete_may_be_right():
    assert found(20, 18, 0) == ["A", "B"]


def test_what_several_hide_from_one_another_is_found_where_all_are_candidates():
    levels = (20, 19, 11, 0, 0)
    assert found(*levels) == ["A", "B"]
    assert found(*levels, candidates=None) == ["A", "B", "C"]


def test_a_marker_is_not_left_without_any_neighbour_to_judge_it_by():
    levels = (30, 9, 6)
    assert found(*levels) == ["A"]
    assert found(*levels, candidates=None) == ["A"]
    assert found(*levels, candidates=None, border=3) == ["A"]


def test_a_marker_is_not_left_with_too_few_frames_to_learn_from():
    levels = (30, 9, 0, 0)
    assert found(*levels, candidates=None, rounds=0, predictor=NeedsFrames()) == found(*levels, rounds=0) == ["A"]


def test_suspicion_alone_is_no_event():
    both = [Event(name, SPAN.start, SPAN.stop, 9.0) for name in "AB"]
    assert found(12, 12, 12, 12, candidates=both) == []


def test_a_hidden_neighbour_takes_the_adjacent_samples_with_it():
    given = {"at": (0, 0, -100), "candidates": None}
    assert found(12, 0, 12, **given) == ["C"]
    assert found(12, 0, 12, **given, border=2) == ["A", "C"]


@dataclass
class Jumps:
    """Finds runs of frames in which residual and trajectory are displaced alike, at any place, in random cases."""

    scene: Scene
    markers: str
    border: int

    def measure(self, residual):
        return residual

    def update(self, statistics, residual, markers):
        return residual

    def find_events(self, statistics, m):
        return naive.displaced_runs(statistics[:, m, 0], self.scene.positions[:, m, 0], self.markers[m], level=3.0)

    def find_candidates(self, statistics, m):
        return naive.displaced_runs(statistics[:, m, 0], self.scene.positions[:, m, 0], self.markers[m], level=5.0)

    def unexplained(self, statistics, m):
        weak = naive.displaced_runs(statistics[:, m, 0], self.scene.positions[:, m, 0], self.markers[m], level=1.5)
        return [frame for event in weak for frame in (event.start, event.stop)]


@pytest.mark.parametrize("predictor", [MeanOfOthers(), NeedsFrames()])
@pytest.mark.parametrize("seed", range(40))
def test_as_the_rule_says_word_by_word(seed, predictor):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(3, 6))
    positions = np.zeros((24, count, 3))
    for m in range(count):
        for _ in range(int(rng.integers(0, 3))):
            start = int(rng.integers(0, 20))
            positions[start : start + int(rng.integers(1, 8)), m, 0] += rng.uniform(2, 20)
    positions[rng.random((24, count)) < 0.03] = np.nan
    neighbours = [rng.permutation(np.delete(np.arange(count), m)) for m in range(count)]
    scene = Scene(positions, 100.0, neighbours)
    detector = Jumps(scene, MARKERS[:count], border=int(rng.integers(0, 3)))
    rounds, reach = int(rng.integers(0, 4)), int(rng.integers(1, count))
    events, _ = attribute(detector, predictor=predictor, rounds=rounds, neighbours=reach)
    expected = naive.attribute(detector, predictor, rounds=rounds, reach=reach)
    assert sorted(events, key=lambda event: event.order) == expected
