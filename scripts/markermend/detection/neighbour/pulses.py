"""Pulses: for a few samples a marker leaves the smooth trajectory that leads from before to after them (additive outliers)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from markermend.detection.neighbour import residual_windows
from markermend.detection.neighbour.level_evidence import LevelEvidence
from markermend.detection.neighbour.pulse_filters import innovation_map, misfit_of_change, pulse_filters
from markermend.detection.neighbour.residual_windows import Exceedances, ResidualStatistics, WindowFilters
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.numerics.window_covariance import WindowCovariance
from markermend.options.detection.peaks import PeaksOptions

MIN_CONTEXT = 6
"""Samples of context on either side, at least: they estimate the noise scale."""


@dataclass(frozen=True)
class Pulse:
    """Outlying samples of a marker.

    Attributes
    ----------
    start, stop : int
        The samples, [start, stop).
    score : float
        Amplitude in units of the threshold.
    deviation : np.ndarray
        Their distance from what the other samples predict (stop - start, 3), mm.
    """

    start: int
    stop: int
    score: float
    deviation: np.ndarray


def find_pulses(
    statistics: ResidualStatistics,
    marker: int,
    dip_covariance: WindowCovariance,
    evidence: LevelEvidence,
    *,
    options: PeaksOptions,
) -> list[Pulse]:
    """Find the pulses of one marker, peaks and dips; none has a stronger one within the context by which that is judged.

    Parameters
    ----------
    statistics : ResidualStatistics
        Statistics of the residuals.
    marker : int
        Index of the marker.
    dip_covariance : WindowCovariance
        Covariance of windows as long as those of the longest dip.
    evidence : LevelEvidence
        What the level of the marker says of dips.
    options : PeaksOptions
        Longest pulse, threshold, context, and attribution.

    Returns
    -------
    list[Pulse]
        The pulses, the strongest first.
    """
    rate = evidence.scene.rate
    context = residual_windows.context_samples(rate, options, min_samples=MIN_CONTEXT)
    short = intervals.samples(options.max_duration_s, rate)
    candidates: list[Pulse] = []
    for start, stop in runs(~np.isnan(statistics.local_scale[:, marker])):
        for length in pulse_lengths(rate, options):
            if length > stop - start - 2 * context:
                break
            peak = length <= short
            covariance = statistics.covariance if peak else dip_covariance
            reach, least = (0, 1.0) if peak else (options.dip_ramp_frames, min(_dip_factors(options)))
            size = length + 2 * context
            # Near a gap or an end of the recording a dip cannot be distinguished from motion.
            spans = residual_windows.window_spans(start, stop, size, context)[: None if peak else 1]
            for span, offsets in spans:
                inside = tuple(offset for offset in offsets if offset + length <= size)
                filters = pulse_filters(covariance, length, size, inside)
                over = residual_windows.exceedances(statistics, marker, span, filters, options, fraction=least)
                found = _pulses(over, filters, (length, reach), covariance, options)
                candidates += found if peak else _dips(found, evidence, context, options)
    kept: list[Pulse] = []
    for candidate in sorted(candidates, key=lambda c: (-c.score, c.stop - c.start, c.start)):
        if all(candidate.stop + context <= one.start or one.stop + context <= candidate.start for one in kept):
            kept.append(candidate)
    return kept


def pulse_lengths(rate: float, options: PeaksOptions) -> list[int]:
    """List the lengths at which pulses are looked for: each of those of peaks, and those of dips, which grow by a factor.

    Parameters
    ----------
    rate : float
        Sampling rate, Hz.
    options : PeaksOptions
        Longest peak, longest dip, and the factor.

    Returns
    -------
    list[int]
        Samples, in order.
    """
    short, longest = (
        intervals.samples(seconds, rate) for seconds in (options.max_duration_s, options.max_dip_duration_s)
    )
    lengths = list(range(1, short + 1))
    while lengths[-1] < longest:
        lengths.append(min(longest, max(lengths[-1] + 1, int(lengths[-1] * options.dip_length_ratio))))
    return lengths


def _dips(found: Iterable[Pulse], evidence: LevelEvidence, context: int, options: PeaksOptions) -> Iterator[Pulse]:
    """The pulses that are above the threshold of dips, which depends on what residual and usual distances say of their level.

    A pulse that is no longer than a peak is one, or nothing: peaks have filters of their own. A pulse beside which the marker is displaced
    as well, by half of that evidence or more, is part of a step.
    """
    longest_peak = intervals.samples(options.max_duration_s, evidence.scene.rate)
    for pulse in (one for one in found if one.stop - one.start > longest_peak):
        displacement = pulse.deviation.mean(axis=0)
        residual, shape = evidence.log_ratios(displacement, np.arange(pulse.start, pulse.stop))
        likely, usual, unlikely = _dip_factors(options)
        factor = unlikely if shape < 0 else usual
        if min(residual, shape) >= options.min_dip_log_ratio:
            factor = likely
        last = min(pulse.stop + context, len(evidence.residual))
        beside = np.arange(max(pulse.start - context, 0), pulse.start), np.arange(pulse.stop, last)
        most = max(residual + shape, 0.0) / 2
        if pulse.score > factor and all(evidence.log_ratio(displacement, frames) <= most for frames in beside):
            yield replace(pulse, score=pulse.score / factor)


def _dip_factors(options: PeaksOptions) -> tuple[float, float, float]:
    """Thresholds of likely, other, and unlikely dips, in units of that of a peak."""
    return options.likely_dip_threshold_factor, options.dip_threshold_factor, options.unlikely_dip_threshold_factor


def _pulses(
    over: Exceedances,
    filters: WindowFilters,
    extent: tuple[int, int],
    covariance: WindowCovariance,
    options: PeaksOptions,
) -> Iterator[Pulse]:
    """The pulses of some windows, each trimmed to its outlying samples, without those that a change of level or velocity explains.

    extent: samples of the pattern, and how many on either side of it may belong to the pulse as well.
    """
    fraction = options.dip_extent_fraction if extent[1] else options.extent_fraction
    for i, frame in enumerate(over.frame.tolist()):
        centre = int(filters.offsets[over.filter[i]])
        offset = max(0, centre - extent[1])
        length = min(filters.length, centre + sum(extent)) - offset
        first = frame - centre + offset
        innovation = innovation_map(covariance, length, filters.length, offset)
        deviation = innovation @ over.residual[i].T
        own = residual_windows.recorded_part(innovation @ over.positions[i].T, deviation)
        largest = np.linalg.norm(deviation, axis=1) if extent[1] else own
        inside = np.flatnonzero(own >= fraction * largest.max())
        if not len(inside):  # The deviation is a neighbour's.
            continue
        low, high = int(inside[0]), int(inside[-1]) + 1
        # Up to the very border of a gap a level shift and a pulse are the same.
        enclosed = offset + low > 0 and offset + high < filters.length
        ratios = (options.max_shift_ratio, options.max_kink_ratio) if enclosed else ()
        left = (misfit_of_change(over.residual[i], covariance, order=order) for order in range(len(ratios)))
        if any(misfit <= ratio * over.misfit[i] for misfit, ratio in zip(left, ratios, strict=True)):
            continue
        yield Pulse(first + low, first + high, float(over.score[i]), deviation[low:high])
