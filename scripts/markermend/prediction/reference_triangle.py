"""Local models of tits2018: a marker in the frame of three references, interpolated or regressed on their triangle.

The frame (eq 4-6) has its origin in the first reference, its first axis through the second and its second normal to
the plane of the three. The triangle has three coordinates of its own (eq 11), the inputs of the regressions.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import combinations

import numpy as np

from markermend.options.prediction import ReferenceTriangleOptions
from markermend.prediction.marker_selection import evenly_spaced, reference_markers
from markermend.prediction.scene import Prediction, Scene


@dataclass(frozen=True)
class _Triangle:
    """Three references in some frames: axes (n, 3, 3) as columns, origin (n, 3), shape (n, 3) as in eq 11."""

    axes: np.ndarray
    origin: np.ndarray
    shape: np.ndarray

    def local(self, points: np.ndarray) -> np.ndarray:
        """Laboratory positions (n, 3) in the frame (eq 8)."""
        return np.einsum("ni,nij->nj", points - self.origin, self.axes)

    def laboratory(self, local: np.ndarray) -> np.ndarray:
        """Local positions (n, 3) in the laboratory (eq 10)."""
        return np.einsum("nj,nij->ni", local, self.axes) + self.origin


def triangle(points: np.ndarray) -> _Triangle:
    """The frame and shape of three points (n, 3, 3); source: tits2018 eq 4-7, 11. NaN where they are on one line."""
    first, side = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    normal = np.cross(first, side)
    with np.errstate(invalid="ignore", divide="ignore"):
        along = first / np.linalg.norm(first, axis=1, keepdims=True)
        normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    axes = np.stack([along, normal, np.cross(along, normal)], axis=2)
    third = np.einsum("ni,nij->nj", side, axes)
    shape = np.stack([np.linalg.norm(first, axis=1), third[:, 0], third[:, 2]], axis=1)
    return _Triangle(axes, points[:, 0], shape)


class _FrameModel(ABC):
    """What the three models share: the search for references, iterated until the gap is recovered."""

    name: str
    continuous: bool

    def __init__(self, options: ReferenceTriangleOptions) -> None:
        """Keep the options."""
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """See Predictor. Frames that miss a reference are left to the next triple; states no error."""
        hidden = scene.without(marker, start, stop)
        positions = np.full((stop - start + 2, 3), np.nan)
        frames = np.arange(max(start - 1, 0), min(stop + 1, len(scene.positions)))
        for triple in self._triples(hidden, marker):
            left = frames[np.isnan(positions[frames - (start - 1), 0])]
            if len(left) == 0:
                break
            seen: np.ndarray = np.all(hidden.present[:, triple], axis=1)
            rows = left[seen[left]]
            if len(rows):
                positions[rows - (start - 1)] = self._recover(hidden, marker, triple, seen, rows, start, stop)
        return Prediction(positions, np.full(len(positions), np.nan))

    def _triples(self, scene: Scene, marker: int) -> Iterator[np.ndarray]:
        """Triples of references: the best three, then those that need the fourth, and so on."""
        options = self.options
        ranked, _ = reference_markers(
            scene, marker, frames=options.max_training_frames, minimum_frames=options.min_training_frames
        )
        for places in sorted(combinations(range(min(len(ranked), options.references)), 3), key=lambda p: p[::-1]):
            yield ranked[list(places)]

    def _training(self, scene: Scene, marker: int, triple: np.ndarray, seen: np.ndarray) -> np.ndarray:
        """Frames to train on; none where the triple is seen too rarely with the marker, or is nearly a line."""
        key = "training", self.options, marker, triple.tobytes()
        return scene.cached(key, partial(self._choose, scene, marker, triple, seen))

    def _choose(self, scene: Scene, marker: int, triple: np.ndarray, seen: np.ndarray) -> np.ndarray:
        """See _training."""
        joint = np.flatnonzero(seen & scene.present[:, marker])
        if len(joint) < self.options.min_training_frames:
            return joint[:0]
        training = evenly_spaced(joint, self.options.max_training_frames)
        height = np.abs(triangle(scene.positions[np.ix_(training, triple)]).shape[:, 2])
        return training if np.median(height) >= self.options.min_height_mm else training[:0]

    @abstractmethod
    def _recover(
        self, scene: Scene, marker: int, triple: np.ndarray, seen: np.ndarray, rows: np.ndarray, start: int, stop: int
    ) -> np.ndarray:
        """Position (n, 3) at rows, where the triple is seen."""


class LocalInterpolation(_FrameModel):
    """Straight line in the frame of three references (tits2018 eq 9); the near border's place at a recording's end."""

    name = "local_interpolation"
    continuous = True

    def _recover(
        self, scene: Scene, marker: int, triple: np.ndarray, seen: np.ndarray, rows: np.ndarray, start: int, stop: int
    ) -> np.ndarray:
        borders = np.array([frame for frame in (start - 1, stop) if 0 <= frame < len(seen)])
        known = borders[seen[borders] & scene.present[borders, marker]]
        if len(known) < len(borders) or len(self._training(scene, marker, triple, seen)) == 0:
            return np.full((len(rows), 3), np.nan)
        local = triangle(scene.positions[np.ix_(known, triple)]).local(scene.positions[known, marker])
        wanted = np.stack([np.interp(rows, known, axis) for axis in local.T], axis=1)
        return triangle(scene.positions[np.ix_(rows, triple)]).laboratory(wanted)


class _FrameRegression(_FrameModel):
    """Regression of the local position on the shape of the triangle."""

    continuous = False

    def __init__(self, options: ReferenceTriangleOptions, model: Callable[..., np.ndarray]) -> None:
        super().__init__(options)
        self._model = model

    def _recover(
        self, scene: Scene, marker: int, triple: np.ndarray, seen: np.ndarray, rows: np.ndarray, start: int, stop: int
    ) -> np.ndarray:
        training = self._training(scene, marker, triple, seen)
        if len(training) == 0:
            return np.full((len(rows), 3), np.nan)
        key = "regression", self.options, marker, triple.tobytes()
        inputs, target, middle, scale = scene.cached(key, partial(_standardized, scene, marker, triple, training))
        asked = triangle(scene.positions[np.ix_(rows, triple)])
        return asked.laboratory(self._model(inputs, target, (asked.shape - middle) / scale))


def _standardized(
    scene: Scene, marker: int, triple: np.ndarray, training: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Standardized shapes of the triple (n, 3), local positions of the marker (n, 3), and the shapes' mean and scale."""
    known = triangle(scene.positions[np.ix_(training, triple)])
    middle, scale = known.shape.mean(axis=0), known.shape.std(axis=0)
    # A rigid triple has no shape to regress on: noise must not be blown up to unit variance.
    scale = np.maximum(scale, 1e-3)
    target = known.local(scene.positions[training, marker])
    good = ~np.isnan(target).any(axis=1)
    return ((known.shape - middle) / scale)[good], target[good], middle, scale


