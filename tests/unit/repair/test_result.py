"""The result of a repair as it grows: what is written where, and what is recorded of it."""

import numpy as np
import pytest

from markermend.core.changes import Alternative
from markermend.core.events import Event
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import MEASURED, MISSING, ORIGINS, Recording
from markermend.core.rulings import Ruling
from markermend.repair.candidates import Candidate
from markermend.repair.methods import Proposal
from markermend.repair.result import Restoration
from support.repairs import RADIUS

PEAK, SWAP = ORIGINS.index("peak"), ORIGINS.index("swap")


@pytest.fixture
def recording():
    positions = np.random.default_rng(2).normal(0, 100, (10, 2, 3))
    positions[4, 0] = np.nan
    return Recording(("A", "B"), positions, 100.0)


def candidate(method, n, value, error):
    proposal = Proposal(method, np.full((n, 3), value), np.full(n, error))
    return Candidate(proposal, 1.8 * error, 5.0, 4.0, 1.0, 3.0)


def test_a_candidate_is_written_where_the_marker_was_seen(recording):
    before = recording.positions.copy()
    taken, other = candidate("spline", 4, 7.0, 0.5), candidate("local_ridge", 4, 8.0, 0.75)
    result = Restoration(recording, [], RADIUS)
    result.write("peaks", Event("A", 2, 6, 3.0, "x"), taken, [other, taken], Ruling(texts=("accept",)))
    restored, (change,) = result.finished()
    assert np.array_equal(recording.positions, before, equal_nan=True)
    assert restored.origin[:, 0].tolist() == [0, 0, PEAK, PEAK, MISSING, PEAK, 0, 0, 0, 0]
    assert (restored.positions[[2, 3, 5], 0] == 7.0).all() and np.isnan(restored.positions[4, 0]).all()
    assert restored.error[2, 0] == pytest.approx(0.9) and restored.error95[2, 0] == pytest.approx(1.4)
    assert (change.kind, change.outcome, change.method, change.samples) == ("peak", "repaired", "spline", 3)
    assert change.alternatives == (Alternative("local_ridge", 1.35), Alternative("spline", 0.9))
    assert (change.score, change.axes, change.decisions, change.reason) == (3.0, "x", ("accept",), None)
    assert (change.expected_error_mm, change.expected_error95_mm) == (0.9, 1.4)
    moved = np.linalg.norm(before[[2, 3, 5], 0] - 7.0, axis=1).max()
    assert change.largest_change_mm == pytest.approx(moved, abs=5e-4)


def test_labels_are_exchanged_with_the_missing_samples(recording):
    cycle = [Event("A", 3, 6, 9.0, "xyz", "B"), Event("B", 3, 6, 9.0, "xyz", "A")]
    result = Restoration(recording, [], RADIUS)
    result.exchange(cycle, Ruling())
    restored, changes = result.finished()
    assert np.array_equal(restored.positions[3:6], recording.positions[3:6, ::-1], equal_nan=True)
    assert restored.origin[3:6].tolist() == [[SWAP, SWAP], [SWAP, MISSING], [SWAP, SWAP]]
    assert (restored.error[3:6][restored.origin[3:6] == SWAP] == 0).all()
    assert [(c.marker, c.partner, c.kind, c.outcome) for c in changes] == [
        ("A", "B", "swap", "exchanged"),
        ("B", "A", "swap", "exchanged"),
    ]


@pytest.mark.parametrize(("blank", "outcome", "samples"), [(True, "blanked", 3), (False, "left", 4)])
def test_what_is_left_stays_or_becomes_missing(recording, blank, outcome, samples):
    reason = Reason(Cause.SEVERAL_CLASSES, "several")
    result = Restoration(recording, [], RADIUS)
    result.leave(Event("A", 2, 6, 3.0), ("peak", "slow"), reason, Ruling(), blank=blank)
    restored, (change,) = result.finished()
    assert (change.classes, change.outcome, change.samples, change.reason) == (
        ("peak", "slow"),
        outcome,
        samples,
        reason,
    )
    expected = MISSING if blank else MEASURED
    assert (restored.origin[[2, 3, 5], 0] == expected).all() and restored.origin[4, 0] == MISSING
    assert np.isnan(restored.positions[2:6, 0]).all() == blank
