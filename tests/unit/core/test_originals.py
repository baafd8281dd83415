"""Originals take every change back, bit for bit, whatever was done to a sample."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from markermend.core.applied_changes import applied_changes
from markermend.core.changes import Change, Outcome
from markermend.core.originals import find_originals, origin_names, restore_originals, select_findings
from markermend.core.recording import FILLED, MISSING, ORIGINS, Recording, Restored, changed

SHAPE = (6, 3)
coordinates = arrays.arrays(np.float64, (*SHAPE, 3), elements=st.floats(-1e6, 1e6, width=64).map(lambda x: x + 0.0))
masks = arrays.arrays(bool, SHAPE)


def recording(positions, missing, cls=Recording, **more):
    return cls(("A", "B", "C"), np.where(missing[..., None], np.nan, positions), 100.0, 11, {}, **more)


def restored(positions, missing, origin):
    none = np.zeros(SHAPE)
    return recording(positions, missing, Restored, origin=origin, error=none, error95=none)


@given(
    coordinates, masks, coordinates, masks, arrays.arrays(np.uint8, SHAPE, elements=st.integers(0, len(ORIGINS) - 1))
)
def test_what_was_measured_comes_back(before, gone, after, gone_after, origin):
    measured, result = recording(before, gone), restored(after, gone_after, origin)
    originals = find_originals(measured, result, [])
    back = restore_originals(result.positions, result.markers, originals)
    assert back.tobytes() == measured.positions.tobytes()
    assert len(originals.frame) == changed(measured, result).sum()
    assert np.isnan(originals.positions[~originals.measured]).all()


def test_markers_are_found_by_name():
    measured = recording(np.arange(54.0).reshape(6, 3, 3), np.zeros(SHAPE, bool))
    positions = measured.positions.copy()
    positions[2, 1] = 0
    result = restored(positions, np.zeros(SHAPE, bool), np.zeros(SHAPE, np.uint8))
    originals = find_originals(measured, result, [])
    turned = restore_originals(positions[:, ::-1], ("C", "B", "A"), originals)
    assert np.array_equal(turned, measured.positions[:, ::-1])
    with pytest.raises(ValueError, match="not in"):
        restore_originals(positions[:, :1], ("A",), originals)


def test_each_sample_names_what_was_found_and_what_stands_there():
    gone = np.zeros(SHAPE, bool)
    gone[4, 1] = True
    measured = recording(np.arange(54.0).reshape(6, 3, 3), gone)
    positions, origin = measured.positions.copy(), np.zeros(SHAPE, np.uint8)
    positions[1:4, :2] = measured.positions[1:4, 1::-1]
    origin[1:4, :2] = ORIGINS.index("swap")
    positions[2, 0], origin[2, 0] = 7.0, ORIGINS.index("peak")
    positions[3:5, 1], origin[3:5, 1] = 8.0, FILLED
    positions[5, 2], origin[5, 2] = np.nan, MISSING
    result = restored(positions, np.zeros(SHAPE, bool), origin)
    changes = [
        Change("A", 1, 4, ("swap",), Outcome.EXCHANGED, partner="B"),
        Change("B", 1, 4, ("swap",), Outcome.EXCHANGED, partner="A"),
        Change("A", 2, 3, ("peak",), Outcome.REPAIRED, method="spline"),
        Change("B", 3, 4, ("frozen",), Outcome.BLANKED),
        Change("C", 5, 6, ("slow",), Outcome.BLANKED),
        Change("B", 3, 5, ("gap",), Outcome.FILLED, method="ensemble"),
    ]
    originals = find_originals(measured, result, applied_changes(measured, result, changes))
    rows = zip(originals.marker, originals.frame, originals.classes, origin_names(originals), strict=True)
    assert [("ABC"[m], frame, name, now) for m, frame, name, now in rows] == [
        ("A", 1, "swap", "swap"),
        ("A", 2, "peak", "peak"),
        ("A", 3, "swap", "swap"),
        ("B", 1, "swap", "swap"),
        ("B", 2, "swap", "swap"),
        ("B", 3, "frozen", "filled"),
        ("B", 4, "gap", "filled"),
        ("C", 5, "slow", "missing"),
    ]
    assert originals.measured.tolist() == [True] * 6 + [False, True]


def moved(*changes):
    """Originals of a recording of which every sample was moved by some of the changes."""
    measured = recording(np.arange(54.0).reshape(6, 3, 3), np.zeros(SHAPE, bool))
    origin = np.full(SHAPE, ORIGINS.index("peak"), np.uint8)
    result = restored(measured.positions + 1.0, np.zeros(SHAPE, bool), origin)
    return find_originals(measured, result, changes)


def selected(originals, **named):
    own = select_findings(originals, **named)
    return {("ABC"[m], frame) for m, frame in zip(originals.marker[own], originals.frame[own], strict=True)}


def peak(marker, start, stop, **more):
    return Change(marker, start, stop, ("peak",), Outcome.REPAIRED, **more)


def test_a_finding_is_selected_as_a_whole_by_markers_and_frames():
    originals = moved(peak("A", 0, 2), peak("A", 2, 6), peak("B", 0, 6), peak("C", 0, 6))
    assert selected(originals, markers=["A"], frames=(14, 20)) == {("A", frame) for frame in range(2, 6)}
    assert selected(originals, frames=(11, 11)) == {(name, frame) for name in "ABC" for frame in range(6)} - {
        ("A", frame) for frame in range(2, 6)
    }
    assert selected(originals, markers=["[BC]"]) == {(name, frame) for name in "BC" for frame in range(6)}
    assert selected(originals, markers=["D"]) == selected(originals, frames=(17, 99)) == set()


def test_what_shares_samples_an_exchange_or_a_finding_is_selected_together():
    swap = [
        Change("A", 0, 3, ("swap",), Outcome.EXCHANGED, partner="B"),
        Change("B", 0, 3, ("swap",), Outcome.EXCHANGED, partner="A"),
    ]
    originals = moved(*swap, peak("A", 2, 5), peak("A", 5, 6), peak("B", 3, 6), peak("C", 0, 6))
    assert selected(originals, markers=["B"], frames=(11, 12)) == {
        *(("A", frame) for frame in range(5)), *(("B", frame) for frame in range(3)),
    }  # fmt: skip
    group = [peak(name, 0, 3, group="scene") for name in "ABC"] + [peak(name, 3, 6, group="scene") for name in "ABC"]
    assert selected(moved(*group), markers=["C"], frames=(12, 12)) == {(n, frame) for n in "ABC" for frame in range(3)}
