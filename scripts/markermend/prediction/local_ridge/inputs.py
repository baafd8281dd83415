"""Choice of anchors, inputs and training frames of a local ridge, and the training data that follow."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.numerics.patterns import group_rows
from markermend.numerics.rigid_alignment import align, mean_shape, width
from markermend.numerics.selection import cells
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.prediction.local_ridge.model import TrainingSet
from markermend.prediction.local_ridge.pooled_rows import SHAPE_ROWS, PooledRows, pooled_rows
from markermend.prediction.local_ridge.ridge import robust_weights
from markermend.prediction.marker_selection import evenly_spaced, pseudo_random_subset
from markermend.prediction.scene import Scene

MIN_ANCHORS = 3
"""Markers that define a local frame, at least."""

EXTRA_ANCHORS = 3
"""Anchors that are added, at most, to a frame of too little extent."""

OFTEN = 0.9
"""A neighbour observed in a smaller share of the frames to predict comes after those that are there throughout."""

MIN_JOINT_SHARE = 0.6
"""Share of the anchors' joint frames that the inputs together leave for training, at least."""


@dataclass(frozen=True, eq=False)
class Assignment:
    """Training data, which of their inputs are used, and the frames to predict with them.

    Attributes
    ----------
    data : TrainingSet
        The training data.
    used : np.ndarray
        Which of the inputs are observed in these frames, bool (k,).
    rows : np.ndarray
        The frames (n,), ascending.
    hidden : np.ndarray | None
        Places of the training frames (h,) that the scene hides for trial; None where it hides none.
    """

    data: TrainingSet
    used: np.ndarray
    rows: np.ndarray
    hidden: np.ndarray | None = None


@dataclass(frozen=True, eq=False)
class _Anchors:
    """Markers (a,) that carry a local frame, the frames (mask) that show them and the target, their mean shape (a, 3)."""

    markers: np.ndarray
    observed: np.ndarray
    shape: np.ndarray


