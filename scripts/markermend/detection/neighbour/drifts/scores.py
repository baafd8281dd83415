"""Scores of drifts: how clearly a raised-cosine pulse of each length stands out in the residual of each marker.

The responses of matched filters are compared with their local scale, which is fitted to the motion of the body.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.detection.neighbour import nearest_neighbours, residual_scale
from markermend.numerics import interpolation, intervals, matched_filter
from markermend.numerics.intervals import runs
from markermend.options.detection.slow import SlowOptions
from markermend.prediction.scene import Scene

MIN_TEMPLATE = 5
"""Frames of a template, at least: fewer have no shape."""


@dataclass(frozen=True)
class DriftScores:
    """How clearly drifts stand out.

    Attributes
    ----------
    residual : np.ndarray
        Residuals (frames, markers, 3), mm, NaN = missing.
    score : np.ndarray
        Response of the template that stands out most (frames, markers), in units of the threshold; 0 where unknown.
    length : np.ndarray
        Length of that template (frames, markers), frames.
    scale_mm : np.ndarray
        Local scale as the height of a drift of that length (frames, markers), mm.
    scale : np.ndarray
        Local scale of the responses (lengths, frames, markers).
    level : np.ndarray
        Median response (lengths, markers).
    """

    residual: np.ndarray
    score: np.ndarray
    length: np.ndarray
    scale_mm: np.ndarray
    scale: np.ndarray
    level: np.ndarray


@dataclass(frozen=True)
class DriftScorer:
    """Scores drifts of several lengths in residuals.

    Attributes
    ----------
    rate : float
        Sampling rate, Hz.
    options : SlowOptions
        Lengths of the templates, threshold, local scale, and attribution.
    """

    rate: float
    options: SlowOptions

    @property
    def lengths(self) -> list[int]:
        """Lengths of the templates, frames."""
        return [max(MIN_TEMPLATE, intervals.samples(length, self.rate)) for length in self.options.durations_s]

    def motion(self, scene: Scene) -> np.ndarray:
        """Measure how the neighbours of each marker move, see nearest_neighbours.motion.

        Parameters
        ----------
        scene : Scene
            What is observed.

        Returns
        -------
        np.ndarray
            Speed, mm/s, and acceleration, mm/s^2, (2, frames, markers).
        """
        smoothing = max(3, intervals.samples(self.options.bridged_gap_s, self.rate, odd=True))
        return nearest_neighbours.motion(
            scene.positions,
            scene.neighbours,
            rate=self.rate,
            count=self.options.scale_neighbours,
            smoothing=smoothing,
        )

    def score(self, scene: Scene, residual: np.ndarray, factors: np.ndarray, motion: np.ndarray) -> DriftScores:
        """Score drifts in the residuals of all markers.

        Parameters
        ----------
        scene : Scene
            What is observed.
        residual : np.ndarray
            Residuals (frames, markers, 3), mm, NaN = missing.
        factors : np.ndarray
            Factors (frames, markers) by which the leverage of the pose widens their distribution.
        motion : np.ndarray
            Motion of the neighbours (kinds, frames, markers).

        Returns
        -------
        DriftScores
            The scores; 0 where a near neighbour is briefly missing.
        """
        unsteady = self.briefly_missing_neighbour(scene)
        # The responses of all templates take as much memory as the recording: those of a length go when its scores are known.
        responses = [np.empty(residual.shape[:2], np.float32) for _ in self.lengths]
        deviation = np.empty((len(self.lengths), residual.shape[1]), np.float32)
        for m in range(residual.shape[1]):
            steady = np.where(unsteady[:, m, None], np.nan, residual[:, m])
            own, deviation[:, m] = self.responses(steady, factors[:, m])
            for response, of_length in zip(responses, own, strict=True):
                response[:, m] = of_length
        score, scale_mm = np.full((2, *residual.shape[:2]), -1.0, np.float32)
        length = np.zeros(residual.shape[:2], np.int32)
        scales, levels = np.empty((len(self.lengths), *residual.shape[:2]), np.float32), np.empty(deviation.shape)
        for number, own_length in enumerate(self.lengths):
            response = responses.pop(0)
            scales[number] = scale = self._scale(scene, response, motion, own_length)
            levels[number] = median_response(response.T)
            own_score = np.nan_to_num(response / (self.options.threshold_sigmas * scale))
            clearer = own_score > score
            score[clearer], length[clearer] = own_score[clearer], own_length
            scale_mm[clearer] = (deviation[number] * factors.astype(np.float32) * scale)[clearer]
        return DriftScores(residual, score, length, scale_mm, scales, levels)

    def rescore(self, scores: DriftScores, residual: np.ndarray, factors: np.ndarray, *, marker: int) -> np.ndarray:
        """Score drifts in another residual of one marker, whose local scale rises with its median response.

        Parameters
        ----------
        scores : DriftScores
            The scores before.
        residual : np.ndarray
            The new residual (frames, 3), mm, NaN = missing.
        factors : np.ndarray
            Factors (frames,) by which the leverage of the pose widens its distribution.
        marker : int
            Index of the marker.

        Returns
        -------
        np.ndarray
            The largest score of all templates (frames,), in units of the threshold.
        """
        response, _ = self.responses(residual, factors)
        growth = np.maximum(median_response(response) / scores.level[:, marker], 1)
        scale = self.options.threshold_sigmas * scores.scale[:, :, marker] * growth[:, None]
        largest: np.ndarray = np.nan_to_num(response / scale).max(axis=0)
        return largest

    def responses(self, residual: np.ndarray, factors: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Filter the residual of one marker with the template of each length.

        Parameters
        ----------
        residual : np.ndarray
            Residual (frames, 3), mm, NaN = missing.
        factors : np.ndarray
            Factors (frames,) by which it is divided, so that its covariance is the same throughout.

        Returns
        -------
        response : np.ndarray
            Responses (lengths, frames), in standard deviations, NaN where unknown.
        deviation : np.ndarray
            Standard deviation (lengths,) of the height of a drift where the factor is 1, mm; NaN likewise.
        """
        options, lengths = self.options, self.lengths
        response = np.full((len(lengths), len(residual)), np.nan, np.float32)
        deviation = np.full(len(lengths), np.nan)
        if np.isnan(residual).all():
            return response, deviation
        bridged = intervals.samples(options.bridged_gap_s, self.rate)
        signal = interpolation.bridge_linear(residual / factors[:, None], bridged)
        covariance = matched_filter.clipped_covariance(
            signal,
            sigmas=options.outlier_sigmas,
            rate=self.rate,
            scales_s=np.array(options.correlation_times_s),
            max_lag_s=options.max_lag_s,
        )
        for number, length in enumerate(lengths):
            template = matched_filter.design_filter(
                covariance,
                length=length,
                flank=options.flank_fraction,
                taps=options.samples_per_duration,
                rate=self.rate,
            )
            response[number] = matched_filter.filter_response(signal, template)
            deviation[number] = template.deviation
        return response, deviation

    def required_score(self, score: np.ndarray, start: int, stop: int) -> float:
        """Raise the threshold of a drift by the scores of its marker at other times, see `required_score`.

        Parameters
        ----------
        score : np.ndarray
            Scores of the marker (frames,).
        start, stop : int
            The drift, [start, stop).

        Returns
        -------
        float
            The score that the drift must reach.
        """
        factor, limit = self.options.distinct_factor, self.options.obvious_factor
        return required_score(score, start, stop, reach=self.lengths[-1], factor=factor, limit=limit)

    def briefly_missing_neighbour(self, scene: Scene) -> np.ndarray:
        """Mark where a near neighbour is missing for a short time: the prediction from the others deviates.

        Parameters
        ----------
        scene : Scene
            What is observed.

        Returns
        -------
        np.ndarray
            Bool (frames, markers).
        """
        brief = intervals.samples(self.options.bridged_gap_s, self.rate)
        missing = np.zeros(scene.present.shape, bool)
        for m, absent in enumerate(~scene.present.T):
            for start, stop in runs(absent):
                missing[start:stop, m] = stop - start <= brief
        near = [np.asarray(around, int)[: self.options.attribution_neighbours] for around in scene.neighbours]
        return np.stack([missing[:, around].any(axis=1) for around in near], axis=1)

    def _scale(self, scene: Scene, response: np.ndarray, motion: np.ndarray, length: int) -> np.ndarray:
        """Local scale (frames, markers) of the responses of templates of a length."""
        return residual_scale.fitted_scale(
            response,
            scene.neighbours,
            motion,
            count=self.options.scale_neighbours,
            window=length,
            min_scale=self.options.min_scale_sigmas,
        ).astype(np.float32)


