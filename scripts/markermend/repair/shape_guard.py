"""Guard of the usual shape: a repair must bring the distances to the steadiest markers nearer to what they should be.

Where too few distances vary by less than a repair moves the marker, they do not fix its place, and the repair stands unless it
takes them clearly away from the usual ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from markermend.core.reasons import Cause, Reason
from markermend.numerics import filters
from markermend.numerics.intervals import samples
from markermend.options.prediction.local_ridge import LocalRidgeOptions
from markermend.options.repair import ShapeGuardOptions
from markermend.prediction.scene import Scene
from markermend.repair.expected_distances import DistanceEstimator, ExpectedDistances, log_density, nan_mean


@dataclass(frozen=True, eq=False)
class ShapeGuard:
    """Judges repairs of a recording by the distances to the steadiest mates.

    Attributes
    ----------
    scene : Scene
        The trajectories without any finding, with the usual shape of the subject.
    options : ShapeGuardOptions
        Numbers of mates, and how clear the distances must be.
    kriging : LocalRidgeOptions
        Correlation times, longest lag and border of the kriging.
    markers : sequence of str
        Names of the markers.
    """

    scene: Scene
    options: ShapeGuardOptions
    kriging: LocalRidgeOptions
    markers: Sequence[str]

    def objection(self, marker: int, start: int, measured: np.ndarray, proposed: np.ndarray) -> Reason | None:
        """Find the reason why the distances speak against a repair.

        Parameters
        ----------
        marker : int
            Index of the marker.
        start : int
            First frame of the finding.
        measured, proposed : ndarray of float, shape (n, 3)
            The samples as measured and as proposed, mm; NaN = missing.

        Returns
        -------
        Reason or None
            The reason, with the distance that speaks most clearly against it. None where the repair brings all of them together
            clearly nearer to what is expected; where it brings them nearer as a right one would, weighted by their precision, too,
            or takes shaking out of them, and not clearly away from usual; and where too few of them are known, or vary by less
            than the repair changes, and it does not take them clearly away from usual.
        """
        local = self.distances.expected(marker, start, start + len(measured))
        if local is None:
            return None
        seen, options = np.where(np.isnan(measured), np.nan, proposed), self.options
        gain = self._log_densities(local, seen) - self._log_densities(local, measured)
        if np.isnan(gain).all() or nan_mean(gain, axis=None) >= options.clear_gain:
            return None
        nearer = self._nearer(local, gain, measured, seen) or self._calmer(local, measured, seen)
        if self._decide(local, seen - measured) and not nearer:
            return self._against(local, gain, measured, seen)
        return self._against_usual(self.distances.usual(marker, local), measured, seen)

    def objection_to_level(self, marker: int, start: int, measured: np.ndarray, proposed: np.ndarray) -> Reason | None:
        """Find the reason why the usual distances speak against a repair that takes many like jumps out of a trajectory.

        The jumps prove that one of two levels is wrong; which one, the distances must not clearly contradict.

        Parameters
        ----------
        marker, start, measured, proposed
            See `objection`.

        Returns
        -------
        Reason or None
            The reason, with the distance that speaks most clearly against it; None where the repair does not take the distances
            clearly away from the usual ones, or too few of them are known.
        """
        local = self.distances.expected(marker, start, start + len(measured))
        if local is None:
            return None
        seen = np.where(np.isnan(measured), np.nan, proposed)
        return self._against_usual(self.distances.usual(marker, local), measured, seen)

    def _against_usual(self, usual: ExpectedDistances, measured: np.ndarray, proposed: np.ndarray) -> Reason | None:
        """The reason against a repair that takes the distances clearly away from the usual ones."""
        gain = self._log_densities(usual, proposed) - self._log_densities(usual, measured)
        lost = nan_mean(gain, axis=None) < -self.options.max_loss
        return self._against(usual, gain, measured, proposed) if lost else None

    def _decide(self, expected: ExpectedDistances, change: np.ndarray) -> bool:
        """Whether enough distances are steadier than a repair changes (n, 3) the positions, mm, to fix where the marker is."""
        size = np.sqrt(nan_mean((change**2).sum(axis=1), axis=None))
        steadier = np.sqrt(np.mean(expected.deviation**2, axis=0)) < size
        return bool(size == 0 or np.count_nonzero(steadier) >= self.options.min_mates)

    def _nearer(
        self, expected: ExpectedDistances, gain: np.ndarray, measured: np.ndarray, proposed: np.ndarray
    ) -> bool:
        """Whether distances come nearer to what is expected; gain: (n, k) as `objection`.

        If a repair is right, its change of a distance shows how unlikely the measured one is.
        """
        change = (expected.lengths(proposed) - expected.lengths(measured)) / expected.deviation
        right = -nan_mean(log_density(change, self.options.degrees_of_freedom), axis=None)
        enough = nan_mean(gain, axis=None) >= self.options.min_gain_share * right
        return bool(enough and expected.by_precision(gain) > self.options.min_gain)

    def _calmer(self, expected: ExpectedDistances, measured: np.ndarray, proposed: np.ndarray) -> bool:
        """Whether a repair changes fast motion only, little and for long enough, and leaves little of it in the distances.

        Distances that vary by more than a marker shakes say where it is too vaguely, but not how it shakes.
        """
        options = self.options
        window = samples(options.shaking_window_s, self.scene.rate, odd=True)
        size = np.sqrt(nan_mean(((proposed - measured) ** 2).sum(axis=1), axis=None))
        if len(measured) < options.min_shaking_windows * window or not size <= options.max_shaking_mm:
            return False
        change, before, after = (
            np.stack([filters.high_pass(column, window, 1) for column in values.T], axis=1)
            for values in (proposed - measured, expected.lengths(measured), expected.lengths(proposed))
        )
        fast = np.nansum(change**2) >= options.min_fast_share * np.nansum((proposed - measured) ** 2)
        shaken = np.nansum(before**2, axis=0)
        # Of a mate that is seen for single frames only, no fast change is known.
        calmer = (shaken > 0) & (np.nansum(after**2, axis=0) <= options.max_shaking_left * shaken)
        return bool(fast and np.count_nonzero(calmer) > len(calmer) / 2)

    def _against(
        self, expected: ExpectedDistances, gain: np.ndarray, measured: np.ndarray, proposed: np.ndarray
    ) -> Reason:
        """The reason against a repair, with the distance that speaks most clearly against it; gain: (n, k) as `objection`."""
        frame, mate = np.unravel_index(np.nanargmin(gain), gain.shape)
        before, after = (expected.lengths(points)[frame, mate] for points in (measured, proposed))
        wanted = expected.distance[frame, mate]
        figures = f"expected {wanted:.1f} mm, measured {before:.1f} mm, repaired {after:.1f} mm"
        name = self.markers[expected.mates[mate]]
        return Reason(
            Cause.AGAINST_SHAPE, f"the distances to its neighbours come no nearer to usual ({name}: {figures})"
        )

    def why_kept(self, marker: int, start: int, measured: np.ndarray) -> str | None:
        """Say why samples that no repair is accurate enough for are not taken away.

        Parameters
        ----------
        marker : int
            Index of the marker.
        start : int
            First frame of the finding.
        measured : ndarray of float, shape (n, 3)
            The samples as measured, mm; NaN = missing.

        Returns
        -------
        str or None
            That the distances are as expected, with the one that is furthest off; None where they contradict the samples, or
            where too few of them are known.
        """
        expected = self.distances.expected(marker, start, start + len(measured))
        if expected is None:
            return None
        densities = self._log_densities(expected, measured)
        if np.isnan(densities).all() or nan_mean(densities, axis=None) < -self.options.max_misfit:
            return None
        frame, mate = np.unravel_index(np.nanargmin(densities), densities.shape)
        wanted, length = expected.distance[frame, mate], expected.lengths(measured)[frame, mate]
        name = self.markers[expected.mates[mate]]
        return f"the distances to its neighbours are usual ({name}: expected {wanted:.1f} mm, measured {length:.1f} mm)"

    def _log_densities(self, expected: ExpectedDistances, points: np.ndarray) -> np.ndarray:
        """Log densities (n, k) of points by their distances."""
        return expected.log_densities(points, degrees_of_freedom=self.options.degrees_of_freedom)

    @cached_property
    def distances(self) -> DistanceEstimator:
        """What distances are compared with."""
        return DistanceEstimator(self.scene, self.options, self.kriging)
