"""Isolated peaks: a marker is elsewhere for a few samples and back again (skurowski2022 3.4.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend import detection, events, robust, sudden
from markermend.blame import ResidualSource
from markermend.events import Event
from markermend.predictors import Scene
from markermend.recording import runs
from markermend.sudden import Changes, SuddenSettings


@dataclass(frozen=True)
class CoordinatePeaks:
    """Settings of the detector of one coordinate (config peaks.coordinates and peaks.paper).

    trend: `median_of_difference` subtracts the moving median from the differences, `difference_of_median` takes
    differences after subtracting it from the signal (the paper's order, which leaks trend). window_s: of that median.
    longest_s: longest peak. margin_s: sums and morphology reach over
    twice the longest peak and this. scale, sigmas, floor_mm: threshold of a sudden change, see robust.threshold. balance: the
    changes of a peak sum to less than one in so many of their absolute sum. bridge_s: slopes on either side of what
    earlier detectors claimed are taken over this time.
    """

    trend: str
    window_s: float
    longest_s: float
    margin_s: float
    scale: str
    sigmas: float
    floor_mm: float
    balance: float
    bridge_s: float


def without_trend(signal: np.ndarray, *, trend: str, window: int) -> np.ndarray:
    """Differences without the slow trend (skurowski2022 eq 18, 19): either order of median and difference."""
    if trend == "median_of_difference":
        change = robust.difference(signal)
        return change - robust.moving_median(change, window)
    if trend == "difference_of_median":
        return robust.difference(signal - robust.moving_median(signal, window))
    raise ValueError(f"trend {trend!r} is neither median_of_difference nor difference_of_median")


def find_peaks(signal: np.ndarray, *, rate: float, settings: CoordinatePeaks) -> tuple[np.ndarray, np.ndarray]:
    """Find the isolated peaks of one coordinate (skurowski2022 eq 18-25).

    signal: (frames,), mm, NaN = missing; nothing is found across a gap. Returns a mask and a score, (frames,).
    """
    longest = robust.samples(settings.longest_s, rate)
    window = robust.samples(2 * settings.longest_s + settings.margin_s, rate, odd=True)
    change = without_trend(signal, trend=settings.trend, window=robust.samples(settings.window_s, rate, odd=True))
    level = robust.threshold(change, scale=settings.scale, sigmas=settings.sigmas, floor_mm=settings.floor_mm)
    kept = np.where(np.abs(change) > level, change, 0.0)
    kept[np.isnan(change)] = np.nan
    total, absolute = robust.moving_sum(kept, window), robust.moving_sum(np.abs(kept), window)
    candidate = ((absolute > 0) & (absolute > settings.balance * np.abs(total))).astype(float)
    candidate[np.isnan(change)] = np.nan
    isolated = robust.top_hat(robust.closing(candidate, window), window) > 0
    mask, score = np.zeros(len(signal), bool), np.zeros(len(signal))
    for start, stop in runs(isolated):
        low = max(0, start - window // 2)
        own = low + np.flatnonzero(np.nan_to_num(kept[low : stop + window // 2]))
        opposite = own[kept[own] * kept[own[0]] < 0] if own.size else own
        if opposite.size and opposite[-1] == own[-1] and own[-1] - own[0] <= longest:
            mask[own[0] : own[-1]] = True
            score[own[0] : own[-1]] = np.abs(kept[own]).max() / max(level, 1e-9)
    return mask, score


@dataclass(frozen=True)
class NeighbourPeaks(SuddenSettings):
    """Settings of the detector against the neighbours (config peaks.default), beside those of sudden changes.

    longest_s: longest peak. isolation_s: no other sudden change so near. weak: changes above this part of the threshold
    belong to a peak too. remainder: the changes of a peak sum to at most this part of their absolute sum. border_score:
    beside a gap, or the end of the recording, one change is enough if it is so many times above the threshold.
    """

    longest_s: float
    isolation_s: float
    weak: float
    remainder: float
    border_score: float


def judge_peaks(changes: Changes, marker: int, *, name: str, rate: float, settings: NeighbourPeaks) -> list[Event]:
    """Find the isolated peaks of one marker among its sudden changes; next to a gap, one change may be all there is."""
    score, vector = changes.score[:, marker], changes.vector[:, marker]
    longest, apart = robust.samples(settings.longest_s, rate), robust.samples(settings.isolation_s, rate)
    strong = np.flatnonzero(score > 1)
    found = []
    for start, stop in runs(~np.isnan(changes.residual[:, marker, 0])):
        weak = start + np.flatnonzero(score[start:stop] > settings.weak)
        for group in sudden.clusters(weak, longest):
            first, last = int(group[0]), int(group[-1])
            best = float(score[group].max())
            lonely = np.searchsorted(strong, last + apart, side="right") - np.searchsorted(strong, first - apart)
            if best <= 1 or lonely > (score[group] > 1).sum() or last - first > longest:
                continue
            rest = np.linalg.norm(vector[group].sum(axis=0)) / np.linalg.norm(vector[group], axis=1).sum()
            if rest > settings.remainder:
                if first - start > longest and stop - last > longest:
                    continue
                first, last = (start, last) if first - start <= stop - last else (first, stop)
                if last - first > longest or best < settings.border_score:
                    continue
            found.append(Event(name, first, last, best, events.carrying(vector[group])))
    return found


def settings(options: Mapping[str, Any]) -> CoordinatePeaks | NeighbourPeaks:
    """The settings of the preset that the config section `peaks` asks for; raises ValueError for an unknown one."""
    kinds = {"default": NeighbourPeaks, "coordinates": CoordinatePeaks, "paper": CoordinatePeaks}
    return detection.preset(options, kinds)


def detect_peaks(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    settings: CoordinatePeaks | NeighbourPeaks,
    predictor: ResidualSource,
) -> list[Event]:
    """Find the isolated peaks of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. settings: of one of the two detectors. predictor: source of the residuals, used by the
    detector against the neighbours alone.
    """
    found, _ = sudden.detect(
        scene,
        markers=markers,
        earlier=earlier,
        settings=settings,
        predictor=predictor,
        in_coordinate=lambda signal, _, own: find_peaks(signal, rate=scene.rate, settings=own),
        judge=judge_peaks,
    )
    return found
