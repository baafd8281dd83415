"""What displacements are estimated from: a marker and its neighbours in the local frame of these."""

import numpy as np

from markermend.prediction.local_ridge.model import TrainingSet

RATE, RIDGE = 50.0, 0.01


def displaced_marker(course, vector=(6.0, -2.0, 3.0), *, frames=500, seed=0):
    """Two neighbours that move, and a marker that follows them, with 0.3 mm of noise and a displacement."""
    rng = np.random.default_rng(seed)
    time_s = np.arange(frames) / RATE
    pose = np.sin(time_s[:, None] * rng.uniform(2, 9, 6) + rng.uniform(0, 6, 6)) * rng.uniform(2, 9, 6)
    local = pose @ rng.normal(0, 0.3, (6, 3)) + rng.normal(0, 0.3, (frames, 3)) + course.at(time_s)[:, None] * vector
    columns = np.concatenate([pose, local], axis=1)
    return TrainingSet(
        np.arange(2), np.arange(2), np.zeros((2, 3)), np.zeros(9), columns, np.ones(frames), np.arange(frames)
    )
