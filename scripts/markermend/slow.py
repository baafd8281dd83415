"""Slow changes: a marker drifts away from where its neighbours say it should be, and comes back (skurowski2022 3.5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy import ndimage

from markermend import detection, events, hills, robust
from markermend.blame import ResidualSource
from markermend.events import Event
from markermend.hills import CoordinateSlow, regrow
from markermend.predictors import Scene
from markermend.recording import runs


@dataclass(frozen=True)
class NeighbourSlow:
    """Settings of the detector on all coordinates together (config slow.default).

    smooth_s: of the moving median that clears the residual of what is not slow. baseline_s: of the one that follows
    lasting misfit, which is not counted. activity_s, activity_ratio, activity_neighbours: the usual level follows the
    marker's own over this time, but not beyond this ratio to its nearest neighbours'; see sudden.SuddenSettings.
    company_neighbours: where the body as a whole fits badly, so many neighbours tell. sigmas: upper threshold in units
    of the usual level. floor_mm: and at least so much. lower: lower threshold, as a part of the upper one. top_s: shortest stretch
    beyond the upper threshold. shortest_s, longest_s: of the stretch beyond the lower one. rivals, suspect: those of so many
    neighbours that are off by this part of the marker's own level are left out in turn to confirm it.
    """

    smooth_s: float
    baseline_s: float
    activity_s: float
    activity_ratio: float
    activity_neighbours: int
    company_neighbours: int
    sigmas: float
    floor_mm: float
    lower: float
    top_s: float
    shortest_s: float
    longest_s: float
    rivals: int
    suspect: float


@dataclass(frozen=True)
class Levels:
    """How far off each marker is.

    vector: (frames, markers, 3), mm, residual less what is not slow and what lasts; NaN = missing. score: (frames,
    markers), its size in units of the threshold.
    """

    vector: np.ndarray
    score: np.ndarray


def measure(
    scene: Scene,
    residual: np.ndarray,
    only: Sequence[int] | None = None,
    was: Levels | None = None,
    *,
    settings: NeighbourSlow,
) -> Levels:
    """Measure how far off the markers of a scene are from their residuals; with `was`, anew for the markers `only`."""
    smooth = robust.samples(settings.smooth_s, scene.rate, odd=True)
    baseline = robust.samples(settings.baseline_s, scene.rate, odd=True)
    vector = np.full(residual.shape, np.nan) if was is None else was.vector.copy()
    for m in range(residual.shape[1]) if only is None else only:
        vector[:, m] = np.nan
        for start, stop in runs(~np.isnan(residual[:, m, 0])):
            vector[start:stop, m] = ndimage.median_filter(residual[start:stop, m], (smooth, 1), mode="nearest")
        for axis in range(3):
            vector[:, m, axis] -= robust.moving_median_across(residual[:, m, axis], baseline)
    size = np.linalg.norm(vector, axis=2)
    usual = robust.usual_size(
        size,
        scene.neighbours,
        window=robust.samples(settings.activity_s, scene.rate, odd=True),
        near=settings.activity_neighbours,
        ratio=settings.activity_ratio,
    )
    together = np.maximum(usual, company(size, scene.neighbours, near=settings.company_neighbours))
    return Levels(vector, size / np.maximum(settings.sigmas * together, settings.floor_mm))


def company(size: np.ndarray, neighbours: Sequence[np.ndarray], *, near: int) -> np.ndarray:
    """What a marker's level would be if it were as unusual as its nearest neighbours are at that moment, mm.

    size: (frames, markers), mm, NaN = missing. The median of the neighbours, each in units of its own median level.
    """
    middle = np.array([np.median(own[~np.isnan(own)]) if (~np.isnan(own)).any() else 1.0 for own in size.T])
    unusual = np.nan_to_num(size / np.maximum(middle, 1e-3))
    out = np.zeros(size.shape)
    for m, around in enumerate(neighbours):
        if len(around):
            out[:, m] = np.median(unusual[:, np.asarray(around, int)[:near]], axis=1) * middle[m]
    return out


def judge_slow(levels: Levels, marker: int, *, name: str, rate: float, settings: NeighbourSlow) -> list[Event]:
    """Find the slow changes of one marker: they begin and end near rest, so not at the end of a valid run."""
    score, vector = levels.score[:, marker], levels.vector[:, marker]
    top = robust.samples(settings.top_s, rate)
    shortest, longest = robust.samples(settings.shortest_s, rate), robust.samples(settings.longest_s, rate)
    seen = np.concatenate([[False], ~np.isnan(score), [False]])
    found = []
    for start, stop in regrow(score, lower=settings.lower, top=top):
        if shortest <= stop - start <= longest and seen[start] and seen[stop + 1]:
            axes = events.carrying(vector[start:stop])
            found.append(Event(name, start, stop, float(score[start:stop].max()), axes))
    return found


def same_company(scene: Scene, event: Event, *, marker: int, settings: NeighbourSlow) -> bool:
    """Whether each of the nearest neighbours is seen all the while, or never, from just before an event to just after it.

    A prediction from other neighbours is off by other amounts: where they come and go, the level says nothing. What is
    briefer than the top of a finding does not count: it makes no slow change.
    """
    margin = robust.samples(settings.shortest_s, scene.rate)
    around = slice(max(event.start - margin, 0), event.stop + margin)
    near = np.asarray(scene.neighbours[marker], int)[: settings.rivals]
    seen, brief = scene.present[around, near], robust.samples(settings.top_s, scene.rate)
    count = np.count_nonzero(seen, axis=0)
    return bool(((count >= len(seen) - brief) | (count <= brief)).all())


def confirmed(
    scene: Scene, event: Event, levels: Levels, *, marker: int, settings: NeighbourSlow, predictor: ResidualSource
) -> bool:
    """Whether a marker is still off without any one of the neighbours that are off as well, and may have dragged it along.

    A steady marker shows a neighbour's drift more clearly, in units of its own level, than that neighbour does.
    """
    during = slice(event.start, event.stop)
    size = np.nan_to_num(np.linalg.norm(levels.vector[during], axis=2)).max(axis=0)
    near = np.asarray(scene.neighbours[marker], int)[: settings.rivals]
    suspects = near[size[near] > settings.suspect * size[marker]]
    for suspect in suspects:
        hidden = scene.positions.copy()
        hidden[:, suspect] = np.nan  # throughout: a looser prediction needs its own scale
        without = replace(scene, positions=hidden)
        residual = np.full(levels.vector.shape, np.nan)
        residual[:, marker] = predictor.residuals(without, np.array([marker]))[:, marker]
        again = measure(without, residual, [marker], levels, settings=settings)
        left = judge_slow(again, marker, name=event.marker, rate=scene.rate, settings=settings)
        if not any(other.start < event.stop and event.start < other.stop for other in left):
            return False
    return True


def settings(options: Mapping[str, Any]) -> CoordinateSlow | NeighbourSlow:
    """The settings of the preset that the config section `slow` asks for; raises ValueError for an unknown one."""
    return detection.preset(options, {"default": NeighbourSlow, "paper": CoordinateSlow})


def detect_slow(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    settings: CoordinateSlow | NeighbourSlow,
    predictor: ResidualSource,
) -> list[Event]:
    """Find the slow changes of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. settings: of one of the two detectors. predictor: source of the residuals, for either.
    """
    if isinstance(settings, CoordinateSlow):
        return hills.detect(scene, markers=markers, earlier=earlier, settings=settings, predictor=predictor)
    rest = detection.without(scene, earlier)
    levels = measure(rest, predictor.residuals(rest), settings=settings)
    found = [
        event
        for m, name in enumerate(markers)
        for event in judge_slow(levels, m, name=name, rate=scene.rate, settings=settings)
    ]
    place = {name: m for m, name in enumerate(markers)}
    return events.tidy(
        event
        for event in found
        if same_company(rest, event, marker=place[event.marker], settings=settings)
        and confirmed(rest, event, levels, marker=place[event.marker], settings=settings, predictor=predictor)
    )
