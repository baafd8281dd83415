"""Local ridge: a marker predicted in the frame of its steadiest neighbours, and the residual carried on by kriging.

The frame is the pose of the steadiest present neighbours (the anchors); the inputs are the local coordinates of up to a
dozen present neighbours; the model is a ridge regression with an intercept. It never looks at the marker's own course,
so it follows the body and not an artifact: the detectors work on its residual.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from markermend.numerics.kriging import Covariance, fit_covariance, krige
from markermend.options.prediction import LocalRidgeOptions
from markermend.prediction.local_ridge.inputs import RidgeChoice
from markermend.prediction.local_ridge.leverage import Novelty, learn_novelty
from markermend.prediction.local_ridge.model import RidgeModel, inputs_at, response
from markermend.prediction.scene import Prediction, Scene


class LocalRidge:
    """The local ridge as a predictor; `residuals` is what the detectors use."""

    name = "local_ridge"
    continuous = True

    def __init__(self, options: LocalRidgeOptions) -> None:
        """Keep the options; nothing is trained before a marker is asked for."""
        self.options = options
        self._choice = RidgeChoice(options)

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. The error is the kriging standard deviation, from residuals that were left out in training."""
        hidden = scene.without(marker, start, stop)
        frames = np.arange(max(start - 1, 0), min(stop + 1, len(scene.positions)))
        positions = np.full((stop - start + 2, 3), np.nan)
        error = np.full(stop - start + 2, np.nan)
        first = start - 1
        for model, used, rows in self._choice.models(hidden, marker, frames):
            learned = hidden.cached((model, used.tobytes()), partial(self._learn, model, used))
            inputs, rotation, origin = inputs_at(model, hidden.positions, used, rows)
            mean, spread, novelty = self._krige(hidden, marker, model, used, learned, rows, stop - start)
            local = self._respond(model, learned, inputs) + mean
            positions[rows - first] = np.einsum("nj,nij->ni", local, rotation) + origin
            error[rows - first] = spread * novelty.factor(inputs)
        return Prediction(positions, error)

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Observed minus predicted, (frames, markers, 3), mm, laboratory axes; NaN where either is missing.

        markers: indices to work on; the others stay NaN. Each marker is predicted from the others alone, by a model
        trained on all frames with robust weights.
        """
        out = np.full(scene.positions.shape, np.nan)
        for marker, _, _, _, rows, residual, _ in self._judged(scene, markers):
            out[rows, marker] = residual
        return out

    def scaled_residuals(
        self, scene: Scene, markers: np.ndarray | None = None, *, blocks: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """As `residuals`; and by how much the novelty of the pose widens each, (frames, markers), NaN likewise.

        blocks: so many equal parts of the recording are left out in turn to learn that.
        """
        out, wider = np.full(scene.positions.shape, np.nan), np.full(scene.positions.shape[:2], np.nan)
        for marker, model, used, learned, rows, residual, inputs in self._judged(scene, markers):
            out[rows, marker] = residual
            block = model.training * blocks // len(scene.positions)
            novelty, _ = self._learn_novelty(model, used, learned, block)
            wider[rows, marker] = novelty.factor(inputs)
        return out, wider

    def _judged(
        self, scene: Scene, markers: np.ndarray | None
    ) -> Iterator[tuple[int, RidgeModel, np.ndarray, Any, np.ndarray, np.ndarray, np.ndarray]]:
        """Yield marker, model, inputs used, what was learned, frames, residual (n, 3), laboratory axes, inputs (n, u)."""
        for marker in range(scene.positions.shape[1]) if markers is None else markers:
            frames = np.flatnonzero(scene.present[:, marker])
            for model, used, rows in self._choice.models(scene, marker, frames):
                learned = self._learn(model, used)
                inputs, rotation, origin = inputs_at(model, scene.positions, used, rows)
                predicted = np.einsum("nj,nij->ni", self._respond(model, learned, inputs), rotation) + origin
                yield marker, model, used, learned, rows, scene.positions[rows, marker] - predicted, inputs

    def _learn(self, model: RidgeModel, used: np.ndarray) -> Any:
        """What _respond needs to predict from the inputs marked in `used`: here the coefficients."""
        return model.coefficients(used, self.options.ridge_mm2)

    def _respond(self, model: RidgeModel, learned: Any, inputs: np.ndarray) -> np.ndarray:
        """Local prediction (n, 3) from local inputs (n, u)."""
        return response(model, learned, inputs)

    def _left_out(self, model: RidgeModel, used: np.ndarray, learned: Any, block: np.ndarray) -> np.ndarray:
        """Residual (training, 3) of each training frame, predicted without its block (training,)."""
        return model.left_out(used, self.options.ridge_mm2, block)

    def _krige(
        self,
        scene: Scene,
        marker: int,
        model: RidgeModel,
        used: np.ndarray,
        learned: Any,
        rows: np.ndarray,
        length: int,
    ) -> tuple[np.ndarray, np.ndarray, Novelty]:
        """Residual to expect at `rows` in local coordinates (n, 3), its standard deviation (n,) in a usual pose, mm,
        and how that grows with the novelty of the pose.
        """
        options = self.options
        span = len(scene.positions)
        blocks = int(np.clip(span // max(length, 1), 2, 12))
        covariance, novelty = scene.cached(
            (model, used.tobytes(), blocks), partial(self._covariance, scene, model, used, learned, blocks)
        )
        reach = np.unique(np.round(np.geomspace(1, max(2.0, options.border_s * scene.rate), 12)).astype(int))
        nearby = np.concatenate([rows[0] - reach[::-1], rows, rows[-1] + reach])
        nearby = nearby[(nearby >= 0) & (nearby < len(scene.positions))]
        needed = [*model.anchors, *model.inputs[used], marker]
        nearby = np.unique(nearby[scene.present[np.ix_(nearby, needed)].all(axis=1)])
        values = np.zeros((0, 3))
        if len(nearby):
            inputs, rotation, origin = inputs_at(model, scene.positions, used, nearby)
            observed = np.einsum("ni,nij->nj", scene.positions[nearby, marker] - origin, rotation)
            values = observed - self._respond(model, learned, inputs)
        mean, variance = krige(covariance, observed_s=nearby / scene.rate, values=values, target_s=rows / scene.rate)
        return mean, np.sqrt(variance), novelty

    def _learn_novelty(
        self, model: RidgeModel, used: np.ndarray, learned: Any, block: np.ndarray
    ) -> tuple[Novelty, np.ndarray]:
        """How errors grow with the novelty of the pose; and left-out residuals (training, 3) divided by that."""
        left = np.where(model.weights[:, None] > 0.5, self._left_out(model, used, learned, block), np.nan)
        novelty, factor = learn_novelty(
            model.local[:, np.flatnonzero(np.repeat(used, 3))],
            model.weights,
            left,
            block,
            ridge=self.options.ridge_mm2,
            most=self.options.max_leverage,
        )
        return novelty, left / factor[:, None]

    def _covariance(
        self, scene: Scene, model: RidgeModel, used: np.ndarray, learned: Any, blocks: int
    ) -> tuple[Covariance, Novelty]:
        """Covariance of residuals over equal blocks of the recording, each left out of its own training, and their growth.

        A pose unlike all others is predicted worse: the covariance is that of residuals divided by the factor of their
        novelty.
        """
        span = len(scene.positions)
        novelty, left = self._learn_novelty(model, used, learned, model.training * blocks // span)
        residual = np.full((span, 3), np.nan)
        residual[model.training] = left
        covariance = fit_covariance(
            residual,
            rate=scene.rate,
            scales_s=np.array(self.options.correlation_times_s),
            max_lag_s=self.options.max_lag_s,
        )
        return covariance, novelty
