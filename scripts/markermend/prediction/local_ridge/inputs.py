"""Which neighbours make the frame of a local ridge, which are its inputs, and which frames train it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from markermend.numerics.patterns import group_rows
from markermend.numerics.rigid_alignment import align, mean_shape, width
from markermend.options.prediction import LocalRidgeOptions
from markermend.prediction.local_ridge.model import RidgeModel, robust_weights
from markermend.prediction.marker_selection import pseudo_random_subset
from markermend.prediction.scene import Scene

SHAPE_FRAMES = 200
"""From so many frames the mean shape of the anchors is found: more tell the same."""


class RidgeChoice:
    """Makes the models that a local ridge needs for some frames; a scene remembers them."""

    def __init__(self, options: LocalRidgeOptions) -> None:
        self.options = options

    def models(
        self, scene: Scene, marker: int, frames: np.ndarray
    ) -> Iterator[tuple[RidgeModel, np.ndarray, np.ndarray]]:
        """Yield (model, inputs used, frames) such that each frame that can be predicted appears once."""
        candidates = self._candidates(scene, marker, frames)
        if len(candidates) < 3 or len(frames) == 0:
            return
        present = scene.present[np.ix_(frames, candidates)]
        # A frame's anchors are its first present candidates; frames that share them share a model.
        leading = present & (np.cumsum(present, axis=1) <= self.options.anchors)
        for anchors, rows in group_rows(leading):
            if anchors.sum() < 3:
                continue
            often, ever = present[rows].all(axis=0), present[rows].any(axis=0)
            model = self._fit(scene, marker, candidates, np.flatnonzero(anchors), often, ever)
            if model is None:
                continue
            seen = scene.present[np.ix_(frames[rows], model.inputs)]
            for used, members in group_rows(seen):
                yield model, used, frames[rows][members]

    def _candidates(self, scene: Scene, marker: int, frames: np.ndarray) -> np.ndarray:
        """Neighbours to use for these frames: steadiest first, but those that are there throughout come before."""
        ranked = np.asarray(scene.neighbours[marker], int)
        ranked = ranked[scene.present[:, ranked].sum(axis=0) >= self.options.min_training_frames]
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
            if width(shape) >= self.options.min_anchor_extent_mm or len(chosen) >= self.options.anchors + 3:
                break
            if extra not in chosen:
                wider, grown = self._shape(scene, marker, candidates[[*chosen, extra]])
                if grown is not None:
                    chosen, together, shape = [*chosen, extra], wider, grown
        inputs = self._inputs(scene, together, candidates, chosen, ever)
        key = self, marker, candidates[chosen].tobytes(), inputs.tobytes()
        return scene.cached(key, partial(self._train, scene, marker, candidates[chosen], inputs, together, shape))

    def _shape(self, scene: Scene, marker: int, anchors: np.ndarray) -> tuple[np.ndarray, np.ndarray | None]:
        """Frames that show the marker and the anchors, and the anchors' mean shape there; None for too few frames."""

        def learn() -> tuple[np.ndarray, np.ndarray | None]:
            together = scene.present[:, marker] & scene.present[:, anchors].all(axis=1)
            return together, _shape(scene, together, anchors, self.options.min_training_frames)

        return scene.cached((self, "shape", marker, anchors.tobytes()), learn)

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
        training = pseudo_random_subset(joint, options.max_training_frames)
        rotation, origin = align(scene.positions[np.ix_(training, anchors)], shape)
        points = scene.positions[np.ix_(training, np.append(inputs, marker))] - origin[:, None]
        local = np.einsum("nki,nij->nkj", points, rotation).reshape(len(training), -1)
        centre = np.median(local, axis=0)
        local = local - centre
        weights = robust_weights(local, ridge=options.ridge_mm2, sigmas=options.outlier_sigmas)
        return RidgeModel(anchors, inputs, shape, centre, local, weights, training)

    def _inputs(
        self, scene: Scene, together: np.ndarray, candidates: np.ndarray, anchors: list[int], ever: np.ndarray
    ) -> np.ndarray:
        """The anchors and the next candidates that are ever seen in the frames to predict and leave enough joint training frames."""
        inputs = list(candidates[anchors])
        enough = max(self.options.min_training_frames, int(0.6 * together.sum()))
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


def _shape(scene: Scene, together: np.ndarray, markers: np.ndarray, minimum: int) -> np.ndarray | None:
    """Mean shape of markers over at most SHAPE_FRAMES of the frames that they share; None where those are too few."""
    joint = np.flatnonzero(together)
    if len(joint) < minimum:
        return None
    sample = joint[np.unique(np.linspace(0, len(joint) - 1, SHAPE_FRAMES).astype(int))]
    return mean_shape(scene.positions[np.ix_(sample, markers)])
