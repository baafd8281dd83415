"""Whose artifact is it: three markers, each predicted as the mean of the others that are seen."""

import numpy as np
import pytest

from markermend import blame
from markermend.events import Event
from markermend.predictors import Scene

MARKERS, SPAN = ("A", "B", "C"), slice(10, 20)
EVENT, OPEN = 4.0, 2.0
"""Levels above which a marker has an event, or something open, mm."""


class MeanOfOthers:
    def residuals(self, scene, markers=None):
        out = np.full(scene.positions.shape, np.nan)
        for m in range(3) if markers is None else markers:
            others = np.delete(scene.positions, m, axis=1)
            out[:, m] = scene.positions[:, m] - np.nanmean(others, axis=1)
        return out


def level(measured, m):
    """How far a marker itself is off in the span, mm."""
    positions, residual = measured
    return float(np.nan_to_num(np.clip(residual[SPAN, m, 0], 0, positions[SPAN, m, 0])).mean())


def judge(measured, m):
    off = level(measured, m)
    return [Event(MARKERS[m], SPAN.start, SPAN.stop, off, "x")] if off > EVENT else []


def found(*levels, open_at=None, rounds=2):
    positions = np.zeros((30, 3, 3))
    positions[SPAN, :, 0] = levels
    scene = Scene(positions, 100.0, [np.delete(np.arange(3), m) for m in range(3)])
    events, _ = blame.find(
        scene,
        measure=lambda scene, residual, only, was: (positions, residual),
        judge=judge,
        markers=MARKERS,
        predictor=MeanOfOthers(),
        rounds=rounds,
        reach=2,
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
