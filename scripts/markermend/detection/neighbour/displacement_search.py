"""Search for the course of a lasting displacement that explains most of what the pose leaves of a marker's motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.options.detection.displacement import DisplacementOptions
from markermend.prediction import lasting_displacement
from markermend.prediction.lasting_displacement import (
    MIN_INDEPENDENT_VARIANCE,
    Course,
    Displacement,
    PoseRegression,
    rise,
)
from markermend.prediction.local_ridge.model import TrainingSet

SCREENING_FRACTION = 0.5
"""A marker is searched closely where a sudden displacement explains this part of the share that is wanted."""


@dataclass(frozen=True, eq=False)
class _Explained:
    """What courses explain: (k,) of rises to the end, (moments, moments) of sudden ones that end again; and all variance."""

    rises: np.ndarray
    returns: np.ndarray
    total: float


@dataclass(frozen=True)
class DisplacementSearch:
    """Finds the best course of a displacement of one marker.

    Attributes
    ----------
    rate : float
        Sampling rate, Hz.
    ridge : float
        Penalty of the pose, mm^2.
    options : DisplacementOptions
        The courses that are tried, and how two are compared.
    """

    rate: float
    ridge: float
    options: DisplacementOptions

    def best(self, data: TrainingSet, known: np.ndarray) -> Displacement | None:
        """Find the displacement that explains most.

        Parameters
        ----------
        data : TrainingSet
            The marker and its neighbours.
        known : np.ndarray
            Courses of displacements that are known already (n, j).

        Returns
        -------
        Displacement or None
            The displacement; None where the recording is too short, or a sudden one explains so little that a closer
            search is not worthwhile.
        """
        time_s = data.training / self.rate
        span = float(time_s[-1] - time_s[0])
        side = max(self.options.min_duration_s, self.options.min_duration_share * span)
        if span <= 2 * side:
            return None
        middles = np.linspace(time_s[0] + side, time_s[-1] - side, self.options.moments)
        weights = np.ones(len(time_s))
        first = self._estimate(data, self._best_course(data, known, weights, middles, (0.0,), side), known)
        if first.explained < SCREENING_FRACTION * self.options.min_explained_share:
            return None
        rises = (0.0, *(duration for duration in self.options.rise_durations_s if duration < span / 3))
        return self._estimate(data, self._best_course(data, known, first.weights, middles, rises, side), known)

    def _estimate(self, data: TrainingSet, course: Course, known: np.ndarray) -> Displacement:
        """The displacement of a course."""
        return lasting_displacement.estimate(
            data, course, rate=self.rate, ridge=self.ridge, options=self.options, known=known
        )

    def _best_course(
        self,
        data: TrainingSet,
        known: np.ndarray,
        weights: np.ndarray,
        middles: np.ndarray,
        rises: tuple[float, ...],
        side: float,
    ) -> Course:
        """The course that explains most, given the weights of the frames; a creep or a return must explain clearly more."""
        time_s = data.training / self.rate
        explained = self._explained(data, known, weights, [rise(time_s, middles, duration) for duration in rises])
        count = len(middles)
        sudden, any_rise = int(explained.rises[:count].argmax()), int(explained.rises.argmax())
        course, left = Course(float(middles[sudden])), explained.total - explained.rises[sudden]
        if explained.total - explained.rises[any_rise] < self.options.creep_gain * left:
            left = explained.total - explained.rises[any_rise]
            course = Course(float(middles[any_rise % count]), rises[any_rise // count])
        apart = np.abs(middles[:, None] - middles) >= side
        returns = np.where(apart, explained.returns, 0.0)
        first, last = sorted(int(i) for i in np.unravel_index(int(returns.argmax()), returns.shape))
        if explained.total - returns[first, last] < self.options.return_gain * left:
            course = Course(float(middles[first]), stop_s=float(middles[last]))
        return course

    def _explained(
        self, data: TrainingSet, known: np.ndarray, weights: np.ndarray, courses: list[np.ndarray]
    ) -> _Explained:
        """Variance that courses (n, moments) of each rise duration explain; the first are sudden."""
        regression = PoseRegression.fit(data.local[:, :-3], known, weights, ridge=self.ridge)
        local, every = data.target, np.concatenate(courses, axis=1)
        left, weighted = regression.residual(local), every * weights[:, None]
        free = regression.residual(every)
        count, smallest = courses[0].shape[1], MIN_INDEPENDENT_VARIANCE * float(weights.sum())
        cross, own = weighted.T @ left, (weighted * free).sum(axis=0)
        shared = weighted[:, :count].T @ free[:, :count]
        pairs = own[:count, None] + own[:count] - shared - shared.T
        difference = cross[:count, None] - cross[:count]
        return _Explained(
            rises=np.square(cross).sum(axis=1) / np.maximum(own, smallest),
            returns=np.square(difference).sum(axis=2) / np.maximum(pairs, smallest),
            total=float((weights[:, None] * local * left).sum()),
        )
