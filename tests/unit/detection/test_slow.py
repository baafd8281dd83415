"""Slow changes against the neighbours, on the left half of the synthetic walker: the right limbs would tell no more."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from markermend.core.events import Event
from markermend.detection.neighbour.drift_attribution import Company
from markermend.detection.neighbour.drift_candidates import bar, briefly_gone
from markermend.prediction.scene import Scene
from support.signals import RIDGE, detect, neighbours, options_of, put

PLACES = [("LTIAP", 182, 243), ("LANK", 386, 457), ("LUPA", 920, 989)]


@pytest.fixture(scope="module")
def half(walker):
    recording = walker.recording
    left = [
        m
        for m, segment in enumerate(walker.segments)
        if not segment.startswith("right") and not segment.endswith("hand")
    ]
    return replace(recording, positions=recording.positions[:, left], markers=tuple(recording.markers[m] for m in left))


def triangle(length, direction):
    return 10 * (1 - np.abs(2 * (np.arange(length) + 0.5) / length - 1))[:, None] * direction


def slow_changes(recording):
    return detect(recording, only=("slow",))[0]["slow"]


def test_found_and_not_blamed_on_neighbours(half):
    recording = put(half, PLACES, lambda length: triangle(length, [3, 1, -2]))
    found = slow_changes(recording)
    assert [event.marker for event in found] == sorted(marker for marker, _, _ in PLACES)
    for event, (_, start, stop) in zip(found, sorted(PLACES), strict=True):
        assert abs(event.start - start) <= 10
        assert abs(event.stop - stop) <= 10


def test_nothing_where_all_is_well_or_something_does_not_come_back(half):
    assert detect(half) == ({"peaks": [], "noise": [], "steps": [], "slow": []}, [])
    shifted = put(half, [("LANK", 386, 1200)], lambda length: np.ones((length, 1)) * [30, 10, -20])
    assert slow_changes(shifted) == []


@pytest.mark.parametrize("culprit", range(5))
def test_on_a_rigid_segment_the_distances_tell_whose_it_is(culprit):
    rng = np.random.default_rng(6)
    rotation = Rotation.from_rotvec(np.cumsum(rng.normal(0, 0.02, (400, 3)), axis=0)).as_matrix()
    rigid = np.einsum("tij,mj->tmi", rotation, rng.normal(0, 80, (5, 3)))
    loose = rigid.mean(axis=1, keepdims=True) + np.cumsum(rng.normal(0, 2, (400, 4, 3)), axis=0)
    positions = np.concatenate([rigid, loose], axis=1)
    positions[200:250, culprit] += triangle(50, [0.3, 0.2, -0.1])
    scene = Scene(positions, 100.0, [np.delete(np.arange(9), m) for m in range(9)])
    company = Company(scene, None, options_of("slow", "default"), RIDGE)  # the matches do not matter
    event = Event("culprit", 200, 250, 1.0, "xyz")
    for other in set(range(9)) - {culprit}:
        assert company.more_disturbed(culprit, other, event)
        assert not company.more_disturbed(other, culprit, event)


def without_neighbours(recording, places, ranks):
    """The recording with a gap in neighbours of so many ranks from the middle of each place to well after it."""
    positions, near = recording.positions.copy(), neighbours(recording.positions)
    for marker, start, stop in places:
        own = near[recording.markers.index(marker)]
        positions[(start + stop) // 2 : stop + 60, own[ranks]] = np.nan
    return replace(recording, positions=positions)


@pytest.mark.parametrize("ranks", [[3], [1, 4, 8]])
def test_found_though_neighbours_come_and_go(half, ranks):
    assert slow_changes(without_neighbours(half, PLACES, ranks)) == []
    changed = put(half, PLACES, lambda length: triangle(length, [3, 1, -2]))
    found = slow_changes(without_neighbours(changed, PLACES, ranks))
    assert [event.marker for event in found] == sorted(marker for marker, _, _ in PLACES)
    for event, (_, start, stop) in zip(found, sorted(PLACES), strict=True):
        assert abs(event.start - start) <= 12
        assert abs(event.stop - stop) <= 12


@pytest.mark.parametrize(("stop", "transient"), [(118, [1]), (160, [])])
def test_what_is_brief_depends_on_how_long_the_event_is(stop, transient):
    positions = np.zeros((300, 3, 3))
    positions[108:112, 1] = np.nan
    scene = Scene(positions, 100.0, [np.array([1, 2]), np.array([0, 2]), np.array([0, 1])])
    company = Company(scene, None, options_of("slow", "default"), RIDGE)
    assert company.transient(0, Event("a", 100, stop, 2.0, "xyz")).tolist() == transient


def test_where_a_near_neighbour_is_briefly_gone_nothing_is_told():
    positions = np.zeros((300, 3, 3))
    positions[108:112, 1] = np.nan
    positions[200:220, 2] = np.nan
    scene = Scene(positions, 100.0, [np.array([1, 2]), np.array([0, 2]), np.array([0, 1])])
    gone = briefly_gone(scene, options_of("slow", "default"))
    assert gone[108:112, [0, 2]].all()
    assert np.count_nonzero(gone) == 8


@pytest.mark.parametrize("place", [("LUPA", 900, 1040), ("LHEE", 600, 750)])
def test_a_gross_drift_is_found_amid_motion(half, place):
    [event] = slow_changes(put(half, [place], lambda length: triangle(length, [9, 3, -6])))
    marker, start, stop = place
    assert event.marker == marker
    assert abs(event.start - start) <= 20
    assert abs(event.stop - stop) <= 20


@pytest.mark.parametrize(
    ("elsewhere", "expected"),
    [([], 1), ([0.9], 1), ([5, 0.9], 1.53), ([0.9, 0.4, 5], 1.53), ([2, 2], 3), ([50, 40], 3)],
)
def test_what_a_marker_does_elsewhere_too_raises_the_bar(elsewhere, expected):
    score = np.zeros(2000)
    score[1000:1020] = 1.4
    for place, height in zip((200, 500, 1500), elsewhere, strict=False):
        score[place - 10 : place + 10] = np.minimum(np.r_[1:11, 10:0:-1] / 10, 1) * height
    asked = bar(score, 1000, 1020, rate=100.0, options=options_of("slow", "default"))
    assert asked == pytest.approx(expected)
