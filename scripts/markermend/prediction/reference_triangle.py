"""Local models of tits2018: a marker in the frame of three reference markers, interpolated or regressed on their shape.

The frame (eq 4-6) has its origin in the first reference, its first axis through the second and its second normal to
the plane of the three. The triangle has three coordinates of its own (eq 11), the inputs of the regressions.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from markermend.numerics.intervals import samples
from markermend.numerics.rigid_alignment import LocalFrames
from markermend.numerics.symmetric_smoothing import smooth_symmetrically
from markermend.options.prediction.reference_triangle import ReferenceTriangleOptions
from markermend.prediction.interface import Prediction
from markermend.prediction.marker_selection import evenly_spaced, reference_markers
from markermend.prediction.scene import Scene

MIN_SHAPE_STD_MM = 1e-3
"""A rigid triangle has no shape to regress on: its noise must not be blown up to unit variance."""


@dataclass(frozen=True, eq=False)
class Triangle:
    """Three references in n frames.

    Attributes
    ----------
    frames : LocalFrames
        The frames of reference that the triangle defines (tits2018 eq 4-7).
    shape : np.ndarray
        Shape of the triangle (n, 3), mm: length of the first side, and place of the third point (tits2018 eq 11).
    """

    frames: LocalFrames
    shape: np.ndarray


def triangle(points: np.ndarray) -> Triangle:
    """Compute the frame and the shape of three points.

    Parameters
    ----------
    points : np.ndarray
        Points (n, 3, 3), mm: frames, points, coordinates.

    Returns
    -------
    Triangle
        Frame and shape; NaN where the points lie on one line.

    References
    ----------
    tits2018 eq 4-7, 11.
    """
    first, side = points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]
    normal = np.cross(first, side)
    with np.errstate(invalid="ignore", divide="ignore"):
        along = first / np.linalg.norm(first, axis=1, keepdims=True)
        normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    axes = np.stack([along, normal, np.cross(along, normal)], axis=2)
    third = np.einsum("ni,nij->nj", side, axes)
    shape = np.stack([np.linalg.norm(first, axis=1), third[:, 0], third[:, 2]], axis=1)
    return Triangle(LocalFrames(axes, points[:, 0]), shape)


@dataclass(frozen=True, eq=False)
class _Case:
    """A marker with a gap [start, stop), and three references (3,) observed together in some frames (mask)."""

    scene: Scene
    marker: int
    references: np.ndarray
    observed: np.ndarray
    start: int
    stop: int

    def triangle_at(self, frames: np.ndarray) -> Triangle:
        """The triangle of the references at frames that show them."""
        return triangle(self.scene.positions[np.ix_(frames, self.references)])

    def smoothed_triangle_at(self, frames: np.ndarray, window_s: float) -> Triangle:
        """The same, of references that were smoothed over a window."""
        window = samples(window_s, self.scene.rate, odd=True)
        if window < 3:
            return self.triangle_at(frames)
        return triangle(
            np.stack([self._smoothed(marker, window)[frames] for marker in self.references.tolist()], axis=1)
        )

    def _smoothed(self, marker: int, window: int) -> np.ndarray:
        """Positions (frames, 3) of a marker, smoothed."""
        smooth = partial(smooth_symmetrically, self.scene.positions[:, marker], window)
        smoothed: np.ndarray = self.scene.cached(("smoothed", marker, window), smooth)
        return smoothed

    def known_borders(self) -> np.ndarray:
        """The frames before and after the gap, as far as they lie in the recording; none where one misses a reference or the marker."""
        borders = np.array([frame for frame in (self.start - 1, self.stop) if 0 <= frame < len(self.observed)], int)
        known: np.ndarray = borders[self.observed[borders] & self.scene.present[borders, self.marker]]
        return known if len(known) == len(borders) else known[:0]


_Recovery = Callable[[_Case, np.ndarray], np.ndarray]
"""Positions (n, 3) of the marker of a case at rows (n,)."""


@dataclass(frozen=True, eq=False)
class _TrainingSet:
    """Standardised shapes (n, 3) with their means and deviations (3,), and local positions of the marker (n, 3), mm."""

    inputs: np.ndarray
    target: np.ndarray
    mean: np.ndarray
    deviation: np.ndarray


class _TriangleModel(ABC):
    """What the three models share: the search for references, iterated until the gap is recovered."""

    name: str
    continuous: bool

    def __init__(self, options: ReferenceTriangleOptions) -> None:
        self.options = options

    def predict(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker; frames that miss a reference are left to the next triple. See `Predictor.predict`."""
        return self._search(scene, marker, start, stop, self._recover)

    def _search(self, scene: Scene, marker: int, start: int, stop: int, recover: _Recovery) -> Prediction:
        """Predict with one triple of references after the other."""
        hidden = scene.without(marker, start, stop)
        prediction, first = Prediction.empty(start, stop), start - 1
        frames = hidden.bordered(start, stop)
        for references in self._triples(hidden, marker):
            left = frames[np.isnan(prediction.positions[frames - first, 0])]
            if len(left) == 0:
                break
            observed: np.ndarray = np.all(hidden.present[:, references], axis=1)
            rows = left[observed[left]]
            if len(rows):
                case = _Case(hidden, marker, references, observed, start, stop)
                prediction.positions[rows - first] = recover(case, rows)
        return prediction

    def _triples(self, scene: Scene, marker: int) -> Iterator[np.ndarray]:
        """Triples of references: the best three, then those that need the fourth, and so on."""
        options = self.options
        ranked, _ = reference_markers(
            scene, marker, max_frames=options.max_training_frames, min_frames=options.min_training_frames
        )
        for third in range(min(len(ranked), options.references)):
            for second in range(third):
                for first in range(second):
                    yield ranked[[first, second, third]]

    def _training(self, case: _Case) -> np.ndarray:
        """Frames to train on; none where the triple is observed too rarely with the marker, or is nearly a line."""
        key = "training", self.options, case.marker, case.references.tobytes()
        return case.scene.cached(key, partial(self._choose_training, case))

    def _choose_training(self, case: _Case) -> np.ndarray:
        """See _training."""
        joint = np.flatnonzero(case.observed & case.scene.present[:, case.marker])
        if len(joint) < self.options.min_training_frames:
            return joint[:0]
        training = evenly_spaced(joint, self.options.max_training_frames)
        height = np.abs(case.triangle_at(training).shape[:, 2])
        return training if np.median(height) >= self.options.min_height_mm else training[:0]

    @abstractmethod
    def _recover(self, case: _Case, rows: np.ndarray) -> np.ndarray:
        """Position (n, 3) at rows, where the references are observed; NaN where the model cannot be trained."""


