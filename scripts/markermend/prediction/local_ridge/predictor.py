"""Local ridge: a marker predicted from its neighbours in a local frame, with kriging of the residual.

The frame is the pose of the first observed neighbours (the anchors). The inputs are the local coordinates of up to a
dozen observed neighbours, the regression is a ridge with an intercept. It never sees the marker's own trajectory, so it
follows the body and not an artifact: the detectors work on its residual.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.numerics.kriging import Covariance, fit_covariance, krige
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.prediction.interface import LocalRegression, Prediction
from markermend.prediction.local_ridge.inputs import Assignment, InputSelection
from markermend.prediction.local_ridge.leverage import LeverageScale, fit_leverage_scale
from markermend.prediction.local_ridge.model import LocalInputs, PoseFunction, Regression, TrainingSet
from markermend.prediction.local_ridge.ridge import with_intercept
from markermend.prediction.local_ridge.ridge_regression import Pooling, RidgeRegression
from markermend.prediction.scene import Scene

MAX_BLOCKS = 12
"""Parts of a recording that are left out of the training in turn, at most; they are about as long as the gap."""

BORDER_LAGS = 12
"""Samples on either side of a gap that are kriged from, at most: the nearest, then at growing distances."""

TRUSTED_WEIGHT = 0.5
"""Training frames with a smaller robust weight are taken for artifacts: their residuals do not count as errors."""


@dataclass(frozen=True, eq=False)
class _Fit:
    """A regression of a marker, fitted to the training data of an assignment.

    function: what the regression learned without what the scene hides for trial.
    """

    marker: int
    assignment: Assignment
    regression: Regression
    function: PoseFunction

    def inputs_at(self, scene: Scene, rows: np.ndarray) -> LocalInputs:
        """The inputs of the regression at frames that show them."""
        return self.assignment.data.inputs_at(scene.positions, self.assignment.used, rows)


@dataclass(frozen=True, eq=False)
class _Residuals:
    """Residuals (n, 3), mm, laboratory axes, of a fit in the frames of its assignment, and the inputs there."""

    fit: _Fit
    inputs: LocalInputs
    values: np.ndarray


class LocalRidge:
    """The local ridge as a predictor; the detectors use its residuals.

    Parameters
    ----------
    options : LocalRidgeOptions
        Options of the frame, the regression and the kriging.
    """

    name = "local_ridge"
    continuous = True

    def __init__(self, options: LocalRidgeOptions) -> None:
        self.options = options
        self._selection = InputSelection(options)
        self._pooling = Pooling(options.pool_weights, options.pool_validation_blocks, options.min_training_frames)

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker; the error is the kriging standard deviation of left-out residuals. See `Predictor.predict`."""
        hidden = scene.without(marker, start, stop)
        prediction, first = Prediction.empty(start, stop), start - 1
        for assignment in self._selection.assignments(hidden, marker, hidden.bordered(start, stop)):
            rows = assignment.rows
            fit = self._fit_to(hidden, marker, assignment, stop - start)
            covariance, scale = self._error_model(hidden, fit, stop - start)
            # Frames of the gap and those with observations share one alignment: its cost hardly depends on their number.
            observed = self._observed_nearby(hidden, fit)
            both = np.union1d(rows, observed)
            inputs = fit.inputs_at(hidden, both)
            expected, target = fit.function.predict(inputs.values), np.searchsorted(both, rows)
            residual = inputs.frames.local(hidden.positions[both, marker]) - expected
            mean, variance = krige(
                covariance,
                observed_s=observed / hidden.rate,
                values=residual[np.searchsorted(both, observed)],
                target_s=rows / hidden.rate,
            )
            expected[target] += mean
            prediction.positions[rows - first] = inputs.frames.laboratory(expected)[target]
            prediction.error[rows - first] = np.sqrt(variance) * scale.factor(inputs.values[target])
        return prediction

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Compute residuals of regressions on all frames with robust weights. See `ResidualSource.residuals`."""
        out = np.full(scene.positions.shape, np.nan)
        for found in self._all_residuals(scene, markers):
            out[found.fit.assignment.rows, found.fit.marker] = found.values
        return out

    def scaled_residuals(
        self, scene: Scene, markers: np.ndarray | None = None, *, blocks: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """Compute residuals and their factors by leverage. See `ScaledResidualSource.scaled_residuals`."""
        out, factors = np.full(scene.positions.shape, np.nan), np.full(scene.positions.shape[:2], np.nan)
        for found in self.regressions(scene, markers, blocks=blocks):
            out[found.frames, found.marker], factors[found.frames, found.marker] = found.residual, found.factors
        return out, factors

    def regressions(self, scene: Scene, markers: np.ndarray | None = None, *, blocks: int) -> Iterator[LocalRegression]:
        """Fit the regressions of markers to all frames. See `RegressionSource.regressions`."""
        for found in self._all_residuals(scene, markers):
            marker, assignment = found.fit.marker, found.fit.assignment
            scale, _ = self._leverage_scale(found.fit, assignment.data.training * blocks // len(scene.positions))
            target = found.inputs.frames.local(scene.positions[assignment.rows, marker])
            values = found.inputs.values
            yield LocalRegression(marker, assignment.rows, values, target, found.values, scale.factor(values))

    def _all_residuals(self, scene: Scene, markers: np.ndarray | None) -> Iterator[_Residuals]:
        """Residuals of markers in all frames that show them and enough others."""
        for marker in range(scene.positions.shape[1]) if markers is None else markers:
            frames = np.flatnonzero(scene.present[:, marker])
            for assignment in self._selection.assignments(scene, marker, frames):
                regression = self._fit(assignment.data, assignment.used)
                fit = _Fit(marker, assignment, regression, regression)
                inputs = fit.inputs_at(scene, assignment.rows)
                predicted = inputs.frames.laboratory(fit.regression.predict(inputs.values))
                yield _Residuals(fit, inputs, scene.positions[assignment.rows, marker] - predicted)

    def _fit(self, data: TrainingSet, used: np.ndarray, stretch: int | None = None) -> Regression:
        """The regression on the used inputs (mask); stretch: frames of the stretches that have offsets, None for none."""
        return RidgeRegression.fit(data, used, self.options.ridge_mm2, self._pooling)

    def _stretch(self, length: int, rate: float) -> int | None:
        """Frames of the stretches that have offsets where a gap of a length, frames, is filled; None for none."""
        return None

    def _fit_to(self, scene: Scene, marker: int, assignment: Assignment, length: int) -> _Fit:
        """The regression for gaps of a length, frames, trained once for a scene and all trials on it."""
        data, used, stretch = assignment.data, assignment.used, self._stretch(length, scene.rate)
        key = self, data, used.tobytes(), stretch, "regression"
        regression: Regression = (scene.whole or scene).cached(key, partial(self._fit, data, used, stretch))
        if assignment.hidden is None:
            return _Fit(marker, assignment, regression, regression)
        return _Fit(marker, assignment, regression, scene.cached(key, partial(regression.without, assignment.hidden)))

    def _error_model(self, scene: Scene, fit: _Fit, length: int) -> tuple[Covariance, LeverageScale]:
        """Covariance of the residuals in typical poses, and how they grow with leverage; length: of the gap, frames."""
        data, used, hidden = fit.assignment.data, fit.assignment.used, fit.assignment.hidden
        blocks = int(np.clip(len(scene.positions) // max(length, 1), 2, MAX_BLOCKS))
        key, whole = (self, fit.regression, blocks), scene.whole or scene
        covariance, scale = whole.cached(key, partial(self._covariance, whole, fit, blocks))
        if hidden is None:
            return covariance, scale
        part = with_intercept(data.design(used)[hidden]), data.weights[hidden]
        return covariance, scene.cached(key, partial(scale.without, *part))

    def _observed_nearby(self, scene: Scene, fit: _Fit) -> np.ndarray:
        """Frames (k,) about those of the assignment that show the marker and its inputs, ascending."""
        data, used, rows = fit.assignment.data, fit.assignment.used, fit.assignment.rows
        lags = np.geomspace(1, max(2.0, self.options.border_s * scene.rate), BORDER_LAGS)
        reach = np.unique(np.round(lags).astype(int))
        nearby = np.concatenate([rows[0] - reach[::-1], rows, rows[-1] + reach])
        nearby = nearby[(nearby >= 0) & (nearby < len(scene.positions))]
        needed = [*data.anchors, *data.inputs[used], fit.marker]
        return np.unique(nearby[scene.present[np.ix_(nearby, needed)].all(axis=1)])

    def _leverage_scale(self, fit: _Fit, block: np.ndarray) -> tuple[LeverageScale, np.ndarray]:
        """How errors grow with the leverage of the pose; and left-out residuals (training, 3) divided by that."""
        data = fit.assignment.data
        left = np.where(data.weights[:, None] > TRUSTED_WEIGHT, fit.regression.left_out(block), np.nan)
        scale, factor = fit_leverage_scale(
            data.design(fit.assignment.used),
            data.weights,
            left,
            block,
            ridge=self.options.ridge_mm2,
            max_leverage=self.options.max_leverage,
        )
        return scale, left / factor[:, None]

    def _covariance(self, scene: Scene, fit: _Fit, blocks: int) -> tuple[Covariance, LeverageScale]:
        """Covariance of residuals left out by equal blocks of the recording, divided by the factors of their leverages."""
        span, training = len(scene.positions), fit.assignment.data.training
        scale, left = self._leverage_scale(fit, training * blocks // span)
        residual = np.full((span, 3), np.nan)
        residual[training] = left
        covariance = fit_covariance(
            residual,
            rate=scene.rate,
            scales_s=np.array(self.options.correlation_times_s),
            max_lag_s=self.options.max_lag_s,
        )
        return covariance, scale
