"""Iterated truncated singular value decomposition of the matrix of frames by coordinates."""

from __future__ import annotations

import numpy as np

from markermend.numerics.low_rank import complete_matrix
from markermend.options.prediction.low_rank import IteratedSvdOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Scene


class IteratedSvd:
    """Low-rank completion of the matrix of frames by coordinates as a predictor; it states no error.

    Parameters
    ----------
    options : IteratedSvdOptions
        Options of the choice of markers and frames, and of the completion.
    """

    name = "msvd"
    continuous = False

    def __init__(self, options: IteratedSvdOptions) -> None:
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker; frames that show no other marker stay NaN. See `Predictor.predict`."""
        options = self.options
        hidden = scene.without(marker, start, stop)
        prediction = Prediction.empty(start, stop)
        near = np.asarray(hidden.neighbours[marker], int)[: options.neighbours]
        near = near[np.count_nonzero(hidden.present[:, near], axis=0) >= options.min_training_frames]
        frames = hidden.bordered(start, stop)
        frames = frames[hidden.present[np.ix_(frames, near)].any(axis=1)]
        if len(frames) == 0 or np.count_nonzero(hidden.present[:, marker]) < options.min_training_frames:
            return prediction
        centring, training = self._centring(hidden, marker, near, frames)
        rows = np.union1d(evenly_spaced(training, options.max_training_frames), frames)
        values = hidden.positions[np.ix_(rows, np.append(marker, near))]
        centre = values[:, 1:][:, centring].mean(axis=1) if centring.any() else np.zeros((len(rows), 3))
        place = np.searchsorted(rows, frames)
        # The borders are predicted too: the misfit there is what the time constraint corrects.
        values[place, 0] = np.nan
        filled, _ = complete_matrix(
            (values - centre[:, None]).reshape(len(rows), -1),
            explained=options.explained_variance,
            shrinkage=options.shrink_singular_values,
            tolerance=options.tolerance_mm,
            iterations=options.max_iterations,
        )
        prediction.positions[frames - (start - 1)] = filled[place, :3] + centre[place]
        return prediction

    def _centring(
        self, scene: Scene, marker: int, near: np.ndarray, frames: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Which neighbours (mask) have their mean subtracted, and the training frames: those that show them all."""
        if self.options.centred:
            throughout = near[scene.present[np.ix_(frames, near)].all(axis=0)]
            never_missing = throughout[scene.present[:, throughout].all(axis=0)]
            chosen, joint = jointly_observed(
                scene,
                marker,
                never_missing if len(never_missing) else throughout,
                min_share=self.options.min_joint_share,
                min_frames=self.options.min_training_frames,
            )
            if len(chosen):
                return np.isin(near, chosen), joint
        return np.zeros(len(near), bool), np.flatnonzero(scene.present[:, marker])
