"""What the distances of a marker to its steadiest mates should be over an interval, and how likely points are by them.

It follows from the usual distance of the subject and from the same distance just before and after the interval, by kriging: beside
the interval it is what it is there, far from it the usual one, and as uncertain as the distance varies over the recording. Points
are compared by Student's t distribution of the differences, so that a mate that is itself off does not decide.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from markermend.numerics.distances import distances
from markermend.numerics.kriging import Covariance, fit_covariance, krige
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.options.repair import ShapeGuardOptions
from markermend.prediction.scene import Scene

BORDER_LAGS = 6
"""Samples on either side of an interval from which distances are kriged, at most: the nearest, then at growing distances."""


@dataclass(frozen=True)
class ExpectedDistances:
    """What the distances of a marker to its steadiest mates should be over an interval.

    Attributes
    ----------
    mates : ndarray of int, shape (k,)
        Indices of the mates, the steadiest first.
    positions : ndarray of float, shape (n, k, 3)
        Positions of the mates, mm; NaN = missing.
    distance, deviation : ndarray of float, shape (n, k)
        Expected distances and their standard deviations, mm.
    """

    mates: np.ndarray
    positions: np.ndarray
    distance: np.ndarray
    deviation: np.ndarray

    def lengths(self, points: np.ndarray) -> np.ndarray:
        """Compute the distances of points to the mates.

        Parameters
        ----------
        points : ndarray of float, shape (n, 3)
            Positions of the marker, mm; NaN = missing.

        Returns
        -------
        ndarray of float, shape (n, k)
            Distances, mm; NaN where a point or a mate is missing.
        """
        return distances(points, self.positions)

    def log_densities(self, points: np.ndarray, *, degrees_of_freedom: float) -> np.ndarray:
        """Compute how likely points are by their distances.

        Parameters
        ----------
        points : ndarray of float, shape (n, 3)
            Positions of the marker, mm; NaN = missing.
        degrees_of_freedom : float
            Of Student's t distribution.

        Returns
        -------
        ndarray of float, shape (n, k)
            Log densities relative to those of the expected distances, at most 0; NaN where a point or a mate is missing.
        """
        return log_density((self.lengths(points) - self.distance) / self.deviation, degrees_of_freedom)

    def by_precision(self, values: np.ndarray) -> float:
        """Take the mean over the mates, each by the precision with which its distance is expected over the interval.

        Parameters
        ----------
        values : ndarray of float, shape (n, k)
            Values of the distances; NaN = unknown.

        Returns
        -------
        float
            The mean; NaN where no value is known.
        """
        each = nan_mean(values)
        known = ~np.isnan(each)
        precision = 1 / np.mean(self.deviation**2, axis=0)[known]
        return float(each[known] @ precision / precision.sum()) if known.any() else np.nan


@dataclass(frozen=True, eq=False)
class DistanceEstimator:
    """Predicts the distances of a marker to its steadiest mates.

    Attributes
    ----------
    scene : Scene
        The trajectories without any finding, with the usual shape of the subject.
    options : ShapeGuardOptions
        Numbers of mates, and the least deviation.
    kriging : LocalRidgeOptions
        Correlation times, longest lag and border of the kriging.
    """

    scene: Scene
    options: ShapeGuardOptions
    kriging: LocalRidgeOptions

    def expected(self, marker: int, start: int, stop: int) -> ExpectedDistances | None:
        """Predict the distances of a marker to its steadiest mates over an interval.

        Parameters
        ----------
        marker : int
            Index of the marker.
        start, stop : int
            The interval.

        Returns
        -------
        ExpectedDistances or None
            The distances; None where fewer than `min_mates` mates with usual distances are seen.
        """
        scene, shape = self.scene, self.scene.shape
        if shape is None:
            return None
        seen: np.ndarray = np.asarray(scene.present[start:stop].any(axis=0))
        mates = shape.steadiest(marker, self.options.mates, among=seen)
        if len(mates) < self.options.min_mates:
            return None
        lags = np.geomspace(1, max(2.0, self.kriging.border_s * scene.rate), BORDER_LAGS)
        reach = np.unique(np.round(lags).astype(int))
        border = np.concatenate([start - reach[::-1], stop - 1 + reach])
        border = border[(border >= 0) & (border < len(scene.positions))]
        usual = shape.distance[marker, mates]
        parts = [self._krige(marker, mate, border, np.arange(start, stop)) for mate in mates.tolist()]
        mean, deviation = (np.stack(part, axis=1) for part in zip(*parts, strict=True))
        return ExpectedDistances(mates, scene.positions[start:stop, mates], usual + mean, deviation)

    def usual(self, marker: int, like: ExpectedDistances) -> ExpectedDistances:
        """Give the usual distances of the subject to the mates of others.

        Parameters
        ----------
        marker : int
            Index of the marker.
        like : ExpectedDistances
            Expected distances to the mates.

        Returns
        -------
        ExpectedDistances
            The usual ones to the same mates.
        """
        shape, mates = self.scene.shape, like.mates
        assert shape is not None
        usual = np.broadcast_to(shape.distance[marker, mates], like.distance.shape)
        deviation = np.maximum(shape.deviation[marker, mates], self.options.min_deviation_mm)
        return ExpectedDistances(mates, like.positions, usual, np.broadcast_to(deviation, usual.shape))

    def _krige(self, marker: int, mate: int, border: np.ndarray, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Expected departure (n,) of a distance from the usual one, mm, and its standard deviation (n,), mm."""
        departure, rate = self._departure(marker, mate, border), self.scene.rate
        known = ~np.isnan(departure)
        mean, variance = krige(
            self._covariance(marker, mate),
            observed_s=border[known] / rate,
            values=departure[known, None],
            target_s=rows / rate,
        )
        return mean[:, 0], np.sqrt(variance + self.options.min_deviation_mm**2)

    def _departure(self, marker: int, mate: int, rows: np.ndarray | slice) -> np.ndarray:
        """Departure (n,) of a distance from the usual one in some frames, mm."""
        positions = self.scene.positions
        difference = positions[rows, marker] - positions[rows, mate]
        length = np.sqrt(np.einsum("ti,ti->t", difference, difference))
        assert self.scene.shape is not None
        departure: np.ndarray = length - self.scene.shape.distance[marker, mate]
        return departure

    def _covariance(self, marker: int, mate: int) -> Covariance:
        """Covariance over time of the departure of a distance from the usual one, over the recording."""
        if (marker, mate) not in self._covariances:
            departure = self._departure(marker, mate, slice(None))
            scales_s = np.array(self.kriging.correlation_times_s)
            self._covariances[marker, mate] = fit_covariance(
                departure[:, None], rate=self.scene.rate, scales_s=scales_s, max_lag_s=self.kriging.max_lag_s
            )
        return self._covariances[marker, mate]

    @cached_property
    def _covariances(self) -> dict[tuple[int, int], Covariance]:
        """Covariances that were computed before, by marker and mate."""
        return {}


def log_density(deviation: np.ndarray, degrees_of_freedom: float) -> np.ndarray:
    """Compute the log density of Student's t distribution relative to its mode.

    Parameters
    ----------
    deviation : ndarray of float
        Deviations in units of the scale.
    degrees_of_freedom : float
        Of the distribution.

    Returns
    -------
    ndarray of float
        Log densities, at most 0; NaN where the deviation is unknown.
    """
    density: np.ndarray = -(degrees_of_freedom + 1) / 2 * np.log1p(deviation**2 / degrees_of_freedom)
    return density


def nan_mean(values: np.ndarray, axis: int | None = 0) -> np.ndarray:
    """Compute means of the values that are known, without a warning where none is.

    Parameters
    ----------
    values : ndarray of float
        Values, NaN = unknown.
    axis : int or None
        The axis over which they are taken; None = all.

    Returns
    -------
    ndarray of float
        The means, NaN where no value is known.
    """
    known = ~np.isnan(values)
    count = known.sum(axis=axis)
    mean: np.ndarray = np.where(count > 0, np.where(known, values, 0.0).sum(axis=axis) / np.maximum(count, 1), np.nan)
    return mean
