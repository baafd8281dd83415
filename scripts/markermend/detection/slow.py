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

from markermend.core import events
from markermend.core.events import Event
from markermend.detection import inputs
from markermend.detection.neighbour import drift_shape
from markermend.detection.neighbour.drift_attribution import Company
from markermend.detection.neighbour.drift_candidates import Matches, bar, frames, measure
from markermend.detection.published import slow
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection import SlowOptions
from markermend.options.published import PublishedSlowOptions
from markermend.prediction.local_ridge.predictor import LocalRidge
from markermend.prediction.scene import Scene


def judge_slow(matches: Matches, marker: int, *, name: str, rate: float, settings: SlowOptions) -> list[Event]:
    """Find the slow changes of one marker: the bumps that stand out, the clearest first, each with room about it.

    A bump that is altogether plain may be the tip of a longer one: it lasts as long as it takes to come to rest.
    """
    score, length, residual = matches.score[:, marker], matches.length[:, marker], matches.residual[:, marker]
    tops = [start + int(score[start:stop].argmax()) for start, stop in runs(score > 1)]
    shortest, found = intervals.samples(settings.shortest_s, rate), list[Event]()
    taken = np.zeros(len(score), bool)
    for top in sorted(tops, key=lambda top: -score[top]):
        plain = score[top] >= settings.plain
        lengths = [n for n in frames(settings, rate) if n == length[top] or (plain and n > length[top])]
        spans = [drift_shape.extent(residual, top, n, flank=settings.flank) for n in lengths]
        start, stop = next((span for span in spans if stands_out(residual, *span, settings=settings)), spans[0])
        if taken[start:stop].any():
            continue
        side = int(settings.flank * (stop - start))
        taken[max(0, start - side) : stop + side] = True
        if (
            stands_out(residual, start, stop, settings=settings)
            and score[top] >= bar(score, start, stop, rate=rate, settings=settings)
            and (score[top] >= settings.sure or matches.noise[top, marker] <= settings.noise_mm)
            and stop - start >= shortest
        ):
            change = drift_shape.risen(residual, start, stop, flank=settings.flank)
            found.append(Event(name, start, stop, float(score[top]), events.carrying(change[None])))
    return found


def stands_out(residual: np.ndarray, start: int, stop: int, *, settings: SlowOptions) -> bool:
    """Whether a residual (frames, 3) rises high enough in [start, stop), from rest to rest."""
    least = max(settings.floor_mm, drift_shape.unrest(residual, start, stop, flank=settings.flank) / settings.rest)
    return drift_shape.height(residual, start, stop, flank=settings.flank) >= least


def settings(options: Mapping[str, Any]) -> PublishedSlowOptions | SlowOptions:
    """The settings of the preset that the config section `slow` asks for; raises ValueError for an unknown one."""
    return inputs.preset(options, {"default": SlowOptions, "paper": PublishedSlowOptions})


def detect_slow(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    settings: PublishedSlowOptions | SlowOptions,
    predictor: Any,
) -> list[Event]:
    """Find the slow changes of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. settings: of one of the two detectors. predictor: a ResidualSource for the one of single
    coordinates, a LocalRidge for the other, which changes its settings.
    """
    if isinstance(settings, PublishedSlowOptions):
        return slow.detect(scene, markers=markers, earlier=earlier, settings=settings, predictor=predictor)
    rest = inputs.without(scene, earlier)
    source = LocalRidge(replace(predictor.options, **settings.ridge))
    matches = measure(rest, *source.scaled_residuals(rest, blocks=settings.blocks), settings=settings)
    company = Company(rest, matches, settings, source)
    found = []
    for m, name in enumerate(markers):
        for event in judge_slow(matches, m, name=name, rate=rest.rate, settings=settings):
            if company.upholds(m, event):
                found.append(event)
    return events.tidy(found)
