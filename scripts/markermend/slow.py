"""Slow changes: a marker drifts away from where its neighbours say it should be, and comes back (skurowski2022 3.5).

Natural motion leaves residuals as large as the drift. What tells them apart is time (a drift rises and falls within a
second or so, from rest to rest), and what the body is doing: where its pose is novel, or it moves fast, or the neighbours
fit badly as well, more is to be expected.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from markermend import bumps, detection, events, hills, robust
from markermend.events import Event
from markermend.hills import CoordinateSlow
from markermend.predictors import Scene
from markermend.recording import runs
from markermend.slow_matches import Matches, NeighbourSlow, ScaledResidualSource, measure


def judge_slow(matches: Matches, marker: int, *, name: str, rate: float, settings: NeighbourSlow) -> list[Event]:
    """Find the slow changes of one marker: the bumps that stand out, the clearest first, each with room about it."""
    score, length, residual = matches.score[:, marker], matches.length[:, marker], matches.residual[:, marker]
    tops = [start + int(score[start:stop].argmax()) for start, stop in runs(score > 1)]
    shortest, found = robust.samples(settings.shortest_s, rate), list[Event]()
    taken = np.zeros(len(score), bool)
    for top in sorted(tops, key=lambda top: -score[top]):
        start, stop = bumps.extent(residual, top, int(length[top]), flank=settings.flank)
        if taken[start:stop].any():
            continue
        side = int(settings.flank * (stop - start))
        taken[max(0, start - side) : stop + side] = True
        change = bumps.risen(residual, start, stop, flank=settings.flank)
        least = max(settings.floor_mm, bumps.unrest(residual, start, stop, flank=settings.flank) / settings.rest)
        if (
            matches.noise[top, marker] <= settings.noise_mm
            and stop - start >= shortest
            and np.linalg.norm(change) >= least
        ):
            found.append(Event(name, start, stop, float(score[top]), events.carrying(change[None])))
    return found


def same_company(scene: Scene, event: Event, *, marker: int, settings: NeighbourSlow) -> bool:
    """Whether each of the nearest neighbours is seen all the while, or never, from before an event to after it.

    A prediction from other neighbours is off by other amounts: where they come and go, the level says nothing. What is
    brief does not count: it makes no slow change.
    """
    margin = int(settings.flank * (event.stop - event.start))
    around = slice(max(event.start - margin, 0), event.stop + margin)
    near = np.asarray(scene.neighbours[marker], int)[: settings.rivals]
    seen, brief = scene.present[around, near], robust.samples(settings.brief_s, scene.rate)
    count = np.count_nonzero(seen, axis=0)
    return bool(((count >= len(seen) - brief) | (count <= brief)).all())


def to_blame(
    scene: Scene,
    event: Event,
    matches: Matches,
    *,
    marker: int,
    settings: NeighbourSlow,
    predictor: ScaledResidualSource,
) -> bool:
    """Whether a finding is the marker's own, and not that of a neighbour that is off as well and dragged it along.

    Of each neighbour that may have done so: the marker is still off without it; or, as on a rigid segment, where nothing
    tells without either, the marker is further off than that neighbour, in mm, which is not off without the marker. In
    mm, because a steady marker shows a neighbour's drift more clearly, in units of its own level, than that neighbour does.
    """
    near = np.asarray(scene.neighbours[marker], int)[: settings.rivals]
    own, *heights = (
        bumps.height(matches.residual[:, m], event.start, event.stop, flank=settings.flank) for m in (marker, *near)
    )
    suspects = np.nan_to_num(heights) > settings.suspect * own
    suspects |= matches.score[event.start : event.stop, near].max(axis=0, initial=0.0) > 1

    def off(one: int, without: int) -> bool:
        """Whether a bump stands out during the event on one marker in the scene without another."""
        hidden = scene.positions.copy()
        hidden[:, without] = np.nan  # throughout: a looser prediction needs its own scale
        rest = replace(scene, positions=hidden)
        residual, wider = predictor.scaled_residuals(rest, np.array([one]), blocks=settings.blocks)
        score = matches.judge_anew(residual[:, one], wider[:, one], one, rate=scene.rate, settings=settings)
        return bool(score[event.start : event.stop].max() > settings.kept)

    return all(
        off(marker, suspect) or (own >= np.nan_to_num(height) and not off(suspect, marker))
        for suspect, height in zip(near[suspects], np.array(heights)[suspects], strict=True)
    )


def settings(options: Mapping[str, Any]) -> CoordinateSlow | NeighbourSlow:
    """The settings of the preset that the config section `slow` asks for; raises ValueError for an unknown one."""
    return detection.preset(options, {"default": NeighbourSlow, "paper": CoordinateSlow})


def detect_slow(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    settings: CoordinateSlow | NeighbourSlow,
    predictor: Any,
) -> list[Event]:
    """Find the slow changes of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. settings: of one of the two detectors. predictor: a ResidualSource for the one of single
    coordinates, a ScaledResidualSource for the other.
    """
    if isinstance(settings, CoordinateSlow):
        return hills.detect(scene, markers=markers, earlier=earlier, settings=settings, predictor=predictor)
    rest = detection.without(scene, earlier)
    matches = measure(rest, *predictor.scaled_residuals(rest, blocks=settings.blocks), settings=settings)
    found = []
    for m, name in enumerate(markers):
        for event in judge_slow(matches, m, name=name, rate=rest.rate, settings=settings):
            if same_company(rest, event, marker=m, settings=settings) and to_blame(
                rest, event, matches, marker=m, settings=settings, predictor=predictor
            ):
                found.append(event)
    return events.tidy(found)
