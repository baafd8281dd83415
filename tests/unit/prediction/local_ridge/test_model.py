"""Training data in a local frame: inputs about their typical place."""

import numpy as np
from scipy.spatial.transform import Rotation

from markermend.prediction.local_ridge.model import TrainingSet
from support.fillings import rigid_body


def test_inputs_are_local_coordinates_about_their_typical_place():
    body = rigid_body(frames=30, markers=5)
    template = body[0, :3] - body[0, :3].mean(axis=0)
    centre = np.arange(9.0)
    data = TrainingSet(np.arange(3), np.array([3, 4]), template, centre, np.zeros((1, 9)), np.ones(1), np.zeros(1, int))
    rows = np.array([0, 7, 20])
    found = data.inputs_at(body, np.array([False, True]), rows)
    local = body[0, 4] - body[0, :3].mean(axis=0)
    assert np.allclose(found.values, local - centre[3:6])
    for row, axes in zip(rows, found.frames.axes, strict=True):
        own = body[row, :3] - body[row, :3].mean(axis=0)
        assert np.allclose(Rotation.from_matrix(axes).apply(template), own)
