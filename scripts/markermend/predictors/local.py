"""Local ridge: a marker predicted in the frame of its steadiest neighbours, and the residual carried on by kriging.

The frame is the pose of the steadiest present neighbours (the anchors); the inputs are the local coordinates of up to a
dozen present neighbours; the model is a ridge regression with an intercept. It never looks at the marker's own course,
so it follows the body and not an artifact: the detectors work on its residual.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from markermend.predictors import Prediction, Scene
from markermend.predictors.frames import align, mean_shape, width
from markermend.predictors.kriging import Covariance, fit_covariance, krige
from markermend.predictors.novelty import Novelty, learn_novelty
from markermend.predictors.references import scattered
from markermend.predictors.ridge_model import RidgeModel, evaluate, inputs_at, robust_weights


@dataclass(frozen=True)
class RidgeOptions:
    """Settings of the local ridge (config section `local_ridge`).

    anchors: markers in the frame. inputs: neighbours regressed on. width_mm: anchors thinner than this get company.
    ridge_mm2: penalty, the variance of the noise on an input. frames: training frames at most. minimum_frames:
    fewer joint frames than this and no model is made. robust_sigmas: training residuals beyond this many robust sigmas
    lose weight. scales_s, longest_s, border_s: correlation lengths, longest lag, and reach of kriging, s. novelty:
    see Novelty.most.
    """

    anchors: int
    inputs: int
    width_mm: float
    ridge_mm2: float
    frames: int
    minimum_frames: int
    robust_sigmas: float
    scales_s: tuple[float, ...]
    longest_s: float
    border_s: float
    novelty: float


class LocalRidge:
    """The local ridge as a predictor; `residuals` is what the detectors use."""

    name = "local_ridge"
    continuous = True

    def __init__(self, options: RidgeOptions) -> None:
        """Keep the settings; nothing is trained before a marker is asked for."""
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. The error is the kriging standard deviation, from residuals that were left out in training."""
        hidden = scene if not scene.present[start:stop, marker].any() else scene.hiding(marker, start, stop)
        frames = np.arange(max(start - 1, 0), min(stop + 1, len(scene.positions)))
        positions = np.full((stop - start + 2, 3), np.nan)
        error = np.full(stop - start + 2, np.nan)
        first = start - 1
        for model, used, rows in self._models(hidden, marker, frames):
            learned = hidden.remember((model, used.tobytes()), partial(self._learn, model, used))
            mean, spread = self._krige(hidden, marker, model, used, learned, rows, stop - start)
            local, rotation, origin = self._evaluate(model, hidden.positions, used, learned, rows)
            positions[rows - first] = np.einsum("nj,nij->ni", local + mean, rotation) + origin
            error[rows - first] = spread
        return Prediction(positions, error)

    def residuals(self, scene: Scene, markers: np.ndarray | None = None) -> np.ndarray:
        """Observed minus predicted, (frames, markers, 3), mm, laboratory axes; NaN where either is missing.

        markers: indices to work on; the others stay NaN. Each marker is predicted from the others alone, by a model
        trained on all frames with robust weights.
        """
        out = np.full(scene.positions.shape, np.nan)
        for marker, _, _, _, rows, residual in self._judged(scene, markers):
            out[rows, marker] = residual
        return out

    def scaled_residuals(
        self, scene: Scene, markers: np.ndarray | None = None, *, blocks: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """As `residuals`; and by how much the novelty of the pose widens each, (frames, markers), NaN likewise.

        blocks: so many equal parts of the recording are left out in turn to learn that.
        """
        out, wider = np.full(scene.positions.shape, np.nan), np.full(scene.positions.shape[:2], np.nan)
        for marker, model, used, learned, rows, residual in self._judged(scene, markers):
            out[rows, marker] = residual
            block = model.training * blocks // len(scene.positions)
            novelty, _ = self._learn_novelty(model, used, learned, block)
            wider[rows, marker] = self._novel(novelty, model, scene, used, rows)
        return out, wider

    def _judged(
        self, scene: Scene, markers: np.ndarray | None
    ) -> Iterator[tuple[int, RidgeModel, np.ndarray, Any, np.ndarray, np.ndarray]]:
        """Yield marker, model, inputs used, what was learned, frames and the residual (n, 3) there, laboratory axes."""
        for marker in range(scene.positions.shape[1]) if markers is None else markers:
            frames = np.flatnonzero(scene.present[:, marker])
            for model, used, rows in self._models(scene, marker, frames):
                learned = self._learn(model, used)
                local, rotation, origin = self._evaluate(model, scene.positions, used, learned, rows)
                predicted = np.einsum("nj,nij->ni", local, rotation) + origin
                yield marker, model, used, learned, rows, scene.positions[rows, marker] - predicted

    def _learn(self, model: RidgeModel, used: np.ndarray) -> Any:
        """What _evaluate needs to predict from the inputs marked in `used`: here the coefficients."""
        return model.coefficients(used, self.options.ridge_mm2)

    def _evaluate(
        self, model: RidgeModel, positions: np.ndarray, used: np.ndarray, learned: Any, rows: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Local prediction (n, 3) at rows, with the rotation and origin that take it to the laboratory."""
        return evaluate(model, positions, used, learned, rows)

    def _left_out(self, model: RidgeModel, used: np.ndarray, learned: Any, block: np.ndarray) -> np.ndarray:
        """Residual (training, 3) of each training frame, predicted without its block (training,)."""
        return model.left_out(used, self.options.ridge_mm2, block)

    def _models(
        self, scene: Scene, marker: int, frames: np.ndarray
    ) -> Iterator[tuple[RidgeModel, np.ndarray, np.ndarray]]:
        """Yield (model, inputs used, frames) such that each frame that can be predicted appears once."""
        candidates = self._candidates(scene, marker, frames)
        if len(candidates) < 3 or len(frames) == 0:
            return
        present = scene.present[np.ix_(frames, candidates)]
        # A frame's anchors are its first present candidates; frames that share them share a model.
        leading = present & (np.cumsum(present, axis=1) <= self.options.anchors)
        for anchors, rows in _groups(leading):
            if anchors.sum() < 3:
                continue
            often, ever = present[rows].all(axis=0), present[rows].any(axis=0)
            model = self._fit(scene, marker, candidates, np.flatnonzero(anchors), often, ever)
            if model is None:
                continue
            seen = scene.present[np.ix_(frames[rows], model.inputs)]
            for used, members in _groups(seen):
                yield model, used, frames[rows][members]

    def _candidates(self, scene: Scene, marker: int, frames: np.ndarray) -> np.ndarray:
        """Neighbours to use for these frames: steadiest first, but those that are there throughout come before."""
        ranked = np.asarray(scene.neighbours[marker], int)
        ranked = ranked[scene.present[:, ranked].sum(axis=0) >= self.options.minimum_frames]
        if len(ranked) == 0 or len(frames) == 0:
            return ranked
        share = scene.present[np.ix_(frames, ranked)].mean(axis=0)
        return ranked[np.argsort(share < 0.9, kind="stable")][: 2 * self.options.inputs]

    def _fit(
        self,
        scene: Scene,
        marker: int,
        candidates: np.ndarray,
        anchors: np.ndarray,
        throughout: np.ndarray,
        ever: np.ndarray,
    ) -> RidgeModel | None:
        """Train in the frame of `anchors` (positions in candidates); None where they share too few frames.

        throughout, ever: (candidates,), which are seen in all and in any of the frames to predict.
        """
        chosen = list(anchors)
        together, shape = self._shape(scene, marker, candidates[chosen])
        if shape is None:
            return None
        for extra in np.flatnonzero(throughout):
            if width(shape) >= self.options.width_mm or len(chosen) >= self.options.anchors + 3:
                break
            if extra not in chosen:
                wider, grown = self._shape(scene, marker, candidates[[*chosen, extra]])
                if grown is not None:
                    chosen, together, shape = [*chosen, extra], wider, grown
        inputs = self._inputs(scene, together, candidates, chosen, ever)
        key = self, marker, candidates[chosen].tobytes(), inputs.tobytes()
        return scene.remember(key, partial(self._train, scene, marker, candidates[chosen], inputs, together, shape))

    def _shape(self, scene: Scene, marker: int, anchors: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
        """Frames that show the marker and the anchors, and the anchors' mean shape there; None for too few frames."""

        def learn() -> tuple[np.ndarray, np.ndarray | None]:
            together = scene.present[:, marker] & scene.present[:, anchors].all(axis=1)
            return together, _shape(scene, together, anchors, self.options.minimum_frames)

        return scene.remember((self, "shape", marker, anchors.tobytes()), learn)

    def _train(
        self,
        scene: Scene,
        marker: int,
        anchors: np.ndarray,
        inputs: np.ndarray,
        together: np.ndarray,
        shape: np.ndarray,
    ) -> RidgeModel:
        """The training data of a model, from at most `frames` of the frames that show all that it needs."""
        options = self.options
        joint = np.flatnonzero(together & scene.present[:, inputs].all(axis=1))
        # Kriging needs to know how residuals go together at every lag: evenly spaced frames would tell of a few alone.
        training = scattered(joint, options.frames)
        rotation, origin = align(scene.positions[np.ix_(training, anchors)], shape)
        points = scene.positions[np.ix_(training, np.append(inputs, marker))] - origin[:, None]
        local = np.einsum("nki,nij->nkj", points, rotation).reshape(len(training), -1)
        centre = np.median(local, axis=0)
        local = local - centre
        weights = robust_weights(local, ridge=options.ridge_mm2, sigmas=options.robust_sigmas)
        return RidgeModel(anchors, inputs, shape, centre, local, weights, training)

    def _inputs(
        self, scene: Scene, together: np.ndarray, candidates: np.ndarray, anchors: list[int], ever: np.ndarray
    ) -> np.ndarray:
        """The anchors and the next candidates that are ever seen in the frames to predict and leave enough joint training frames."""
        inputs = list(candidates[anchors])
        enough = max(self.options.minimum_frames, int(0.6 * together.sum()))
        for c, candidate in enumerate(candidates):
            if len(inputs) >= self.options.inputs:
                break
            if c in anchors or not ever[c]:
                continue
            joint = together & scene.present[:, candidate]
            if joint.sum() >= enough:
                inputs.append(candidate)
                together = joint
        return np.array(inputs)

    def _krige(
        self,
        scene: Scene,
        marker: int,
        model: RidgeModel,
        used: np.ndarray,
        learned: Any,
        rows: np.ndarray,
        length: int,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Residual to expect at `rows` in local coordinates (n, 3) and its standard deviation (n,), mm."""
        options = self.options
        span = len(scene.positions)
        blocks = int(np.clip(span // max(length, 1), 2, 12))
        covariance, novelty = scene.remember(
            (model, used.tobytes(), blocks), partial(self._covariance, scene, model, used, learned, blocks)
        )
        reach = np.unique(np.round(np.geomspace(1, max(2.0, options.border_s * scene.rate), 12)).astype(int))
        nearby = np.concatenate([rows[0] - reach[::-1], rows, rows[-1] + reach])
        nearby = nearby[(nearby >= 0) & (nearby < len(scene.positions))]
        needed = [*model.anchors, *model.inputs[used], marker]
        nearby = np.unique(nearby[scene.present[np.ix_(nearby, needed)].all(axis=1)])
        values = np.zeros((0, 3))
        if len(nearby):
            predicted, rotation, origin = self._evaluate(model, scene.positions, used, learned, nearby)
            observed = np.einsum("ni,nij->nj", scene.positions[nearby, marker] - origin, rotation)
            values = observed - predicted
        mean, variance = krige(covariance, known_s=nearby / scene.rate, values=values, wanted_s=rows / scene.rate)
        factor = self._novel(novelty, model, scene, used, rows)
        return mean, np.sqrt(variance) * factor

    def _novel(
        self, novelty: Novelty, model: RidgeModel, scene: Scene, used: np.ndarray, rows: np.ndarray
    ) -> np.ndarray:
        """The factor (n,) by which the novelty of the pose widens the error at rows."""
        return novelty.factor(inputs_at(model, scene.positions, used, rows)[0])

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
            most=self.options.novelty,
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
            scales_s=np.array(self.options.scales_s),
            longest_s=self.options.longest_s,
        )
        return covariance, novelty


def _groups(rows: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield each distinct row of a bool matrix with the indices of the rows that equal it."""
    if len(rows) and (rows == rows[:1]).all():
        yield rows[0], np.arange(len(rows))
        return
    distinct, inverse = np.unique(rows, axis=0, return_inverse=True)
    inverse = inverse.reshape(-1)
    order = np.argsort(inverse, kind="stable")
    yield from zip(distinct, np.split(order, np.cumsum(np.bincount(inverse))[:-1]), strict=True)


def _shape(scene: Scene, together: np.ndarray, markers: np.ndarray, minimum: int) -> np.ndarray | None:
    """Mean shape of markers over at most 500 of the frames that they share; None where those are too few."""
    joint = np.flatnonzero(together)
    if len(joint) < minimum:
        return None
    sample = joint[np.unique(np.linspace(0, len(joint) - 1, 500).astype(int))]
    return mean_shape(scene.positions[np.ix_(sample, markers)])
