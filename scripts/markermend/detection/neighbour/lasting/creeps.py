"""Creeps by generalised least squares: rises to another level, estimated together with the regression on the neighbours.

The share of the variance that a creep explains says little where the marker moves much: the error of its regression is coloured,
and as large as the motion at the time. In units of its standard deviation the height of a creep stands out there all the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from markermend.detection.neighbour.drifts.estimated import EstimatedDrifts
from markermend.numerics.pulse_regression import PulseRegression
from markermend.numerics.rise_regression import RiseRegression
from markermend.options.detection.displacement import DisplacementOptions
from markermend.prediction.lasting_displacement.course import Course


@dataclass(frozen=True, eq=False)
class EstimatedCreeps:
    """Proposes the creep of each marker that stands out most.

    Attributes
    ----------
    drifts : EstimatedDrifts
        The models of all markers, and the drifts that come back.
    options : DisplacementOptions
        Which creeps are tried.
    """

    drifts: EstimatedDrifts
    options: DisplacementOptions

    def course(self, marker: int) -> Course | None:
        """Propose a creep.

        Parameters
        ----------
        marker : int
            Index of the marker.

        Returns
        -------
        Course or None
            The course of the creep that stands out most; None where none does, or a drift stands out more meanwhile.
        """
        model = self.drifts.models[marker]
        each = [best for first, part in model.regressions() for best in self._best(first, part)]
        statistic, course = max(each, key=lambda best: best[0], default=(0.0, None))
        if course is None or statistic < self.options.creep_threshold_sigmas:
            return None
        score, _ = self.drifts.scores(model)
        meanwhile = course.at((np.arange(len(score)) + 0.5) * self.bin_s) > 0
        return course if statistic > self.drifts.own.threshold_sigmas * score[meanwhile].max() else None

    @property
    def bin_s(self) -> float:
        """Duration of a bin, s."""
        return self.drifts.regression.step / self.drifts.regression.rate

    def _best(self, first: int, part: PulseRegression) -> Iterator[tuple[float, Course]]:
        """The creep of each duration that stands out most in a part of the recording that begins at a bin."""
        bins, sums, in_bins = len(part.weighted), RiseRegression.of(part), self.drifts.regression.bins
        border, stay = in_bins(self.options.min_duration_s), in_bins(self.options.min_stay_s)
        spacing = max(1, bins // self.options.moments)
        for length in sorted(map(in_bins, self.options.estimated_rise_durations_s)):
            starts = np.arange(border, bins - length - stay + 1, spacing)
            stops = np.append(np.arange(border + length + stay, bins - border + 1), bins)
            if not len(starts):
                return
            statistic = sums.rises(length, starts, stops).statistic
            statistic[stops - starts[:, None] - length < max(stay, length)] = 0.0
            i, j = np.unravel_index(int(statistic.argmax()), statistic.shape)
            # The ramp is sampled in the middles of bins: it has begun half a bin before its first sample.
            begin_s, rise_s = (first + int(starts[i]) - 0.5) * self.bin_s, length * self.bin_s
            stop_s = np.inf if stops[j] == bins else (first + int(stops[j])) * self.bin_s
            yield float(statistic[i, j]), Course(begin_s + rise_s / 2, rise_s, stop_s)