@dataclass(frozen=True)
class InputSelection:
    """Chooses the training data that a local ridge needs for some frames; a scene caches them for all of equal options.

    Attributes
    ----------
    options : LocalRidgeOptions
        How many anchors, inputs and frames to use.
    """

    options: LocalRidgeOptions

    def assignments(self, scene: Scene, marker: int, frames: np.ndarray) -> Iterator[Assignment]:
        """Assign training data to the frames in which a marker is to be predicted.

        Parameters
        ----------
        scene : Scene
            What is observed.
        marker : int
            Index of the marker.
        frames : np.ndarray
            Frames (n,) to predict, ascending.

        Yields
        ------
        Assignment
            Each frame that can be predicted is in one of them.
        """
        whole = scene.whole or scene
        candidates = self._candidates(whole, marker, scene.present, frames)
        if len(candidates) < MIN_ANCHORS or len(frames) == 0:
            return
        present = _seen(scene.present, frames, candidates)
        # A frame's anchors are its first observed candidates; frames that share them share training data.
        leading = present & (np.cumsum(present, axis=1) <= self.options.anchors)
        for first, rows in group_rows(leading):
            if first.sum() < MIN_ANCHORS:
                continue
            data = self._training_set(whole, marker, candidates, np.flatnonzero(first), present[rows])
            if data is None:
                continue
            hidden = None if scene.whole is None else self._hidden(scene, marker, data)
            if hidden is not None and not self._enough(whole, len(data.training) - len(hidden), [marker, *data.inputs]):
                continue
            observed = _seen(scene.present, frames[rows], data.inputs)
            for used, members in group_rows(observed):
                yield Assignment(data, used, frames[rows][members], hidden)

    def _candidates(self, whole: Scene, marker: int, present: np.ndarray, frames: np.ndarray) -> np.ndarray:
        """Neighbours to use for these frames: in the mesh's order, but those that are often missing come last.

        present: bool (frames of the recording, markers), in the scene with these frames.
        """
        ranked = whole.cached((self, "seen enough", marker), partial(self._seen_enough, whole, marker))
        if len(ranked) == 0 or len(frames) == 0:
            return ranked
        share = np.count_nonzero(_seen(present, frames, ranked), axis=0) / len(frames)
        ranked = ranked[np.argsort(share < OFTEN, kind="stable")]
        return ranked[: 2 * self.options.inputs]

    def _seen_enough(self, scene: Scene, marker: int) -> np.ndarray:
        """Neighbours that are seen in enough frames, in the mesh's order."""
        ranked = np.asarray(scene.neighbours[marker], int)
        counts = np.count_nonzero(scene.present[:, ranked], axis=0).tolist()
        enough = [self._enough(scene, n, [marker, other]) for n, other in zip(counts, ranked.tolist(), strict=True)]
        seen: np.ndarray = ranked[enough]
        return seen

    def _hidden(self, scene: Scene, marker: int, data: TrainingSet) -> np.ndarray:
        """Places of the training frames in which a scene shows not all that is learned from."""
        needed = [*data.anchors, *data.inputs, marker]
        return np.flatnonzero(~scene.present[np.ix_(data.training, needed)].all(axis=1))

    def _training_set(
        self, scene: Scene, marker: int, candidates: np.ndarray, first: np.ndarray, present: np.ndarray
    ) -> TrainingSet | None:
        """Training data in the frame of the first anchors and, if these have too little extent, of further ones.

        first: places of the anchors in candidates. present: (frames to predict, candidates). None for too few frames.
        """
        chosen = list(first)
        anchors = self._anchors(scene, marker, candidates[chosen])
        if anchors is None:
            return None
        for extra in np.flatnonzero(present.all(axis=0)):
            wide = width(anchors.shape) >= self.options.min_anchor_extent_mm
            if wide or len(chosen) >= self.options.anchors + EXTRA_ANCHORS:
                break
            if extra not in chosen:
                wider = self._anchors(scene, marker, candidates[[*chosen, extra]])
                if wider is not None:
                    chosen, anchors = [*chosen, extra], wider
        others = [c for c in np.flatnonzero(present.any(axis=0)) if c not in chosen]
        inputs = self._inputs(scene, marker, anchors, candidates[others])
        key = self, marker, anchors.markers.tobytes(), inputs.tobytes()
        return scene.cached(key, partial(self._transform, scene, marker, anchors, inputs))

    def _anchors(self, scene: Scene, marker: int, markers: np.ndarray) -> _Anchors | None:
        """Anchors with their mean shape; None where too few frames show them and the marker."""

        def compute() -> _Anchors | None:
            observed = scene.present[:, marker] & scene.present[:, markers].all(axis=1)
            joint = np.flatnonzero(observed)
            if not self._enough(scene, len(joint), [marker, *markers.tolist()]):
                return None
            sample = evenly_spaced(joint, SHAPE_ROWS)
            return _Anchors(markers, observed, mean_shape(cells(scene.positions, sample, markers)))

        return scene.cached((self, "anchors", marker, markers.tobytes()), compute)

    def _inputs(self, scene: Scene, marker: int, anchors: _Anchors, others: np.ndarray) -> np.ndarray:
        """The anchors, and of the other candidates the first that leave enough joint training frames."""
        inputs, observed = anchors.markers.tolist(), anchors.observed
        required = int(MIN_JOINT_SHARE * np.count_nonzero(observed))
        for candidate in others.tolist():
            if len(inputs) >= self.options.inputs:
                break
            joint = observed & scene.present[:, candidate]
            count = int(np.count_nonzero(joint))
            if count >= required and self._enough(scene, count, [marker, *inputs, candidate]):
                inputs.append(candidate)
                observed = joint
        return np.array(inputs)

    def _enough(self, scene: Scene, count: int, markers: list[int]) -> bool:
        """Whether so many frames that show markers are enough: fewer are where other recordings show these, too."""
        options = self.options
        if count >= options.min_training_frames:
            return True
        if scene.pool is None or count < options.min_own_frames:
            return False
        return len(scene.pool.rows_with(markers, fewest=options.min_pooled_rows)) >= options.min_training_frames

    def _transform(self, scene: Scene, marker: int, anchors: _Anchors, inputs: np.ndarray) -> TrainingSet:
        """Local coordinates at the training frames, about their medians, with robust weights."""
        options = self.options
        joint = np.flatnonzero(anchors.observed & scene.present[:, inputs].all(axis=1))
        # Kriging needs pairs of frames at every lag: evenly spaced frames have only multiples of one.
        training = pseudo_random_subset(joint, options.max_training_frames)
        pooled = self._pooled(scene, marker, anchors.markers, inputs)
        shape = anchors.shape if pooled is None else pooled.turned(anchors.shape)
        frames = align(cells(scene.positions, training, anchors.markers), shape)
        points = cells(scene.positions, training, np.append(inputs, marker))
        local = frames.local(points).reshape(len(training), -1)
        centre = np.median(evenly_spaced(local, SHAPE_ROWS), axis=0)
        local -= centre
        weights = robust_weights(local, ridge=options.ridge_mm2, sigmas=options.outlier_sigmas)
        return TrainingSet(anchors.markers, inputs, shape, centre, local, weights, training, pooled)

    def _pooled(self, scene: Scene, marker: int, anchors: np.ndarray, inputs: np.ndarray) -> PooledRows | None:
        """Training rows from the subject's other recordings; the pool caches them for all scenes of the recording."""
        pool, options = scene.pool, self.options
        if pool is None:
            return None
        limits = options.min_pooled_rows, options.max_training_frames
        ridge, sigmas = options.ridge_mm2, options.outlier_sigmas
        markers = np.append(inputs, marker)
        rows = partial(pooled_rows, pool, anchors, markers, row_limits=limits, ridge=ridge, sigmas=sigmas)
        return pool.cached(("local rows", anchors.tobytes(), markers.tobytes(), limits, ridge, sigmas), rows)


def _seen(present: np.ndarray, frames: np.ndarray, markers: np.ndarray) -> np.ndarray:
    """Whether markers are seen in frames, bool (frames, markers): columns first, since frames of a marker lie together."""
    columns = present.T[markers]
    seen: np.ndarray = columns.T if len(frames) == len(present) else columns[:, frames].T
    return seen