class LocalInterpolation(_TriangleModel):
    """Linear interpolation in the frame of three references (tits2018 eq 9); constant at a recording's end."""

    name = "local_interpolation"
    continuous = True

    def _recover(self, case: _Case, rows: np.ndarray) -> np.ndarray:
        known = case.known_borders()
        if len(known) == 0 or len(self._training(case)) == 0:
            return np.full((len(rows), 3), np.nan)
        local = case.triangle_at(known).frames.local(case.scene.positions[known, case.marker])
        return case.triangle_at(rows).frames.laboratory(_interpolated(rows, known, local))


def _interpolated(rows: np.ndarray, known: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values (n, 3) at rows between those (k, 3) at known frames."""
    return np.stack([np.interp(rows, known, axis) for axis in values.T], axis=1)


class _TriangleRegression(_TriangleModel):
    """Regression of the local position on the shape of the triangle."""

    continuous = False

    def predict_continuous(self, scene: Scene, marker: int, start: int, stop: int) -> Prediction:
        """Predict a marker and meet the borders by a ramp in the local frame. See `LocallyContinuous.predict_continuous`."""
        return self._search(scene, marker, start, stop, self._recover_continuous)

    def _recover(self, case: _Case, rows: np.ndarray) -> np.ndarray:
        return case.triangle_at(rows).frames.laboratory(self._local(case, rows))

    def _recover_continuous(self, case: _Case, rows: np.ndarray) -> np.ndarray:
        """See _recover; less the ramp between the offsets at the borders, in the local frame."""
        known = case.known_borders()
        if len(known) == 0:
            return np.full((len(rows), 3), np.nan)
        smoothed = case.smoothed_triangle_at(known, self.options.reference_smoothing_s)
        observed = smoothed.frames.local(case.scene.positions[known, case.marker])
        ramp = _interpolated(rows, known, self._local(case, known) - observed)
        return case.triangle_at(rows).frames.laboratory(self._local(case, rows) - ramp)

    def _local(self, case: _Case, rows: np.ndarray) -> np.ndarray:
        """Position (n, 3) in the local frame at rows, where the references are observed; NaN where the model cannot be trained."""
        training = self._training(case)
        if len(training) == 0:
            return np.full((len(rows), 3), np.nan)
        key = "regression", self.options, case.marker, case.references.tobytes()
        data = case.scene.cached(key, partial(_standardised, case, training, self.options.reference_smoothing_s))
        shape = case.smoothed_triangle_at(rows, self.options.reference_smoothing_s).shape
        return self._regress(data.inputs, data.target, (shape - data.mean) / data.deviation)

    @abstractmethod
    def _regress(self, inputs: np.ndarray, target: np.ndarray, at: np.ndarray) -> np.ndarray:
        """Targets (m, 3) expected at inputs (m, 3), from training inputs (n, 3) and targets (n, 3)."""


def _standardised(case: _Case, training: np.ndarray, smoothing_s: float) -> _TrainingSet:
    """Training data at frames that show the marker and its references."""
    known = case.smoothed_triangle_at(training, smoothing_s)
    mean, deviation = known.shape.mean(axis=0), np.maximum(known.shape.std(axis=0), MIN_SHAPE_STD_MM)
    target = known.frames.local(case.scene.positions[training, case.marker])
    valid = ~np.isnan(target).any(axis=1)
    return _TrainingSet(((known.shape - mean) / deviation)[valid], target[valid], mean, deviation)


class LocalQuadratic(_TriangleRegression):
    """Quadratic regression in the frame of three references (tits2018 eq 12-14)."""

    name = "local_quadratic"

    def _regress(self, inputs: np.ndarray, target: np.ndarray, at: np.ndarray) -> np.ndarray:
        return quadratic_regression(inputs, target, at, ridge=self.options.ridge)


class LocalGRNN(_TriangleRegression):
    """Generalised regression neural network in the frame of three references (tits2018 eq 15)."""

    name = "local_grnn"

    def _regress(self, inputs: np.ndarray, target: np.ndarray, at: np.ndarray) -> np.ndarray:
        return kernel_regression(inputs, target, at, width=self.options.kernel_width_sigmas)


def quadratic_regression(inputs: np.ndarray, target: np.ndarray, at: np.ndarray, *, ridge: float) -> np.ndarray:
    """Regress targets on all monomials up to degree two of the inputs.

    Parameters
    ----------
    inputs : np.ndarray
        Training inputs (n, k).
    target : np.ndarray
        Training targets (n, 3).
    at : np.ndarray
        Inputs (m, k) to predict from.
    ridge : float
        Penalty on all coefficients but the intercept, as a share of n (0 in the paper).

    Returns
    -------
    np.ndarray
        Expected targets (m, 3).

    References
    ----------
    tits2018 eq 12-14.
    """
    design, design_at = _monomials(inputs), _monomials(at)
    penalty = np.sqrt(ridge * len(inputs)) * np.eye(design.shape[1])[1:]
    padded = np.concatenate([target, np.zeros((len(penalty), target.shape[1]))])
    expected: np.ndarray = design_at @ np.linalg.lstsq(np.concatenate([design, penalty]), padded, rcond=1e-9)[0]
    return expected


def _monomials(inputs: np.ndarray) -> np.ndarray:
    """One, the inputs, and all their products in pairs."""
    first, second = np.triu_indices(inputs.shape[1])
    return np.concatenate([np.ones((len(inputs), 1)), inputs, inputs[:, first] * inputs[:, second]], axis=1)


def kernel_regression(inputs: np.ndarray, target: np.ndarray, at: np.ndarray, *, width: float) -> np.ndarray:
    """Average targets with Gaussian weights (Nadaraya-Watson; a generalised regression neural network).

    Parameters
    ----------
    inputs : np.ndarray
        Training inputs (n, k).
    target : np.ndarray
        Training targets (n, 3).
    at : np.ndarray
        Inputs (m, k) to predict from.
    width : float
        Standard deviation of the kernel, in the unit of the inputs.

    Returns
    -------
    np.ndarray
        Expected targets (m, 3); far from all training inputs, that of the nearest.

    References
    ----------
    tits2018 eq 15.
    """
    square = (at**2).sum(axis=1)[:, None] - 2 * at @ inputs.T + (inputs**2).sum(axis=1)
    # The nearest weighs one, so that the weights never vanish.
    square -= square.min(axis=1, keepdims=True)
    square /= -2 * width**2
    weight = np.exp(square, out=square)
    expected: np.ndarray = weight @ target / weight.sum(axis=1, keepdims=True)
    return expected
