"""Short pieces between gaps that are another marker's, which has no label meanwhile."""

from dataclasses import replace

import numpy as np
import pytest

from markermend.core.labels import undo_exchanges
from markermend.detection.labels import find_labels
from markermend.mesh.inference import infer_mesh
from markermend.options.detection.labels import LabelsOptions
from markermend.options.mesh import MeshOptions
from markermend.prediction.scene import Scene


def find(recording, positions):
    named = replace(recording, positions=positions, facts={"recording": "r"})
    scene = Scene.of(named, infer_mesh([named], options=MeshOptions()))
    return find_labels(scene, markers=recording.markers, options=LabelsOptions()).events


@pytest.mark.parametrize(("marker", "other"), [("RWRA", "RWRB"), ("LKNE", "LTIB"), ("LHEE", "LTOE"), ("LSHO", "CLAV")])
@pytest.mark.parametrize("length", [12, 20, 60])
def test_a_label_on_the_trajectory_of_another_marker_between_gaps(walker, marker, other, length):
    positions, index = walker.recording.positions.copy(), walker.recording.markers.index
    positions[495 : 508 + length, [index(marker), index(other)]] = np.nan
    clean = positions.copy()
    clean[500 : 500 + length, index(other)] = walker.recording.positions[500 : 500 + length, index(other)]
    positions[500 : 500 + length, index(marker)] = clean[500 : 500 + length, index(other)]
    found = find(walker.recording, positions)
    assert [(event.marker, event.start, event.stop, event.partner) for event in found] == sorted(
        [(marker, 500, 500 + length, other), (other, 500, 500 + length, marker)]
    )
    assert np.array_equal(undo_exchanges(positions, found, walker.recording.markers), clean, equal_nan=True)


def test_pieces_that_are_right_stay(walker):
    positions, rng = walker.recording.positions.copy(), np.random.default_rng(3)
    for start in range(50, 1100, 60):
        some = rng.choice(positions.shape[1], 6, replace=False)
        positions[start : start + 15, some] = positions[start + 30 : start + 40, some] = np.nan
    assert find(walker.recording, positions) == []
