"""Search for the course of a lasting displacement that explains most of what the pose leaves of a marker's motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from markermend.options.detection.displacement import DisplacementOptions
from markermend.prediction.lasting_displacement.course import Course, bump, rise
from markermend.prediction.lasting_displacement.displacement import MIN_INDEPENDENT_VARIANCE, Displacement, estimate
from markermend.prediction.lasting_displacement.pose_regression import PoseRegression
from markermend.prediction.local_ridge.model import TrainingSet


@dataclass(frozen=True, eq=False)
class _Explained:
    """What courses explain: (k,) of rises to the end, (moments, moments) of sudden ones that end again; and all variance."""

    rises: np.ndarray
    returns: np.ndarray
    total: float


@dataclass(frozen=True, eq=False)
class _Grid:
    """The moments that are tried on a marker, from `border_s` to that before its end, besides known displacements (n, j).

    The marker is at each place for `side_s` at least.
    """

    data: TrainingSet
    known: np.ndarray
    middles: np.ndarray
    border_s: float
    side_s: float

    @property
    def lasts_to_end(self) -> np.ndarray:
        """Whether both places last long enough if the displacement begins at a moment and does not end, bool (moments,)."""
        since = self.middles - (self.middles[0] - self.border_s)
        long: np.ndarray = np.minimum(since, since[::-1]) >= self.side_s
        return long

    @property
    def returns(self) -> np.ndarray:
        """Whether both places last long enough if it begins and ends at two moments, bool (moments, moments)."""
        apart = np.abs(self.middles[:, None] - self.middles)
        whole = self.middles[-1] - self.middles[0] + 2 * self.border_s
        long: np.ndarray = (apart >= self.side_s) & (whole - apart >= self.side_s)
        return long


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
        end = min(self.options.min_duration_s, side)
        grid = _Grid(data, known, np.linspace(time_s[0] + end, time_s[-1] - end, self.options.moments), end, side)
        weights = np.ones(len(time_s))
        course = self._best_course(grid, weights, (0.0,))
        first = None if course is None else self._estimate(data, course, known)
        if first is None or first.explained < self.options.screening_fraction * self.options.min_explained_share:
            return None
        rises = (0.0, *(duration for duration in self.options.rise_durations_s if duration < span / 3))
        course = self._best_course(grid, first.weights, rises)
        return None if course is None else self._estimate(data, course, known)

    def _estimate(self, data: TrainingSet, course: Course, known: np.ndarray) -> Displacement:
        """The displacement of a course."""
        return estimate(data, course, rate=self.rate, ridge=self.ridge, options=self.options, known=known)

    def _best_course(self, grid: _Grid, weights: np.ndarray, rises: tuple[float, ...]) -> Course | None:
        """The course that explains most, given the weights of the frames; a creep or a return must explain clearly more."""
        time_s, middles = grid.data.training / self.rate, grid.middles
        explained = self._explained(grid, weights, [rise(time_s, middles, duration) for duration in rises])
        count = len(middles)
        to_end = np.where(np.tile(grid.lasts_to_end, len(rises)), explained.rises, 0.0)
        sudden, any_rise = int(to_end[:count].argmax()), int(to_end.argmax())
        course, left = Course(float(middles[sudden])), explained.total - to_end[sudden]
        if explained.total - to_end[any_rise] < self.options.creep_gain * left:
            left = explained.total - to_end[any_rise]
            course = Course(float(middles[any_rise % count]), rises[any_rise // count])
        returns = np.where(grid.returns, explained.returns, 0.0)
        first, last = sorted(int(i) for i in np.unravel_index(int(returns.argmax()), returns.shape))
        if explained.total - returns[first, last] < self.options.return_gain * left:
            return self._returning(grid, weights, first, last, rises[1:])
        return course

    def _returning(
        self, grid: _Grid, weights: np.ndarray, first: int, last: int, rises: tuple[float, ...]
    ) -> Course | None:
        """The best course that ends at a moment: sudden at another, or a creep that explains clearly more.

        A creep stays for as long as it rises, at least, and for a while. None where a drift explains more.
        """
        stop_s, time_s = float(grid.middles[last]), grid.data.training / self.rate
        sudden = Course(float(grid.middles[first]), stop_s=stop_s)
        own = [sudden]
        for duration in rises:
            stay = max(duration, self.options.min_stay_s)
            near = grid.middles[np.abs(grid.middles - sudden.middle_s) <= duration / 2]
            own += [Course(float(m), duration, stop_s) for m in near if m + duration / 2 + stay <= stop_s]
        values = [course.at(time_s) for course in own]
        values += [bump(time_s, sudden.middle_s, stop_s, width) for width in self.options.drift_widths]
        explained = self._explained(grid, weights, [np.stack(values, axis=1)])
        left = explained.total - explained.rises
        best = int(left[: len(own)].argmin())
        if rises and left[len(own) :].min() < left[best]:
            return None
        return own[best] if left[best] < self.options.creep_gain * left[0] else sudden

    def _explained(self, grid: _Grid, weights: np.ndarray, courses: list[np.ndarray]) -> _Explained:
        """Variance that courses (n, moments) of each rise duration explain; the first are sudden."""
        data, known = grid.data, grid.known
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
