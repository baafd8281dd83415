"""Whose artifact is it: markers that are each predicted as the mean of the others that are seen."""

import numpy as np
import pytest

from markermend.core.events import Event
from markermend.detection.neighbour import attribution
from markermend.prediction.scene import Scene

MARKERS, SPAN, BESIDE = "ABCDE", slice(10, 20), [8, 9, 20, 21]
EVENT, OPEN = 4.0, 2.0
"""Levels above which a marker has an event, or something open, mm."""


class MeanOfOthers:
    def residuals(self, scene, markers=None):
        out = np.full(scene.positions.shape, np.nan)
        for m in range(len(scene.neighbours)) if markers is None else markers:
            others = scene.positions[:, scene.neighbours[m]]
            seen = ~np.isnan(others[:, :, 0])
            alone = seen.sum(axis=1) == 0
            out[:, m] = scene.positions[:, m] - np.nansum(others, axis=1) / np.maximum(seen.sum(axis=1), 1)[:, None]
            out[alone, m] = np.nan
        return out


class NeedsFrames(MeanOfOthers):
    """Tells nothing at all of a marker unless all others are seen in most frames."""

    def residuals(self, scene, markers=None):
        out = super().residuals(scene, markers)
        for m, near in enumerate(scene.neighbours):
            if scene.present[:, near].all(axis=1).mean() < 0.9:
                out[:, m] = np.nan
        return out


def level(measured, m):
    """How far a marker itself is off in the span, mm."""
    residual, positions = (values[SPAN, m, 0].mean() - values[BESIDE, m, 0].mean() for values in measured)
    return float(np.nan_to_num(np.clip(residual, 0, max(positions, 0))))


def judge(measured, m):
    off = level(measured, m)
    return [Event(MARKERS[m], SPAN.start, SPAN.stop, off, "x")] if off > EVENT else []


def nothing(measured, m):
    return []


def found(*levels, at=0, border=0, suspect=nothing, open_at=None, rounds=2, predictor=None):
    """Markers with an event where some are off their places in the span."""
    positions = np.zeros((30, len(levels), 3))
    positions[:, :, 0] = at
    positions[SPAN, :, 0] += levels
    scene = Scene(positions, 100.0, [np.delete(np.arange(len(levels)), m) for m in range(len(levels))])
    events, _ = attribution.find(
        scene,
        measure=lambda scene, residual, only, was: (residual, positions),
        judge=judge,
        markers=MARKERS[: len(levels)],
        predictor=predictor or MeanOfOthers(),
        rounds=rounds,
        reach=len(levels) - 1,
        border=border,
        suspect=suspect,
        open_at=open_at,
    )
    return sorted(event.marker for event in events)


def open_at(measured, m):
    return [SPAN.start, SPAN.stop] if level(measured, m) > OPEN else []


@pytest.mark.parametrize("levels", [(12, 0, 0), (-12, 0, 0), (12, 1, -2)])
def test_neighbours_are_not_to_blame(levels):
    assert found(*levels, open_at=open_at) == (["A"] if levels[0] > 0 else [])


def test_what_a_neighbour_hides_is_found_where_something_is_open():
    assert found(12, 9, 0) == ["A"]
    assert found(12, 9, 0, open_at=open_at) == ["A", "B"]
    assert found(12, 7, 0, open_at=open_at) == ["A"]


def test_rivals_may_both_be_right():
    assert found(20, 18, 0) == ["A", "B"]


def test_what_several_hide_from_one_another_is_found_where_all_are_suspected():
    levels = (20, 19, 11, 0, 0)
    assert found(*levels) == ["A", "B"]
    assert found(*levels, suspect=judge) == found(*levels, suspect=None) == ["A", "B", "C"]


def test_a_marker_is_not_left_without_any_neighbour_to_judge_it_by():
    levels = (30, 9, 6)
    assert found(*levels) == ["A"]
    assert found(*levels, suspect=judge) == ["A"]
    assert found(*levels, suspect=judge, border=3) == ["A"]


def test_a_marker_is_not_left_with_too_few_frames_to_learn_from():
    levels = (30, 9, 0, 0)
    assert found(*levels, suspect=judge, rounds=0, predictor=NeedsFrames()) == found(*levels, rounds=0) == ["A"]


def test_suspicion_alone_is_no_event():
    both = [Event(name, SPAN.start, SPAN.stop, 9.0) for name in "AB"]
    assert found(12, 12, 12, 12, suspect=lambda measured, m: both[m : m + 1]) == []


def test_a_neighbour_that_goes_takes_what_is_beside_with_it():
    given = {"at": (0, 0, -100), "suspect": judge}
    assert found(12, 0, 12, **given) == ["C"]
    assert found(12, 0, 12, **given, border=2) == ["A", "C"]