def median_response(response: np.ndarray) -> np.ndarray:
    """Take the median of the known responses of each template.

    Parameters
    ----------
    response : np.ndarray
        Responses (lengths, frames), NaN = unknown.

    Returns
    -------
    np.ndarray
        Medians (lengths,); 1 where nothing is known.
    """
    known: Sequence[np.ndarray] = [own[~np.isnan(own)] for own in response]
    return np.array([np.median(own) if len(own) else 1.0 for own in known])


def required_score(score: np.ndarray, start: int, stop: int, *, reach: int, factor: float, limit: float) -> float:
    """Raise the threshold of a drift by the scores of its marker at other times, since deviations that recur are motion.

    Parameters
    ----------
    score : np.ndarray
        Scores of the marker (n,).
    start, stop : int
        The drift, [start, stop).
    reach : int
        Samples on either side of a peak of the score that belong to it.
    factor : float
        The drift must exceed the second largest score elsewhere by this factor.
    limit : float
        No more than this is required.

    Returns
    -------
    float
        The score that the drift must reach, at least 1.
    """
    elsewhere = score.copy()
    elsewhere[max(0, start - reach) : stop + reach] = 0
    top = int(elsewhere.argmax())
    elsewhere[max(0, top - reach) : top + reach] = 0
    return float(np.clip(factor * elsewhere.max(), 1, limit))
