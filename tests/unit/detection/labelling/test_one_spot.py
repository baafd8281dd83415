"""Two labels on one marker, which is found however the body moves; which one is right is said by where the other came from."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.detection.labelling.one_spot import shared_spots
from markermend.detection.labels import find_labels
from markermend.mesh.inference import infer_mesh
from markermend.options.detection.labels import LabelsOptions
from markermend.options.mesh import MeshOptions
from markermend.prediction.scene import Scene


def find(recording, positions):
    named = replace(recording, positions=positions, facts={"recording": "r"})
    scene = Scene.of(named, infer_mesh([named], options=MeshOptions()))
    found = find_labels(scene, markers=recording.markers, options=LabelsOptions()).events
    return [(event.marker, event.start, event.stop, event.kind) for event in found]


@pytest.mark.parametrize("noise_mm", [0.0, 0.3])
@pytest.mark.parametrize(
    ("marker", "other", "start", "stop"),
    [("LTHI", "LKNE", 500, 512), ("LTOE", "RTOE", 300, 400), ("RWRA", "RWRB", 0, 60), ("LKNE", "LTIB", 1150, 1200)],
)
def test_a_label_on_the_marker_of_another_one(walker, marker, other, start, stop, noise_mm):
    positions, index = walker.recording.positions.copy(), walker.recording.markers.index
    noise = np.random.default_rng(0).normal(0, noise_mm, (stop - start, 3))
    positions[start:stop, index(marker)] = positions[start:stop, index(other)] + noise
    assert find(walker.recording, positions) == [(marker, start, stop, "foreign")]


def test_a_label_that_comes_from_a_gap(walker):
    positions, index = walker.recording.positions.copy(), walker.recording.markers.index
    positions[490:500, index("LTHI")] = positions[560:570, index("LTHI")] = np.nan
    positions[500:560, index("LTHI")] = positions[500:560, index("LKNE")]
    assert find(walker.recording, positions) == [("LTHI", 500, 560, "foreign")]


@pytest.mark.filterwarnings("error")
def test_where_nothing_says_which_of_two_labels_is_right_neither_is_taken(walker):
    positions, index = walker.recording.positions[:600].copy(), walker.recording.markers.index
    pair = [index("LTHI"), index("LKNE")]
    positions[500:550, pair[0]] = positions[500:550, pair[1]]
    positions[[499, 550]] = np.nan
    positions[500:550, np.delete(np.arange(positions.shape[1]), pair)] = np.nan
    assert find(walker.recording, positions) == []


def test_points_that_are_always_on_one_spot_are_no_fault(walker):
    positions = walker.recording.positions
    doubled = replace(
        walker.recording,
        markers=(*walker.recording.markers, "LTHI#2"),
        positions=np.concatenate([positions, positions[:, [walker.recording.markers.index("LTHI")]]], axis=1),
    )
    assert find(doubled, doubled.positions) == []


@pytest.mark.parametrize(("share", "warned"), [(1.0, True), (0.95, True), (0.6, False), (0.0, False)])
def test_labels_on_one_marker_throughout_are_warned_of(walker, share, warned):
    markers, positions = walker.recording.markers, walker.recording.positions.copy()
    a, b = markers.index("LTHI"), markers.index("LKNE")
    positions[: int(share * len(positions)), b] = positions[: int(share * len(positions)), a] + 0.5
    positions[100:110, a] = np.nan
    warnings = shared_spots(positions, markers=markers, options=LabelsOptions())
    assert warnings == warned * [
        "labels that may be on one marker, nearer to each other than 3 mm throughout: "
        + " and ".join(sorted(("LTHI", "LKNE"), key=markers.index))
    ]
