"""Global linear regression: a marker from the laboratory coordinates of markers at a steady distance (tits2018)."""

from __future__ import annotations

import numpy as np

from markermend.numerics.patterns import group_by_pattern
from markermend.options.prediction.global_regression import GlobalRegressionOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.marker_selection import evenly_spaced, reference_markers
from markermend.prediction.scene import Scene

CENTRINGS = ("complete", "available")
"""What is subtracted from every frame: the mean of the neighbours that are never missing (of the inputs where there are
none), or, as in the paper, of those observed in that frame. Never of all markers: these may be on another person."""


class GlobalRegression:
    """The global linear regression as a predictor (tits2018 eq 2, 3); it states no error.

    Parameters
    ----------
    options : GlobalRegressionOptions
        Options of the choice of references and of the training.

    Raises
    ------
    ValueError
        If the centring is unknown.
    """

    name = "linear_regression"
    continuous = False

    def __init__(self, options: GlobalRegressionOptions) -> None:
        if options.centring not in CENTRINGS:
            raise ValueError(f"unknown centring {options.centring!r}: one of {', '.join(CENTRINGS)}")
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker; frames that show the same references share a regression. See `Predictor.predict`."""
        options = self.options
        hidden = scene.without(marker, start, stop)
        frames, prediction = hidden.bordered(start, stop), Prediction.empty(start, stop)
        ranked, deviation = reference_markers(
            hidden, marker, max_frames=options.max_training_frames, min_frames=options.min_training_frames
        )
        steady = deviation < options.max_distance_deviation_mm
        references = ranked[steady | (np.arange(len(ranked)) < options.min_inputs)]
        for used, places in group_by_pattern(hidden.present[np.ix_(frames, references)], options.min_inputs):
            rows = frames[places]
            if used.any():
                prediction.positions[rows - (start - 1)] = self._regress(hidden, marker, references[used], rows)
        return prediction

    def _regress(self, scene: Scene, marker: int, inputs: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Position (n, 3) at rows, which show all inputs; NaN where too few frames train."""
        joint = scene.present[:, marker] & scene.present[:, inputs].all(axis=1)
        if np.count_nonzero(joint) < self.options.min_training_frames:
            return np.full((len(rows), 3), np.nan)
        training = evenly_spaced(np.flatnonzero(joint), self.options.max_training_frames)
        both = np.concatenate([training, rows])
        centre = self._centre(scene, marker, inputs, both)
        design = (scene.positions[np.ix_(both, inputs)] - centre[:, None]).reshape(len(both), -1)
        mean = design[: len(training)].mean(axis=0)
        design = np.concatenate([np.ones((len(both), 1)), design - mean], axis=1)
        target = scene.positions[training, marker] - centre[: len(training)]
        beta = np.linalg.lstsq(design[: len(training)], target, rcond=1e-6)[0]
        predicted: np.ndarray = design[len(training) :] @ beta + centre[len(training) :]
        return predicted

    def _centre(self, scene: Scene, marker: int, inputs: np.ndarray, frames: np.ndarray) -> np.ndarray:
        """What is subtracted from each frame, (n, 3)."""
        near = np.sort(np.asarray(scene.neighbours[marker], int))
        centre: np.ndarray
        if self.options.centring == "available":
            positions = scene.positions[np.ix_(frames, near)]
            known = scene.present[np.ix_(frames, near)]
            centre = np.where(known[..., None], positions, 0).sum(axis=1) / known.sum(axis=1)[:, None]
        else:
            complete = near[scene.present[:, near].all(axis=0)]
            centre = scene.positions[np.ix_(frames, complete if len(complete) else inputs)].mean(axis=1)
        return centre
