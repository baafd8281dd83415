"""Samples under unlabelled trajectories: found where they are a missing marker's, and nothing where that is in doubt."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.detection.labelling.unlabelled import unlabelled_samples
from markermend.detection.labels import find_labels
from markermend.mesh.inference import infer_mesh
from markermend.options.detection.labels import LabelsOptions
from markermend.options.mesh import MeshOptions
from markermend.prediction.scene import Scene


def find(recording, **options):
    mesh = infer_mesh([replace(recording, facts={"recording": "r"})], options=MeshOptions())
    return find_labels(Scene.of(recording, mesh), markers=recording.markers, options=LabelsOptions(**options)).events


def cut_out(recording, *stretches):
    """Take stretches (marker, trajectory, start, stop) out of markers and put them under trajectories."""
    positions, tracks = recording.positions.copy(), {}
    for marker, name, start, stop in stretches:
        m = recording.markers.index(marker)
        track = tracks.setdefault(name, np.full((recording.frames, 3), np.nan))
        track[start:stop] = recording.positions[start:stop, m]
        positions[start:stop, m] = np.nan
    return replace(recording, positions=positions, unlabelled=tracks)


def places(found):
    return [(event.marker, event.start, event.stop, event.source) for event in found]


@pytest.mark.parametrize(("start", "stop"), [(300, 310), (500, 600), (200, 700), (0, 150), (1100, 1200)])
def test_a_stretch_of_a_marker_is_found(walker, start, stop):
    found = find(cut_out(walker.recording, ("LKNE", "*7", start, stop)))
    assert places(found) == [("LKNE", start, stop, "*7")]
    assert found[0].kind == "unlabelled"
    assert find(cut_out(walker.recording, ("LKNE", "*7", start, stop)), adopt_unlabelled=True)[0].kind == "adopted"


def test_markers_of_a_segment_that_are_missing_together_are_told_apart(walker):
    stretches = [("LTHI", "*1", 400, 520), ("LKNE", "*2", 410, 500), ("LTIB", "*3", 390, 530)]
    assert places(find(cut_out(walker.recording, *stretches))) == sorted(
        (marker, start, stop, name) for marker, name, start, stop in stretches
    )


def test_pieces_of_one_gap_under_several_trajectories(walker):
    damaged = cut_out(walker.recording, ("LKNE", "*1", 400, 450), ("LKNE", "*2", 450, 520), ("RKNE", "*1", 600, 650))
    assert places(find(damaged)) == [("LKNE", 400, 450, "*1"), ("LKNE", 450, 520, "*2"), ("RKNE", 600, 650, "*1")]


@pytest.mark.parametrize("offset_mm", [30, 60])
def test_a_trajectory_beside_the_marker_is_not_its(walker, offset_mm):
    damaged = cut_out(walker.recording, ("LKNE", "*7", 500, 600))
    ankle, knee = (walker.recording.positions[:, walker.recording.markers.index(name)] for name in ("LANK", "LKNE"))
    along = (ankle - knee) / np.linalg.norm(ankle - knee, axis=1, keepdims=True)
    across = np.cross(along, [1.0, 0.0, 0.0])
    moved = damaged.unlabelled["*7"] + offset_mm * across / np.linalg.norm(across, axis=1, keepdims=True)
    assert find(replace(damaged, unlabelled={"*7": moved})) == []
    resting = np.where(np.isnan(moved), np.nan, knee[550] + [0.0, 0.0, 40.0])
    assert find(replace(damaged, unlabelled={"*7": resting})) == []


def test_a_trajectory_is_no_markers_that_is_seen_elsewhere(walker):
    knee = walker.recording.positions[:, walker.recording.markers.index("LKNE")]
    assert find(replace(walker.recording, unlabelled={"*7": knee + 0.5})) == []
    damaged = cut_out(walker.recording, ("LKNE", "*7", 500, 600))
    track = damaged.unlabelled["*7"].copy()
    track[480:500] = knee[480:500] + 40.0
    assert find(replace(damaged, unlabelled={"*7": track})) == []


def test_where_two_trajectories_are_equally_likely_neither_is_taken(walker):
    damaged = cut_out(walker.recording, ("LKNE", "*7", 500, 600))
    twice = {"*7": damaged.unlabelled["*7"], "*8": damaged.unlabelled["*7"] + 0.5}
    assert find(replace(damaged, unlabelled=twice)) == []


def test_a_label_on_a_reflection_leaves_room_for_the_marker(walker):
    damaged = cut_out(walker.recording, ("LKNE", "*7", 400, 600))
    positions = damaged.positions.copy()
    positions[402:598, walker.recording.markers.index("LKNE")] = [900.0, 2500.0, 300.0]
    found = find(replace(damaged, positions=positions))
    assert [(event.kind, *place) for event, place in zip(found, places(found), strict=True)] == [
        ("unlabelled", "LKNE", 400, 600, "*7"), ("foreign", "LKNE", 402, 598, None),
    ]  # fmt: skip


def test_what_is_left_is_said(walker):
    found = find(cut_out(walker.recording, ("LKNE", "*7", 500, 600)))
    (text,) = unlabelled_samples(found, first_frame=11)
    assert text.endswith("100 of LKNE under *7 (frames 511 to 610)")
    assert unlabelled_samples([], first_frame=1) == []
