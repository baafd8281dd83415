"""Global linear regression: a marker from the laboratory coordinates of all that keep their distance (tits2018 eq 2, 3)."""

from __future__ import annotations

import numpy as np

from markermend.numerics.patterns import group_by_pattern
from markermend.options.prediction import GlobalRegressionOptions
from markermend.prediction.marker_selection import evenly_spaced, reference_markers
from markermend.prediction.scene import Prediction, Scene

CENTRINGS = ("complete", "available")
"""What is subtracted from every frame: the mean of the neighbours that are never missing (the inputs where there are
none such), or, as the paper says, of those seen in that frame. Never of all markers: these may be on another person."""


class GlobalRegression:
    """The global linear regression as a predictor; states no error."""

    name = "linear_regression"
    continuous = False

    def __init__(self, options: GlobalRegressionOptions) -> None:
        """Keep the options."""
        if options.centring not in CENTRINGS:
            raise ValueError(f"unknown centring {options.centring!r}: one of {', '.join(CENTRINGS)}")
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Frames of the gap that see the same references share a model."""
        options = self.options
        hidden = scene.without(marker, start, stop)
        frames = np.arange(max(start - 1, 0), min(stop + 1, len(scene.positions)))
        positions = np.full((stop - start + 2, 3), np.nan)
        ranked, deviation = reference_markers(
            hidden, marker, frames=options.max_training_frames, minimum_frames=options.min_training_frames
        )
        near = ranked[(deviation < options.max_distance_deviation_mm) | (np.arange(len(ranked)) < options.min_inputs)]
        seen = hidden.present[np.ix_(frames, near)]
        for used, places in group_by_pattern(seen, options.min_inputs):
            rows = frames[places]
            if used.any():
                positions[rows - (start - 1)] = self._regress(hidden, marker, near[used], rows)
        return Prediction(positions, np.full(len(positions), np.nan))

    def _regress(self, scene: Scene, marker: int, inputs: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Position (n, 3) at rows, where all inputs are seen; NaN where too few frames train."""
        seen = scene.present[:, marker] & scene.present[:, inputs].all(axis=1)
        if np.count_nonzero(seen) < self.options.min_training_frames:
            return np.full((len(rows), 3), np.nan)
        training = evenly_spaced(np.flatnonzero(seen), self.options.max_training_frames)
        both = np.concatenate([training, rows])
        centre = self._centre(scene, marker, inputs, both)
        design = (scene.positions[np.ix_(both, inputs)] - centre[:, None]).reshape(len(both), -1)
        middle = design[: len(training)].mean(axis=0)
        design = np.concatenate([np.ones((len(both), 1)), design - middle], axis=1)
        target = scene.positions[training, marker] - centre[: len(training)]
        beta = np.linalg.lstsq(design[: len(training)], target, rcond=1e-6)[0]
        return design[len(training) :] @ beta + centre[len(training) :]

    def _centre(self, scene: Scene, marker: int, inputs: np.ndarray, frames: np.ndarray) -> np.ndarray:
        """What is subtracted from each frame, (n, 3)."""
        near = np.sort(np.asarray(scene.neighbours[marker], int))
        if self.options.centring == "available":
            positions = scene.positions[np.ix_(frames, near)]
            known = scene.present[np.ix_(frames, near)]
            return np.where(known[..., None], positions, 0).sum(axis=1) / known.sum(axis=1)[:, None]
        complete = near[scene.present[:, near].all(axis=0)]
        chosen = complete if len(complete) else inputs
        return scene.positions[np.ix_(frames, chosen)].mean(axis=1)
