"""A body whose loose marker is predicted by its neighbours, with a change of its own: the drifts that are estimated of it."""

import numpy as np

from markermend.detection.neighbour.drifts.estimated import EstimatedDrifts
from markermend.detection.neighbour.drifts.regression import DriftRegression
from markermend.prediction.interface import LocalRegression
from support.signals import options_of

OPTIONS = options_of("slow", "default")
RATE = 100.0


def drifts(change, seed=0, known=None):
    """Drifts in a marker that follows slow inputs, with a change (frames, 3) put on it."""
    rng = np.random.default_rng(seed)
    frames = len(change)
    inputs = 100 * np.sin(np.arange(frames)[:, None] / rng.uniform(60, 300, 6) + rng.uniform(0, 6, 6))
    noise = np.stack([np.convolve(rng.normal(0, 3, frames + 40), np.ones(41) / 41, "valid") for _ in range(3)], axis=1)
    target = inputs @ rng.normal(0, 0.3, (6, 3)) + noise + rng.normal(0, 0.1, (frames, 3)) + change
    rows = np.arange(frames) if known is None else np.flatnonzero(known)
    full = np.c_[np.ones(frames), inputs]
    residual = target - full @ np.linalg.lstsq(full, target, rcond=None)[0]
    on_all = np.full((frames, 1, 3), np.nan)
    on_all[rows, 0] = residual[rows]
    regression = DriftRegression(RATE, OPTIONS.estimated_drifts)
    own = LocalRegression(0, rows, inputs[rows], target[rows], residual[rows], np.ones(len(rows)))
    models = regression.models(regression.binned([own], frames), np.ones((frames // regression.step, 1)))
    return EstimatedDrifts(regression, models, on_all, OPTIONS)
