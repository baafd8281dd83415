"""Markers that cannot be judged are those that are too seldom seen with enough neighbours."""

import numpy as np
import pytest

from markermend.core.mesh import Mesh
from markermend.core.recording import Recording
from markermend.core.unjudged import neighbours_judge, unjudged_markers, unjudged_warnings

NAMES = ("a", "b", "c", "d", "e")


@pytest.fixture
def recording():
    return Recording(NAMES, np.random.default_rng(0).normal(0, 100, (100, 5, 3)), 100.0, facts={"kind": "dynamic"})


@pytest.fixture
def mesh():
    near = {name: tuple(other for other in NAMES if other != name) for name in NAMES}
    return Mesh(("walk",), NAMES, (), near, near)


def found(recording, mesh):
    return unjudged_markers(recording, mesh, min_frames=60, min_neighbours=3, steady_mates=3, max_mate_spread_mm=100)


def test_a_complete_recording_is_judged(recording, mesh):
    assert found(recording, mesh) == {} and unjudged_warnings({}) == []


def test_markers_without_neighbours_are_not_judged(recording, mesh):
    mesh.neighbours["c"] = ("a", "b")
    assert found(recording, mesh) == {
        "c": "seen on fewer than 60 frames with 3 neighbours, so that only labels can be judged"
    }


def test_markers_that_are_seldom_seen_are_not_judged_nor_judge_others(recording, mesh):
    recording.positions[30:, 0] = np.nan
    assert found(recording, mesh) == {"a": "seen on fewer than 60 frames, so that only labels can be judged"}
    recording.positions[:41, 1] = np.nan
    assert list(found(recording, mesh)) == list("abcde")
    assert unjudged_warnings(found(recording, mesh)) == [
        "seen on fewer than 60 frames, so that only labels can be judged: a, b",
        "seen on fewer than 60 frames with 3 neighbours, so that only labels can be judged: c, d, e",
    ]


def test_neighbours_must_be_seen_together(recording, mesh):
    recording.positions[:30, 1] = recording.positions[30:60, 2] = recording.positions[60:, 3] = np.nan
    mesh.neighbours["e"] = ("b", "c", "d")
    assert "e" in found(recording, mesh)


def test_a_marker_that_was_never_seen_and_a_static_recording_are_not_named(recording, mesh):
    recording.positions[:, 0] = np.nan
    assert found(recording, mesh) == {}
    recording.positions[:, 1:] = np.nan
    recording.positions[:5, 1:] = 1.0
    assert list(found(recording, mesh)) == list("bcde")
    recording.facts["kind"] = "static"
    assert found(recording, mesh) == {}


def test_a_marker_that_keeps_no_distances_is_not_judged_for_peaks_and_noise(recording, mesh):
    names, steady = NAMES, (300.0, 1.0, 5.0)
    for m, first in enumerate(names):
        flight = [(300.0, 90.0, 125.0) if "e" in (first, second) else steady for second in names[m + 1 :]]
        mesh.distances[first] = dict(zip(names[m + 1 :], flight, strict=True))
    assert found(recording, mesh) == {
        "e": "at no steady distance from 3 others, so that peaks and noise cannot be judged"
    }
    mesh.distances["a"]["e"] = mesh.distances["b"]["e"] = mesh.distances["c"]["e"] = steady
    assert found(recording, mesh) == {}


@pytest.mark.parametrize(
    ("presets", "judge"),
    [
        ([], False),
        ([None], True),
        (["paper"], False),
        (["paper", None], False),
        (["coordinates", "default", None], True),
    ],
)
def test_only_the_default_detectors_judge_by_neighbours(presets, judge):
    assert neighbours_judge(presets) is judge
