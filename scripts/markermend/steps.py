"""Steps: a marker jumps elsewhere, stays, and jumps back (skurowski2022 3.4.4)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from markermend import coordinates, courses, detection, edges, events, robust
from markermend.blame import ResidualSource
from markermend.courses import Courses
from markermend.events import Event
from markermend.levels import NeighbourSteps, cut_short, judge_steps
from markermend.noise import difference_high_pass
from markermend.predictors import Scene


@dataclass(frozen=True)
class OpenStep:
    """A jump without a counterpart: the frame that it leads to, and its size in mm."""

    marker: str
    frame: int
    size_mm: float


@dataclass(frozen=True)
class CoordinateSteps:
    """Settings of the detector of one coordinate (config steps.coordinates and steps.paper).

    window_s, order: Savitzky-Golay high-pass of the differences. scale, sigmas, floor_mm: threshold of a change, see
    robust.threshold. shortest_s, longest_s: how far apart the two jumps are. ratio: neither jump is less than this part
    of the other. bridge_s: slopes on either side of what
    earlier detectors claimed are taken over this time.
    """

    window_s: float
    order: int
    scale: str
    sigmas: float
    floor_mm: float
    shortest_s: float
    longest_s: float
    ratio: float
    bridge_s: float


def find_steps(
    signal: np.ndarray, *, rate: float, settings: CoordinateSteps
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Find the steps of one coordinate (skurowski2022 3.4.4): intervals between opposite jumps.

    signal: (frames,), mm, NaN = missing; nothing is found across a gap. Returns a mask, a score, both (frames,), and the
    frames of jumps without a counterpart (open steps).
    """
    change = difference_high_pass(signal, window_s=settings.window_s, order=settings.order, rate=rate)
    level = robust.threshold(change, scale=settings.scale, sigmas=settings.sigmas, floor_mm=settings.floor_mm)
    window = max(robust.samples(settings.window_s, rate, odd=True), 2 * settings.order + 1)
    at = robust.edges(change, level, window // 2)
    pairs, alone = robust.derivative_pairs(
        change,
        at,
        shortest=robust.samples(settings.shortest_s, rate),
        longest=robust.samples(settings.longest_s, rate),
        ratio=settings.ratio,
    )
    mask, score = np.zeros(len(signal), bool), np.zeros(len(signal))
    for start, stop in pairs:
        mask[start:stop] = True
        score[start:stop] = min(abs(change[start]), abs(change[stop])) / max(level, 1e-9)
    return mask, score, alone


def open_steps(
    course: Courses, found: Sequence[Event], *, markers: Sequence[str], rate: float, settings: NeighbourSteps
) -> list[OpenStep]:
    """List the jumps that no event begins or ends with, by marker and frame."""
    used = {(event.marker, frame) for event in found for frame in range(event.start, event.stop + 1)}
    return [
        OpenStep(marker, edge.frame, float(np.linalg.norm(edge.jump)))
        for m, marker in enumerate(markers)
        for edge in edges.find(course, m, rate=rate, settings=settings)
        if (marker, edge.frame) not in used
    ]


def settings(options: Mapping[str, Any]) -> CoordinateSteps | NeighbourSteps:
    """The settings of the preset that the config section `steps` asks for; raises ValueError for an unknown one."""
    kinds = {"default": NeighbourSteps, "coordinates": CoordinateSteps, "paper": CoordinateSteps}
    return detection.preset(options, kinds)


def detect_steps(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    settings: CoordinateSteps | NeighbourSteps,
    predictor: ResidualSource,
) -> tuple[list[Event], list[OpenStep]]:
    """Find the steps of a recording, and the jumps that remain without a counterpart.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. settings: of one of the two detectors. predictor: source of the residuals, used by the
    detector against the neighbours alone.
    """
    if isinstance(settings, CoordinateSteps):
        return _detect_in_coordinates(scene, markers=markers, earlier=earlier, settings=settings)
    rate = scene.rate
    maps, length = edges.central(rate, settings)
    missing = ~scene.present
    clear = replace(settings, weak=1.0)  # weak jumps are no ground to suspect several markers: motion makes many

    def judge(course: Courses, m: int, by: NeighbourSteps) -> list[Event]:
        return judge_steps(course, m, missing=missing, name=markers[m], rate=rate, settings=by)

    found, course = courses.detect(
        scene,
        markers=markers,
        earlier=earlier,
        settings=settings,
        maps=maps,
        length=length,
        predictor=predictor,
        judge=partial(judge, by=settings),
        suspect=partial(judge, by=clear),
        open_at=lambda course, m: [edge.frame for edge in edges.find(course, m, rate=rate, settings=settings)],
    )
    # A jump may be lost to sight in a gap, or in what was claimed earlier: noise on a step often reaches to its end.
    unseen = missing | earlier.any(axis=2)
    for m, name in enumerate(markers):
        cut = cut_short(course, m, found, missing=unseen[:, m], name=name, rate=rate, settings=settings)
        found = events.tidy([*found, *cut])
    return found, open_steps(course, found, markers=markers, rate=rate, settings=settings)


def _detect_in_coordinates(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, settings: CoordinateSteps
) -> tuple[list[Event], list[OpenStep]]:
    """See detect_steps: coordinate by coordinate."""
    alone: dict[tuple[str, int], float] = {}

    def find(signal: np.ndarray, marker: str) -> tuple[np.ndarray, np.ndarray]:
        mask, score, left = find_steps(signal, rate=scene.rate, settings=settings)
        change = robust.difference(signal)
        change -= robust.moving_median(change, robust.samples(settings.window_s, scene.rate, odd=True))
        for frame in left.tolist():
            alone[marker, frame] = float(np.hypot(alone.get((marker, frame), 0.0), change[frame]))
        return mask, score

    found = coordinates.detect(scene, find, markers=markers, earlier=earlier, bridge_s=settings.bridge_s)
    within = events.mask(found, len(scene.positions), markers)
    return found, [OpenStep(*at, size) for at, size in sorted(alone.items()) if not within[at[1], markers.index(at[0])]]
