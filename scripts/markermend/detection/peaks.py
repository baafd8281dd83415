"""Isolated peaks: a marker is elsewhere for a few samples and back again (skurowski2022 3.4.2)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from markermend.core import events
from markermend.core.events import Event
from markermend.detection.neighbour import pulses, residual_windows
from markermend.detection.neighbour.residual_windows import Courses
from markermend.detection.published import coordinatewise
from markermend.detection.published.peaks import find_peaks
from markermend.options.detection import PeaksOptions
from markermend.options.published import PublishedPeaksOptions
from markermend.prediction.scene import ResidualSource, Scene


def detect_peaks(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: PublishedPeaksOptions | PeaksOptions,
    predictor: ResidualSource,
) -> list[Event]:
    """Find the isolated peaks of a recording.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. options: of one of the two detectors. predictor: source of the residuals, used by the
    detector against the neighbours alone.
    """
    rate = scene.rate
    if isinstance(options, PublishedPeaksOptions):
        return coordinatewise.detect(
            scene,
            lambda signal, _: find_peaks(signal, rate=rate, options=options),
            markers=markers,
            earlier=earlier,
            bridge_s=options.slope_window_s,
        )

    maps, length = pulses.of_longest(rate, options)

    def judge(course: Courses, m: int) -> list[Event]:
        found = pulses.find(course, m, rate=rate, options=options)
        return [Event(markers[m], one.start, one.stop, one.score, events.carrying(one.off)) for one in found]

    found, _ = residual_windows.detect(
        scene,
        markers=markers,
        earlier=earlier,
        options=options,
        maps=maps,
        length=length,
        predictor=predictor,
        judge=judge,
    )
    return found
