"""Heavy noise: a marker jumps from sample to sample for a while (skurowski2022 3.4.3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour import increments as neighbour_increments
from markermend.detection.neighbour.increments import Changes
from markermend.detection.published import coordinatewise
from markermend.detection.published.noise import find_noise
from markermend.numerics import intervals
from markermend.numerics.intervals import runs
from markermend.options.detection import NoiseOptions
from markermend.options.published import PublishedNoiseOptions
from markermend.prediction.scene import ResidualSource, Scene


def judge_noise(changes: Changes, marker: int, *, name: str, rate: float, options: NoiseOptions) -> list[Event]:
    """Find the stretches of heavy noise of one marker among its sudden changes."""
    score, vector = changes.score[:, marker], changes.vector[:, marker]
    shortest, link = intervals.samples(options.min_duration_s, rate), intervals.samples(options.link_s, rate)
    found = []
    for start, stop in runs(~np.isnan(changes.residual[:, marker, 0])):
        for group in neighbour_increments.clusters(start + np.flatnonzero(score[start:stop] > 1), link):
            length = int(group[-1] - group[0])
            enough = max(options.min_sudden_changes, options.min_sudden_share * length)
            if length >= shortest and len(group) >= enough:
                best = float(score[group].max())
                # Next to a gap the noise has no closing edge: a remainder as quiet as it is amid the noise goes with it.
                quiet = int(np.diff(group).max())
                first = start if group[0] - start <= quiet else int(group[0])
                last = stop if stop - group[-1] <= quiet else int(group[-1])
                found.append(Event(name, first, last, best, events.carrying(vector[group])))
    return found


def detect_noise(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: PublishedNoiseOptions | NoiseOptions,
    predictor: ResidualSource,
) -> list[Event]:
    """Find the stretches of heavy noise of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. options: of one of the two detectors. predictor: source of the residuals, used by the
    detector against the neighbours alone.
    """
    rate = scene.rate
    if isinstance(options, PublishedNoiseOptions):
        return coordinatewise.detect(
            scene,
            lambda signal, _: find_noise(signal, rate=rate, options=options),
            markers=markers,
            earlier=earlier,
            bridge_s=options.slope_window_s,
        )
    found, _ = neighbour_increments.detect(
        scene,
        markers=markers,
        earlier=earlier,
        options=options,
        predictor=predictor,
        judge=lambda changes, m: judge_noise(changes, m, name=markers[m], rate=rate, options=options),
    )
    return found
