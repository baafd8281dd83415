"""Heavy noise: a marker jumps from sample to sample for a while (skurowski2022 3.4.3)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from markermend import coordinates, detection, events, robust, sudden
from markermend.blame import ResidualSource
from markermend.events import Event
from markermend.predictors import Scene
from markermend.recording import runs
from markermend.sudden import Changes, SuddenSettings


@dataclass(frozen=True)
class CoordinateNoise:
    """Settings of the detector of one coordinate (config noise.coordinates and noise.paper).

    window_s, order: Savitzky-Golay high-pass of the differences. scale, sigmas, floor_mm: threshold of a change, see
    robust.threshold. shortest_s: shortest stretch. density: share of its samples that exceed the threshold.
    minimum_changes: and how many of them at least. bridge_s: slopes on either side of what
    earlier detectors claimed are taken over this time.
    """

    window_s: float
    order: int
    scale: str
    sigmas: float
    floor_mm: float
    shortest_s: float
    density: float
    minimum_changes: int
    bridge_s: float


def difference_high_pass(signal: np.ndarray, *, window_s: float, order: int, rate: float) -> np.ndarray:
    """Differences less their Savitzky-Golay smooth (skurowski2022 eq 26, 27), over a window that the order allows."""
    window = max(robust.samples(window_s, rate, odd=True), 2 * order + 1)
    return robust.high_pass(robust.difference(signal), window, order)


def find_noise(signal: np.ndarray, *, rate: float, settings: CoordinateNoise) -> tuple[np.ndarray, np.ndarray]:
    """Find the stretches of heavy noise of one coordinate (skurowski2022 eq 26-30).

    signal: (frames,), mm, NaN = missing; nothing is found across a gap. Returns a mask and a score, (frames,). A stretch
    goes from its first to its last sample that is far from what stands before it: the filter's smear does not count.
    """
    shortest = robust.samples(settings.shortest_s, rate)
    element = 2 * shortest - 1
    change = difference_high_pass(signal, window_s=settings.window_s, order=settings.order, rate=rate)
    level = robust.threshold(change, scale=settings.scale, sigmas=settings.sigmas, floor_mm=settings.floor_mm)
    closed = robust.closing(np.abs(change), element)
    raw = np.where(np.isnan(closed), np.nan, closed > level)
    areas = robust.closing(raw, element) > 0
    plain = robust.difference(signal)
    jump = np.abs(plain - robust.moving_median(plain, element)) > level
    mask, score = np.zeros(len(signal), bool), np.zeros(len(signal))
    for start, stop in runs(areas):
        own = start + np.flatnonzero(jump[start:stop])
        if own.size < settings.minimum_changes:
            continue
        span = slice(own[0], own[-1])
        if own[-1] - own[0] >= shortest and own.size >= settings.density * (own[-1] - own[0]):
            mask[span] = True
            score[span] = np.abs(change[own]).max() / max(level, 1e-9)
    return mask, score


@dataclass(frozen=True)
class NeighbourNoise(SuddenSettings):
    """Settings of the detector against the neighbours (config noise.default), beside those of sudden changes.

    link_s: sudden changes so near belong together. shortest_s: shortest stretch. density: share of its samples that
    change suddenly. minimum_changes: and how many of them at least.
    """

    link_s: float
    shortest_s: float
    density: float
    minimum_changes: int


def judge_noise(changes: Changes, marker: int, *, name: str, rate: float, settings: NeighbourNoise) -> list[Event]:
    """Find the stretches of heavy noise of one marker among its sudden changes."""
    score, vector = changes.score[:, marker], changes.vector[:, marker]
    shortest, link = robust.samples(settings.shortest_s, rate), robust.samples(settings.link_s, rate)
    found = []
    for start, stop in runs(~np.isnan(changes.residual[:, marker, 0])):
        for group in sudden.clusters(start + np.flatnonzero(score[start:stop] > 1), link):
            length = int(group[-1] - group[0])
            enough = max(settings.minimum_changes, settings.density * length)
            if length >= shortest and len(group) >= enough:
                best = float(score[group].max())
                # Next to a gap the noise has no closing edge: a remainder as quiet as it is amid the noise goes with it.
                quiet = int(np.diff(group).max())
                first = start if group[0] - start <= quiet else int(group[0])
                last = stop if stop - group[-1] <= quiet else int(group[-1])
                found.append(Event(name, first, last, best, events.carrying(vector[group])))
    return found


def settings(options: Mapping[str, Any]) -> CoordinateNoise | NeighbourNoise:
    """The settings of the preset that the config section `noise` asks for; raises ValueError for an unknown one."""
    kinds = {"default": NeighbourNoise, "coordinates": CoordinateNoise, "paper": CoordinateNoise}
    return detection.preset(options, kinds)


def detect_noise(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    settings: CoordinateNoise | NeighbourNoise,
    predictor: ResidualSource,
) -> list[Event]:
    """Find the stretches of heavy noise of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. settings: of one of the two detectors. predictor: source of the residuals, used by the
    detector against the neighbours alone.
    """
    rate = scene.rate
    if isinstance(settings, CoordinateNoise):
        return coordinates.detect(
            scene,
            lambda signal, _: find_noise(signal, rate=rate, settings=settings),
            markers=markers,
            earlier=earlier,
            bridge_s=settings.bridge_s,
        )
    found, _ = sudden.detect(
        scene,
        markers=markers,
        earlier=earlier,
        settings=settings,
        predictor=predictor,
        judge=lambda changes, m: judge_noise(changes, m, name=markers[m], rate=rate, settings=settings),
    )
    return found
