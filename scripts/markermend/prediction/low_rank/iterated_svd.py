"""Iterated truncated SVD of the matrix of coordinates."""

from __future__ import annotations

import numpy as np

from markermend.numerics.low_rank import complete_matrix
from markermend.options.prediction import IteratedSvdOptions
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Prediction, Scene


class IteratedSvd:
    """Truncated SVD of frames by coordinates, iterated until the missing samples agree with it; states no error."""

    name = "msvd"
    continuous = False

    def __init__(self, options: IteratedSvdOptions) -> None:
        """Keep the options."""
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Frames that show no other marker are left open."""
        options = self.options
        hidden = scene.without(marker, start, stop)
        positions = np.full((stop - start + 2, 3), np.nan)
        nothing = Prediction(positions, np.full(len(positions), np.nan))
        near = np.asarray(hidden.neighbours[marker], int)[: options.neighbours]
        near = near[np.count_nonzero(hidden.present[:, near], axis=0) >= options.min_training_frames]
        asked = np.arange(max(start - 1, 0), min(stop + 1, len(hidden.positions)))
        asked = asked[hidden.present[np.ix_(asked, near)].any(axis=1)]
        if len(asked) == 0 or np.count_nonzero(hidden.present[:, marker]) < options.min_training_frames:
            return nothing
        centres, training = self._centres(hidden, marker, near, asked)
        rows = np.union1d(evenly_spaced(training, options.max_training_frames), asked)
        values = hidden.positions[np.ix_(rows, np.append(marker, near))]
        centre = values[:, 1:][:, centres].mean(axis=1) if centres.any() else np.zeros((len(rows), 3))
        place = np.searchsorted(rows, asked)
        # The model is asked about the borders too: what it says there tells by how much it is off.
        values[place, 0] = np.nan
        filled, _ = complete_matrix(
            (values - centre[:, None]).reshape(len(rows), -1),
            explained=options.explained_variance,
            shrinkage=options.shrink_singular_values,
            tolerance=options.tolerance_mm,
            iterations=options.max_iterations,
        )
        positions[asked - (start - 1)] = filled[place, :3] + centre[place]
        return nothing

    def _centres(self, scene: Scene, marker: int, near: np.ndarray, asked: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Which neighbours (mask) centre a frame, and the frames to learn from: those that show them and the marker."""
        if self.options.centred:
            throughout = near[scene.present[np.ix_(asked, near)].all(axis=0)]
            never_missing = throughout[scene.present[:, throughout].all(axis=0)]
            chosen, joint = jointly_observed(
                scene,
                marker,
                never_missing if len(never_missing) else throughout,
                share=self.options.min_joint_share,
                minimum_frames=self.options.min_training_frames,
            )
            if len(chosen):
                return np.isin(near, chosen), joint
        return np.zeros(len(near), bool), np.flatnonzero(scene.present[:, marker])
