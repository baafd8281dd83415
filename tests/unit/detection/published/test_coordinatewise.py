"""A detector of one signal on each coordinate: what earlier detectors claimed is bridged, and not found again."""

import numpy as np
import pytest

from markermend.core import events
from markermend.detection.published import coordinatewise
from markermend.options.detection.published import ThresholdOptions


def test_each_coordinate_is_bridged_by_itself_for_the_next_detector():
    rng = np.random.default_rng(0)
    positions = rng.normal(0, 0.2, (300, 2, 3)).cumsum(axis=0)
    found = [events.Event("B", 100, 120, 2.0, "xz"), events.Event("A", 200, 203, 2.0, "y")]
    claimed = events.coordinates(found, 300, ["A", "B"])
    assert claimed[100:120, 1].all(axis=0).tolist() == [True, False, True]
    assert claimed.sum() == 43
    before = positions.copy()
    bridged = coordinatewise.bridge_claimed(positions, claimed, 5)
    assert np.array_equal(positions, before)
    assert np.array_equal(bridged[~claimed], positions[~claimed])
    assert np.isfinite(bridged).all()
    # A bridge is a cubic: its third differences do not vary.
    assert np.ptp(np.diff(bridged[100:120, 1, 0], 3)) < 1e-12


def test_what_any_coordinate_claimed_is_not_found_again_in_another():
    claimed = events.coordinates([events.Event("A", 100, 120, 2.0, "x")], 300, ["A"])

    def everything(signal, change, level, marker):
        return np.ones(300, bool), np.full(300, 2.0)

    detector = coordinatewise.SignalDetector(np.copy, everything)
    given = {"markers": ["A"], "earlier": claimed, "options": ThresholdOptions()}
    found = coordinatewise.detect_each(np.zeros((300, 1, 3)), detector, **given)
    assert [(event.start, event.stop, event.axes) for event in found] == [(0, 100, "xyz"), (120, 300, "xyz")]


@pytest.mark.parametrize(("over", "found"), [("coordinate", {"A", "B"}), ("marker", {"A", "B"}), ("recording", {"A"})])
def test_a_small_change_of_a_still_marker_is_sudden_by_its_own_scale_only(over, found):
    rng = np.random.default_rng(1)
    changes = rng.normal(0, 1, (1000, 2, 3)) * np.array([1, 0.01])[:, None]
    changes[500] = [[20, 0, 0], [0.2, 0, 0]]

    def beyond(signal, change, level, marker):
        return np.abs(change) > level, np.abs(change) / level

    options = ThresholdOptions(scale_estimator="std", sigma_over=over, threshold_sigmas=8, floor_mm=0)
    events_found = coordinatewise.detect_each(
        changes,
        coordinatewise.SignalDetector(np.copy, beyond),
        markers=["A", "B"],
        earlier=np.zeros(changes.shape, bool),
        options=options,
    )
    assert {(event.marker, event.start, event.axes) for event in events_found} == {(name, 500, "x") for name in found}
