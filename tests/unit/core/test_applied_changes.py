"""Applied changes: each sample that differs is in one of them, with its own figures, and the rest is not."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.applied_changes import applied_changes
from markermend.core.changes import Alternative, Change, MemberWeight, Outcome
from markermend.core.reasons import Cause, Reason
from markermend.core.recording import FILLED, MISSING, ORIGINS, Recording, Restored

STEP = Change(
    "A", 5, 9, ("step",), Outcome.REPAIRED, 3.0, "xz", method="offset",
    alternatives=(Alternative("offset", 0.5), Alternative("local_ridge", 2.345)),
)  # fmt: skip
AWAY = Change("C", 30, 32, ("slow",), Outcome.BLANKED, 2.0, "y", reason=Reason(Cause.TOO_LONG, "why"))
FILL = Change(
    "B", 20, 25, ("gap",), Outcome.FILLED, method="linear", member_weights=(MemberWeight("linear", 1.0),)
)  # fmt: skip
LEFT = Change("C", 1, 4, ("peak",), Outcome.LEFT, 1.5, reason=Reason(Cause.PROTECTED, "protected"))
CHANGES = [STEP, AWAY, LEFT, FILL]


@pytest.fixture
def measured():
    positions = np.cumsum(np.random.default_rng(5).normal(0, 2, (50, 3, 3)), axis=0)
    positions[20:25, 1] = np.nan
    return Recording(("A", "B", "C"), positions, 100.0, 701, {"recording": "walk"})


@pytest.fixture
def restored(measured):
    """A fill on B, a step repaired on A, and samples of C blanked."""
    positions, origin = measured.positions.copy(), np.where(measured.missing, MISSING, 0).astype(np.uint8)
    error = np.where(measured.missing, np.nan, 0.0)
    positions[20:25, 1], origin[20:25, 1], error[20:25, 1] = 7.0, FILLED, 1.5
    positions[5:9, 0] += 12.0
    origin[5:9, 0], error[5:9, 0] = ORIGINS.index("step"), (0.5, 0.25, 0.5, 0.1)
    positions[30:32, 2], origin[30:32, 2], error[30:32, 2] = np.nan, MISSING, np.nan
    common = (measured.markers, positions, measured.rate, measured.first_frame, measured.facts)
    return Restored(*common, origin, error, 2 * error)


def test_changes_have_the_figures_of_the_samples_that_differ(measured, restored):
    moved = round(12 * np.sqrt(3), 3)
    assert applied_changes(measured, restored, CHANGES) == [
        replace(STEP, samples=4, largest_change_mm=moved, expected_error_mm=0.5, expected_error95_mm=1.0),
        replace(FILL, samples=5, expected_error_mm=1.5, expected_error95_mm=3.0),
        replace(AWAY, samples=2),
    ]


def test_a_change_that_changed_nothing_is_not_listed(measured, restored):
    restored.positions[5:9, 0] = measured.positions[5:9, 0]
    assert [change.marker for change in applied_changes(measured, restored, CHANGES)] == ["B", "C"]


def filled(restored, start, stop, marker):
    """Samples that are filled now."""
    restored.positions[start:stop, marker], restored.origin[start:stop, marker] = 1.0, FILLED
    restored.error[start:stop, marker], restored.error95[start:stop, marker] = 2.0, 3.0


def test_a_blanked_sample_that_was_filled_is_listed_once_with_its_finding(measured, restored):
    filled(restored, 30, 32, 2)
    fill = Change("C", 30, 32, ("gap",), Outcome.FILLED, method="local_ridge", decisions=("accept gap",))
    (change,) = (c for c in applied_changes(measured, restored, [*CHANGES, fill]) if c.marker == "C")
    assert (change.kind, change.score, change.method, change.samples) == ("slow", 2.0, "local_ridge", 2)
    assert change.outcome is Outcome.FILLED and not change.is_gap and change.decisions == ("accept gap",)
    assert change.largest_change_mm > 0 and change.expected_error_mm == 2.0 and change.reason == AWAY.reason


def test_a_gap_that_grew_by_a_finding_is_listed_in_parts(measured, restored):
    filled(restored, 18, 25, 1)
    frozen = Change("B", 18, 20, ("frozen",), Outcome.BLANKED, 2.0)
    parts = applied_changes(measured, restored, [STEP, AWAY, frozen, replace(FILL, start=18)])
    own = [(c.kind, c.start, c.stop, c.samples, c.method) for c in parts if c.marker == "B"]
    assert own == [("frozen", 18, 20, 2, "linear"), ("gap", 20, 25, 5, "linear")]


def test_a_sample_that_an_exchange_took_away_and_that_was_filled_is_part_of_the_exchange(measured, restored):
    """The partner was missing there: the marker's own sample went to it, and what stands here is a fill."""
    filled(restored, 40, 42, 0)
    swap = Change("A", 40, 42, ("swap",), Outcome.EXCHANGED, 9.0, "xyz", "B", "swap")
    fill = Change("A", 40, 42, ("gap",), Outcome.FILLED, method="spline")
    found = applied_changes(measured, restored, [STEP, swap, fill, FILL, AWAY])
    assert [(c.kind, c.outcome, c.method) for c in found if c.start == 40] == [("swap", "filled", "spline")]
