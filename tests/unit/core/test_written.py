"""What the number format of a file cannot hold stays as measured, and is no change."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.changes import Change, Outcome
from markermend.core.reasons import Cause
from markermend.core.recording import FILLED, MEASURED, MISSING, ORIGINS, Recording, Restored
from markermend.core.written import written_changes

STEP = Change("A", 2, 8, ("step",), Outcome.REPAIRED, 4.0, "x", method="separate_step")
FILL = Change("B", 4, 6, ("gap",), Outcome.FILLED, method="spline")


@pytest.fixture
def measured():
    positions = np.zeros((10, 2, 3))
    positions[4:6, 1] = np.nan
    return Recording(("A", "B"), positions, 100.0, 501)


@pytest.fixture
def restored(measured):
    positions, origin = measured.positions.copy(), np.zeros((10, 2), np.uint8)
    positions[2:8, 0, 0] = np.arange(10, 16)
    positions[4:6, 1] = 7.0
    origin[2:8, 0], origin[4:6, 1] = ORIGINS.index("step"), FILLED
    error = np.where(origin == MEASURED, 0.0, 2.0)
    return Restored(measured.markers, positions, 100.0, 501, {}, origin, error, 2 * error)


def refused(marker, *rows):
    return [{"marker": marker, "frame": 501 + row} for row in rows]


def test_without_a_refusal_everything_was_written(measured, restored):
    found = written_changes(measured, restored, [STEP, FILL], [])
    assert found.recording is restored and found.refused == []
    assert [(change.marker, change.samples) for change in found.applied] == [("A", 6), ("B", 2)]


def test_refused_samples_stay_as_measured(measured, restored):
    found = written_changes(measured, restored, [STEP, FILL], [*refused("A", 6, 7), *refused("B", 4, 5)])
    assert np.flatnonzero(found.recording.positions[:, 0, 0]).tolist() == [2, 3, 4, 5]
    assert np.isnan(found.recording.positions[4:6, 1]).all()
    assert found.recording.origin[6:8, 0].tolist() == [MEASURED] * 2
    assert found.recording.origin[4:6, 1].tolist() == [MISSING] * 2
    assert found.recording.error[7, 0] == 0 and np.isnan(found.recording.error95[4, 1])
    assert [(c.marker, c.samples, c.largest_change_mm) for c in found.applied] == [("A", 4, 13.0)]
    assert [(c.marker, c.samples, c.largest_change_mm) for c in found.refused] == [("A", 2, 15.0), ("B", 2, None)]
    assert all(c.outcome is Outcome.LEFT and c.reason.cause is Cause.NUMBER_FORMAT for c in found.refused)
    assert replace(restored).positions[7, 0, 0] == 15.0


def test_a_change_that_is_refused_as_a_whole_is_none(measured, restored):
    found = written_changes(measured, restored, [STEP], refused("A", *range(2, 8)))
    assert found.applied == [] and [change.kind for change in found.refused] == ["step"]
