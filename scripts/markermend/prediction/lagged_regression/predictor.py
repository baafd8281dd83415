"""Lagged regressions (skurowski2022 3.3): a marker from its segment mates and parent marker, now and before.

A row of inputs holds their laboratory coordinates now and a few samples before, and powers of these (eq 9, 11). Where
an earlier sample is missing, the present one stands in. The marker's own past is not an input.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from markermend.numerics.patterns import group_by_pattern
from markermend.options.prediction.lagged_regression import LaggedRegressionOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.marker_selection import evenly_spaced, jointly_observed
from markermend.prediction.scene import Scene

LAGGED_REGRESSIONS = ("polynomial", "replicated_network")
"""The lagged regressions by name."""

Job = tuple[Scene, int, np.ndarray]
"""What to train for: a scene, a marker, its inputs."""


@dataclass(frozen=True)
class TrainingSet:
    """What a regression is trained on.

    Attributes
    ----------
    rows : np.ndarray
        Rows of inputs (n, k), mm.
    target : np.ndarray
        Positions of the marker (n, 3), mm.
    frames : np.ndarray
        Frames of the rows (n,).
    marker : int
        Index of the marker.
    """

    rows: np.ndarray
    target: np.ndarray
    frames: np.ndarray
    marker: int


@dataclass(frozen=True)
class Regression:
    """A trained regression.

    Attributes
    ----------
    predict : Callable[[np.ndarray], np.ndarray]
        Maps rows of inputs (n, k) to positions (n, 3), mm.
    error : float
        Standard deviation of each axis, mm; NaN if unknown.
    """

    predict: Callable[[np.ndarray], np.ndarray]
    error: float


class LaggedRegression(ABC):
    """What the lagged regressions share: the choice of inputs, rows of them, and the cache of trained regressions.

    Parameters
    ----------
    options : LaggedRegressionOptions
        Options of the inputs and of the training.
    """

    name: str
    continuous = False

    def __init__(self, options: LaggedRegressionOptions) -> None:
        self.options = options

    @abstractmethod
    def fit(self, training: Sequence[TrainingSet]) -> list[Regression]:
        """Train a regression on each training set.

        Parameters
        ----------
        training : Sequence[TrainingSet]
            The training sets.

        Returns
        -------
        list[Regression]
            Their regressions, in the same order.
        """

    def rows(self, scene: Scene, marker: int, inputs: np.ndarray, frames: np.ndarray) -> np.ndarray:
        """Assemble the rows of inputs of a marker.

        Parameters
        ----------
        scene : Scene
            What is observed.
        marker : int
            Index of the marker.
        inputs : np.ndarray
            Indices of the markers that are inputs.
        frames : np.ndarray
            Frames (n,) that show the inputs.

        Returns
        -------
        np.ndarray
            Coordinates of the inputs now and at the lags, (n, k), mm.
        """
        step = max(1, round(self.options.lag_interval_s * scene.rate))
        parts = [scene.positions[np.ix_(frames, inputs)].reshape(len(frames), -1)]
        for lag in range(1, self.options.lags + 1):
            before = scene.positions[np.ix_(np.maximum(frames - lag * step, 0), inputs)].reshape(len(frames), -1)
            parts.append(np.where(np.isnan(before), parts[-1], before))
        return np.concatenate(parts, axis=1)

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker; where a usual input is missing, others replace it in a further model. See `Predictor.predict`."""
        hidden = scene.without(marker, start, stop)
        prediction, first = Prediction.empty(start, stop), start - 1
        for inputs, rows in self._assignments(hidden, marker, hidden.bordered(start, stop)):
            regression = self._trained([(hidden, marker, inputs)])[0]
            prediction.positions[rows - first] = regression.predict(self.rows(hidden, marker, inputs, rows))
            prediction.error[rows - first] = regression.error
        return prediction

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Compute residuals, NaN also where an input is missing; all are trained at once. See `ResidualSource.residuals`."""
        return self.trained_on(scene, markers).residuals(scene)

    def trained_on(self, scene: Scene, markers: np.ndarray | None = None) -> TrainedRegressions:
        """Train for the usual inputs of markers, all at once.

        Parameters
        ----------
        scene : Scene
            What is observed.
        markers : np.ndarray | None
            Indices of the markers; all if None.

        Returns
        -------
        TrainedRegressions
            Their regressions, which predict in other scenes of the same markers, too.
        """
        jobs = self._usual_jobs((scene, m) for m in (range(scene.positions.shape[1]) if markers is None else markers))
        trained = zip(jobs, self._trained(jobs), strict=True)
        return TrainedRegressions(self, {marker: (inputs, own) for (_, marker, inputs), own in trained})

    def train(self, jobs: Sequence[tuple[Scene, int]]) -> None:
        """Train for the usual inputs. See `Trainable.train`."""
        self._trained(self._usual_jobs(jobs))

    def _usual_jobs(self, jobs: Iterable[tuple[Scene, int]]) -> list[Job]:
        """The jobs with their usual inputs, without markers that are observed too rarely."""
        chosen = [(scene, marker, self._usual_inputs(scene, marker)) for scene, marker in jobs]
        return [job for job in chosen if len(job[2])]

    def _trained(self, jobs: Sequence[Job]) -> list[Regression]:
        """The regression of each job; those that its scene has not cached are trained, all at once."""
        keys = [(self, marker, inputs.tobytes()) for _, marker, inputs in jobs]
        new: Callable[[], list[Regression]] = list
        caches = [job[0].cached(key, new) for job, key in zip(jobs, keys, strict=True)]
        untrained = [number for number, cache in enumerate(caches) if not cache]
        trained = self.fit([self._training_set(*jobs[number]) for number in untrained])
        for number, regression in zip(untrained, trained, strict=True):
            caches[number].append(regression)
        return [cache[0] for cache in caches]

    def _training_set(self, scene: Scene, marker: int, inputs: np.ndarray) -> TrainingSet:
        """Frames that show the marker and its inputs; filled ones count only if the measured ones are too few."""
        for source in (scene.measured or scene, scene):
            joint = np.flatnonzero(source.present[:, marker] & source.present[:, inputs].all(axis=1))
            if len(joint) >= self.options.min_training_frames:
                break
        frames = evenly_spaced(joint, self.options.max_training_frames)
        rows = self.rows(source, marker, inputs, frames)
        return TrainingSet(rows, source.positions[frames, marker], frames, marker)

    def _ranked(self, scene: Scene, marker: int) -> tuple[np.ndarray, int]:
        """Segment mates and parent marker, then the other neighbours in the mesh's order; and how many to use."""
        near = np.asarray(scene.neighbours[marker], int)
        if scene.segment_mates is None:
            return near, self.options.neighbours
        first = np.asarray(scene.segment_mates[marker], int)
        return np.concatenate([first, near[~np.isin(near, first)]]), len(first)

    def _usual_inputs(self, scene: Scene, marker: int) -> np.ndarray:
        """The inputs of a marker, ascending; none where it is observed too rarely with others."""
        ranked, count = self._ranked(scene, marker)
        return np.sort(self._joint(scene, marker, ranked)[:count])

    def _joint(self, scene: Scene, marker: int, ranked: np.ndarray) -> np.ndarray:
        """Those of the ranked markers that leave enough training frames."""
        share, minimum = self.options.min_joint_share, self.options.min_training_frames
        return jointly_observed(scene, marker, ranked, min_share=share, min_frames=minimum)[0]

    def _assignments(self, scene: Scene, marker: int, frames: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Inputs and the frames that they are to predict: the usual inputs first, then what else is observed."""
        usual = self._usual_inputs(scene, marker)
        if len(usual) == 0:
            return
        complete = scene.present[np.ix_(frames, usual)].all(axis=1)
        if complete.any():
            yield usual, frames[complete]
        left = frames[~complete]
        if len(left) == 0:
            return
        ranked, count = self._ranked(scene, marker)
        for used, places in group_by_pattern(scene.present[np.ix_(left, ranked)], count):
            inputs = self._joint(scene, marker, ranked[used])
            if len(inputs):
                yield np.sort(inputs[:count]), left[places]


@dataclass(frozen=True)
class TrainedRegressions:
    """Trained regressions as a source of residuals.

    Attributes
    ----------
    regression : LaggedRegression
        The kind of regression.
    by_marker : Mapping[int, tuple[np.ndarray, Regression]]
        The inputs and the regression of each marker, by its index.
    """

    regression: LaggedRegression
    by_marker: Mapping[int, tuple[np.ndarray, Regression]]

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Compute residuals, NaN also where an input is missing. See `ResidualSource.residuals`."""
        out = np.full(scene.positions.shape, np.nan)
        for m, (inputs, own) in self.by_marker.items():
            if markers is None or m in markers:
                rows = np.flatnonzero(scene.present[:, m] & scene.present[:, inputs].all(axis=1))
                out[rows, m] = scene.positions[rows, m] - own.predict(self.regression.rows(scene, m, inputs, rows))
        return out
