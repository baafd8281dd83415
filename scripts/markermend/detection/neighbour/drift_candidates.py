"""How clearly do slow changes stand out, on each marker and at each moment, from what is to be expected there?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from markermend.detection.neighbour import residual_scale
from markermend.numerics import interpolation, intervals, matched_filter
from markermend.numerics.intervals import runs
from markermend.options.detection import SlowOptions
from markermend.prediction.scene import Scene


@dataclass(frozen=True)
class Matches:
    """How clearly bumps stand out.

    residual: (frames, markers, 3), mm. score: (frames, markers), that of the best length, in units of the threshold; 0
    where nothing is known. length: of that bump, frames. noise: the height to expect of it, mm. expected: (lengths, frames, markers), see
    liveliness.expected. level: (lengths, markers), the median strength.
    """

    residual: np.ndarray
    score: np.ndarray
    length: np.ndarray
    noise: np.ndarray
    expected: np.ndarray
    level: np.ndarray

    def judge_anew(
        self, residual: np.ndarray, wider: np.ndarray, *, marker: int, rate: float, options: SlowOptions
    ) -> np.ndarray:
        """Score (frames,) of a marker with another residual (frames, 3), mm: see `match`; what is expected, grown with its level."""
        own, _ = match(residual, wider, frames(options, rate), rate=rate, options=options)
        growth = np.maximum(level(own) / self.level[:, marker], 1)
        return np.nan_to_num(own / (options.threshold_sigmas * self.expected[:, :, marker] * growth[:, None])).max(
            axis=0
        )


def match(
    residual: np.ndarray, wider: np.ndarray, lengths: Sequence[int], *, rate: float, options: SlowOptions
) -> tuple[np.ndarray, np.ndarray]:
    """Strength of bumps of each length (lengths, frames) in one marker's residual, and the deviation of their height, mm.

    residual: (frames, 3), mm. wider: (frames,), what it is divided by, so that its covariance is the same throughout.
    """
    strength = np.full((len(lengths), len(residual)), np.nan, np.float32)
    deviation = np.full(strength.shape, np.nan, np.float32)
    if np.isnan(residual).all():
        return strength, deviation
    signal = interpolation.bridge_linear(residual / wider[:, None], intervals.samples(options.bridged_gap_s, rate))
    covariance = matched_filter.clipped_covariance(
        signal,
        sigmas=options.outlier_sigmas,
        rate=rate,
        scales_s=np.array(options.correlation_times_s),
        max_lag_s=options.max_lag_s,
    )
    for number, length in enumerate(lengths):
        bump = matched_filter.design_filter(
            covariance, length=length, flank=options.flank_fraction, taps=options.samples_per_duration, rate=rate
        )
        strength[number] = matched_filter.filter_response(signal, bump)
        deviation[number] = bump.deviation * wider
    return strength, deviation


def measure(scene: Scene, residual: np.ndarray, wider: np.ndarray, *, options: SlowOptions) -> Matches:
    """Measure how clearly bumps stand out in the residuals of all markers; wider: see `match`."""
    rate, lengths = scene.rate, frames(options, scene.rate)
    brief = briefly_gone(scene, options)
    steady = np.where(brief[:, :, None], np.nan, residual)
    each = [match(steady[:, m], wider[:, m], lengths, rate=rate, options=options) for m in range(residual.shape[1])]
    strength = np.stack([own for own, _ in each], axis=2)
    smooth = max(3, intervals.samples(options.bridged_gap_s, rate, odd=True))
    moving = residual_scale.motion(
        scene.positions, scene.neighbours, rate=rate, near=options.scale_neighbours, smooth=smooth
    )
    expected = np.stack(
        [
            residual_scale.expected(
                own,
                scene.neighbours,
                moving,
                near=options.scale_neighbours,
                window=length,
                least=options.min_scale_sigmas,
            ).astype(np.float32)
            for own, length in zip(strength, lengths, strict=True)
        ]
    )
    clearest = [best(*own, expected[:, :, m], lengths, options=options) for m, own in enumerate(each)]
    score, length, noise = (np.stack(own, axis=1) for own in zip(*clearest, strict=True))
    return Matches(residual, score, length, noise, expected, np.stack([level(own) for own, _ in each], axis=1))


def bar(score: np.ndarray, start: int, stop: int, *, rate: float, options: SlowOptions) -> float:
    """How clear a bump in [start, stop) must be, given the scores (frames,) of its marker, in units of the threshold.

    What the marker does at other times as well is motion.
    """
    elsewhere, reach = score.copy(), frames(options, rate)[-1]
    elsewhere[max(0, start - reach) : stop + reach] = 0
    top = int(elsewhere.argmax())
    elsewhere[max(0, top - reach) : top + reach] = 0
    return float(np.clip(options.distinct_factor * elsewhere.max(), 1, options.obvious_factor))


def briefly_gone(scene: Scene, options: SlowOptions) -> np.ndarray:
    """Bool (frames, markers): True where one of a marker's nearest neighbours is gone, but not for long.

    The others predict otherwise: a bump that is none.
    """
    brief = intervals.samples(options.bridged_gap_s, scene.rate)
    gone = np.zeros(scene.present.shape, bool)
    for m, absent in enumerate(~scene.present.T):
        for start, stop in runs(absent):
            gone[start:stop, m] = stop - start <= brief
    near = [np.asarray(around, int)[: options.attribution_neighbours] for around in scene.neighbours]
    return np.stack([gone[:, around].any(axis=1) for around in near], axis=1)


def level(strength: np.ndarray) -> np.ndarray:
    """Median (lengths,) of what is known of strengths (lengths, frames); 1 where nothing is."""
    return np.array([np.median(known) if len(known) else 1.0 for known in (own[~np.isnan(own)] for own in strength)])


def frames(options: SlowOptions, rate: float) -> list[int]:
    """The lengths of the bumps to look for, in frames: long enough to have a shape."""
    return [max(5, intervals.samples(length, rate)) for length in options.durations_s]


def best(
    strength: np.ndarray,
    deviation: np.ndarray,
    expected: np.ndarray,
    lengths: Sequence[int],
    *,
    options: SlowOptions,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Score, length and expected height (frames,) of the bump that stands out most from that; given (lengths, frames)."""
    score = np.nan_to_num(strength / (options.threshold_sigmas * expected))
    first = score.argmax(axis=0)[None]
    noise = np.take_along_axis(deviation * expected, first, axis=0)[0]
    return np.take_along_axis(score, first, axis=0)[0], np.asarray(lengths)[first[0]], noise
