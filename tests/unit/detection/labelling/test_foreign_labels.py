"""Labels on something else: these intervals, of the class foreign; nothing where a marker is displaced on its segment."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.recording import Recording
from markermend.detection.labels import find_labels
from markermend.mesh.inference import infer_mesh
from markermend.options.detection.labels import LabelsOptions
from markermend.options.mesh import MeshOptions
from markermend.prediction.scene import Scene


def find(recording, positions):
    changed = replace(recording, positions=positions, facts={"recording": "one"})
    mesh = infer_mesh([changed], options=MeshOptions())
    found = find_labels(Scene.of(changed, mesh), markers=changed.markers, options=LabelsOptions()).events
    return [(event.marker, event.start, event.stop, event.kind) for event in found]


def floor(positions):
    return np.nanmin(positions[..., 2])


@pytest.mark.parametrize("name", ["LTHI", "RWRA", "LFHD", "C7"])
@pytest.mark.parametrize("length", [30, 150])
def test_a_label_on_a_still_reflection_between_gaps(walker, name, length):
    positions, m = walker.recording.positions.copy(), walker.recording.markers.index(name)
    positions[480:500, m] = positions[500 + length : 510 + length, m] = np.nan
    rng = np.random.default_rng(0)
    positions[500 : 500 + length, m] = positions[500, m] + [300, -200, 250] + rng.normal(0, 0.1, (length, 3))
    assert find(walker.recording, positions) == [(name, 500, 500 + length, "foreign")]


def test_a_reflection_that_is_not_seen_in_every_frame_is_one_finding(walker):
    positions, m = walker.recording.positions.copy(), walker.recording.markers.index("LTHI")
    positions[480:500, m] = positions[600:610, m] = np.nan
    positions[500:600, m] = positions[500, m] + [300, -200, 250]
    positions[520:523, m] = positions[570, m] = np.nan
    assert find(walker.recording, positions) == [("LTHI", 500, 600, "foreign")]


@pytest.mark.parametrize("name", ["LTHI", "RWRA", "CLAV"])
def test_a_marker_that_falls_and_lies_on_the_floor_to_the_end(walker, name):
    positions, m = walker.recording.positions.copy(), walker.recording.markers.index(name)
    down = positions[800, m, 2] - floor(positions)
    time = np.arange(400) / 100
    positions[800:, m] = positions[800, m] + np.stack([80 * np.minimum(time / 0.4, 1), 0 * time, 0 * time], axis=1)
    positions[800:, m, 2] -= np.minimum(9810 / 2 * time**2, down)
    ((found, start, stop, kind),) = find(walker.recording, positions)
    assert (found, stop, kind) == (name, 1200, "foreign")
    assert 770 <= start <= 815


@pytest.mark.parametrize("seed", [1, 4])
def test_a_marker_that_stays_where_it_was_while_the_others_move_on(seed):
    """What is taken away begins when its distances change, not when noise changed them last."""
    rng, frame = np.random.default_rng(seed), np.arange(300)
    body, path = rng.uniform(-200, 200, (10, 3)), np.stack([1.5 * frame, 300 * np.sin(frame / 40), 0 * frame], axis=1)
    positions = body + path[:, None] + rng.normal(0, 0.8, (300, 10, 3))
    positions[250:, 4] = positions[250, 4]
    recording = Recording(tuple(f"M{i}" for i in range(10)), positions, 100.0)
    ((found, start, stop, kind),) = find(recording, positions)
    assert (found, stop, kind) == ("M4", 300, "foreign")
    assert 249 <= start <= 253


@pytest.mark.parametrize("name", ["LTHI", "RWRA", "CLAV"])
def test_a_marker_that_lies_still_in_most_of_the_only_recording(walker, name):
    positions, m = walker.recording.positions.copy(), walker.recording.markers.index(name)
    noise = np.random.default_rng(1).normal(0, 0.2, (800, 3))
    positions[400:, m] = noise + np.append(positions[400, m, :2] + 80, floor(positions))
    assert find(walker.recording, positions) == [(name, 400, 1200, "foreign")]


def test_two_labels_on_one_marker(walker):
    positions, index = walker.recording.positions.copy(), walker.recording.markers.index
    positions[500:530, index("LTHI")] = positions[500:530, index("LKNE")]
    assert find(walker.recording, positions) == [("LTHI", 500, 530, "foreign")]


@pytest.mark.parametrize("size", [25.0, 40.0])
def test_a_marker_that_was_displaced_on_its_segment_is_not_foreign(walker, size):
    positions, index = walker.recording.positions.copy(), walker.recording.markers.index
    out = positions[:, index("LTHI")] - positions[:, index("RTHI")]
    positions[700:, index("LTHI")] += (size * out / np.linalg.norm(out, axis=1, keepdims=True))[700:]
    assert find(walker.recording, positions) == []


def test_a_brief_jump_is_left_to_other_detectors(walker):
    positions, m = walker.recording.positions.copy(), walker.recording.markers.index("LTHI")
    positions[500:520, m] += [100.0, 50.0, -50.0]
    assert find(walker.recording, positions) == []


def test_a_label_that_was_on_another_spot_all_the_time_is_left(walker):
    positions, m = walker.recording.positions.copy(), walker.recording.markers.index("LTHI")
    positions[:, m] = positions[:, walker.recording.markers.index("LKNE")] + [0, 0, 100]
    assert find(walker.recording, positions) == []
