"""Slow changes: a marker drifts away from where its neighbours say it should be, and comes back (skurowski2022 3.5).

Natural motion leaves residuals as large as the drift. What tells them apart is time (a drift rises and falls within a
second or so, from rest to rest), and what the body is doing: where its pose is novel, or it moves fast, or the neighbours
fit badly as well, more is to be expected.
"""

from __future__ import annotations

from collections.abc import Sequence
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


def judge_slow(matches: Matches, marker: int, *, name: str, rate: float, options: SlowOptions) -> list[Event]:
    """Find the slow changes of one marker: the bumps that stand out, the clearest first, each with room about it.

    A bump that is altogether plain may be the tip of a longer one: it lasts as long as it takes to come to rest.
    """
    score, length, residual = matches.score[:, marker], matches.length[:, marker], matches.residual[:, marker]
    tops = [start + int(score[start:stop].argmax()) for start, stop in runs(score > 1)]
    shortest, found = intervals.samples(options.min_duration_s, rate), list[Event]()
    taken = np.zeros(len(score), bool)
    for top in sorted(tops, key=lambda top: -score[top]):
        plain = score[top] >= options.obvious_factor
        lengths = [n for n in frames(options, rate) if n == length[top] or (plain and n > length[top])]
        spans = [drift_shape.extent(residual, top, n, flank=options.flank_fraction) for n in lengths]
        start, stop = next((span for span in spans if stands_out(residual, *span, options=options)), spans[0])
        if taken[start:stop].any():
            continue
        side = int(options.flank_fraction * (stop - start))
        taken[max(0, start - side) : stop + side] = True
        if (
            stands_out(residual, start, stop, options=options)
            and score[top] >= bar(score, start, stop, rate=rate, options=options)
            and (score[top] >= options.high_scale_factor or matches.noise[top, marker] <= options.high_scale_mm)
            and stop - start >= shortest
        ):
            change = drift_shape.risen(residual, start, stop, flank=options.flank_fraction)
            found.append(Event(name, start, stop, float(score[top]), events.carrying(change[None])))
    return found


def stands_out(residual: np.ndarray, start: int, stop: int, *, options: SlowOptions) -> bool:
    """Whether a residual (frames, 3) rises high enough in [start, stop), from rest to rest."""
    least = max(
        options.floor_mm,
        drift_shape.unrest(residual, start, stop, flank=options.flank_fraction) / options.max_baseline_fraction,
    )
    return drift_shape.height(residual, start, stop, flank=options.flank_fraction) >= least


def detect_slow(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: PublishedSlowOptions | SlowOptions,
    predictor: Any,
) -> list[Event]:
    """Find the slow changes of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. options: of one of the two detectors. predictor: a ResidualSource for the one of single
    coordinates, a LocalRidge for the other, which changes its options.
    """
    if isinstance(options, PublishedSlowOptions):
        return slow.detect(scene, markers=markers, earlier=earlier, options=options, predictor=predictor)
    rest = inputs.without(scene, earlier)
    source = LocalRidge(replace(predictor.options, **options.local_ridge_changes))
    matches = measure(rest, *source.scaled_residuals(rest, blocks=options.leverage_blocks), options=options)
    company = Company(rest, matches, options, source)
    found = []
    for m, name in enumerate(markers):
        for event in judge_slow(matches, m, name=name, rate=rest.rate, options=options):
            if company.upholds(m, event):
                found.append(event)
    return events.tidy(found)
