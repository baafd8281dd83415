"""Contamination: the positions differ from the clean ones exactly where the truth says so."""

from itertools import pairwise

import numpy as np
import pytest

from markermend.core import events
from markermend.simulation.artifact_models import Recipe, integers, uniform
from markermend.simulation.contamination import Contamination
from markermend.simulation.protocols import one_at_a_time
from support.contaminations import MARKERS, paper, still


def test_truth_is_exact(contaminated):
    clean, damaged = contaminated.clean.positions, contaminated.recording.positions
    shape = (len(clean), contaminated.clean.markers)
    artifacts = sum(events.mask(found, *shape).astype(int) for found in contaminated.events.values())
    missing = events.mask([events.Event(marker, start, stop, 1.0) for marker, start, stop in contaminated.gaps], *shape)
    assert (artifacts + missing).max() == 1
    assert np.array_equal(np.isnan(damaged).all(axis=2), missing)
    assert np.array_equal(np.isnan(damaged).any(axis=2), missing)
    assert np.array_equal((damaged != clean).any(axis=2), (artifacts == 1) | missing)
    assert {kind: len(found) for kind, found in contaminated.events.items()} == {
        "labels": 4, "frames": 0, "frozen": 0, "peaks": 10, "noise": 4, "steps": 4, "slow": 4, "tails": 0,
    }  # fmt: skip


def test_axes_are_those_that_changed(contaminated):
    index = {marker: m for m, marker in enumerate(contaminated.clean.markers)}
    change = contaminated.recording.positions != contaminated.clean.positions
    for event in [event for found in contaminated.events.values() for event in found if not event.partner]:
        hit = change[event.start : event.stop, index[event.marker]].any(axis=0)
        assert event.axes == "".join(axis for axis, seen in zip("xyz", hit, strict=True) if seen)


def test_swapped_markers_stand_in_each_others_place(contaminated):
    index = {marker: m for m, marker in enumerate(contaminated.clean.markers)}
    swaps = contaminated.events["labels"]
    assert len(swaps) == 4
    for event in swaps:
        span, mine, other = slice(event.start, event.stop), index[event.marker], index[event.partner]
        here, there = contaminated.recording.positions[span, mine], contaminated.clean.positions[span, other]
        assert np.array_equal(here, there)
        assert any(back.partner == event.marker and back.start == event.start for back in swaps)


def test_gaps_of_every_kind(contaminated):
    gaps, frames = contaminated.gaps, contaminated.clean.frames
    assert any(start == 0 for _, start, _ in gaps)
    assert any(stop == frames for _, _, stop in gaps)
    together: dict[tuple[int, int], set[str]] = {}
    for marker, start, stop in gaps:
        together.setdefault((start, stop), set()).add(marker)
    assert {"LFIN", "LIDX", "LPKY"} in together.values()
    assert sum(len(markers) == 3 for markers in together.values()) == 2


def test_amplitudes_come_back_from_the_positions():
    clean = still()
    damage = Contamination(clean, MARKERS, margin=5, one_at_a_time=False, rng=np.random.default_rng(3))
    for kind, axes in (("peaks", 1), ("steps", 2), ("slow", 3), ("noise", 1)):
        damage.add(kind, Recipe(uniform(8.0, 12.0), integers(300, 400), axes), count=4)
    for artifact in damage.artifacts:
        change = (damage.positions - clean)[artifact.start : artifact.stop, MARKERS.index(artifact.marker)]
        size = np.linalg.norm(artifact.amplitude)
        assert 8 <= size <= 12
        if artifact.kind == "noise":
            assert change.std(axis=0).max() == pytest.approx(size, rel=0.15)
        else:
            assert np.linalg.norm(change, axis=1).max() == pytest.approx(size)
    assert {len(event.axes) for event in damage.events["steps"]} == {2}
    assert not (clean - still()).any()


def test_margin_is_kept_and_missing_samples_are_left_alone():
    clean = still(2000)
    clean[500:900, 2] = np.nan
    damage = Contamination(clean, MARKERS, margin=20, one_at_a_time=False, rng=np.random.default_rng(9))
    damage.add("steps", Recipe(uniform(8.0, 12.0), integers(30, 60), 3), count=60)
    assert np.array_equal(np.isnan(damage.positions), np.isnan(clean))
    for marker in MARKERS:
        spans = sorted((a.start, a.stop) for a in damage.artifacts if a.marker == marker)
        if marker == "M2":
            spans = sorted([*spans, (500, 900)])
        assert spans[0][0] >= 20
        assert spans[-1][1] <= 1980
        assert all(b[0] - a[1] >= 20 for a, b in pairwise(spans))


def test_no_room_is_an_error():
    damage = Contamination(still(200), MARKERS, margin=0, one_at_a_time=True, rng=np.random.default_rng(0))
    with pytest.raises(ValueError, match="no room"):
        damage.add("steps", Recipe(uniform(8.0, 12.0), integers(90, 90), 1), count=3)
    with pytest.raises(ValueError, match="within 50"):
        damage.swap(length=integers(5, 5), within_mm=50.0, count=1)
    with pytest.raises(ValueError, match="do not fit"):
        damage.gap(length=integers(201, 201), markers=1, at="anywhere", count=1)
    with pytest.raises(ValueError, match="cannot be distorted"):
        one_at_a_time(still(300), MARKERS, recipes=paper(), share=0.9, margin=40, rng=np.random.default_rng(0))