class LocalQuadratic(_FrameRegression):
    """Quadratic regression in the frame of three references (tits2018 eq 12-14)."""

    name = "local_quadratic"

    def __init__(self, options: ReferenceTriangleOptions) -> None:
        """Keep the options."""
        super().__init__(options, lambda *given: quadratic(*given, ridge=options.ridge))


class LocalGRNN(_FrameRegression):
    """Generalised regression neural network in the frame of three references (tits2018 eq 15)."""

    name = "local_grnn"

    def __init__(self, options: ReferenceTriangleOptions) -> None:
        """Keep the options."""
        super().__init__(options, lambda *given: grnn(*given, smoothness=options.kernel_width_sigmas))


def quadratic(inputs: np.ndarray, target: np.ndarray, wanted: np.ndarray, *, ridge: float) -> np.ndarray:
    """Regress target (n, 3) on all monomials up to degree two of inputs (n, k); predict at wanted (m, k).

    ridge: penalty on all but the intercept, as a share of n. Source: tits2018 eq 12-14.
    """
    design, asked = _monomials(inputs), _monomials(wanted)
    penalty = np.sqrt(ridge * len(inputs)) * np.eye(design.shape[1])[1:]
    padded = np.concatenate([target, np.zeros((len(penalty), target.shape[1]))])
    return asked @ np.linalg.lstsq(np.concatenate([design, penalty]), padded, rcond=1e-9)[0]


def _monomials(inputs: np.ndarray) -> np.ndarray:
    """One, the inputs, and all their products in pairs."""
    first, second = np.triu_indices(inputs.shape[1])
    return np.concatenate([np.ones((len(inputs), 1)), inputs, inputs[:, first] * inputs[:, second]], axis=1)


def grnn(inputs: np.ndarray, target: np.ndarray, wanted: np.ndarray, *, smoothness: float) -> np.ndarray:
    """Average target (n, 3), weighted by a Gaussian of width `smoothness` around wanted (m, k); source: tits2018 eq 15."""
    square = (wanted**2).sum(axis=1)[:, None] - 2 * wanted @ inputs.T + (inputs**2).sum(axis=1)
    # The nearest weighs one, so that far from all training the nearest still counts.
    weight = np.exp(-(square - square.min(axis=1, keepdims=True)) / (2 * smoothness**2))
    return weight @ target / weight.sum(axis=1, keepdims=True)
