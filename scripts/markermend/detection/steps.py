"""Steps: a marker jumps elsewhere, stays, and jumps back (skurowski2022 3.4.4)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from markermend.core import events
from markermend.core.events import Event, OpenStep
from markermend.detection.neighbour import edges, residual_windows
from markermend.detection.neighbour.level_shifts import cut_short, judge_steps
from markermend.detection.neighbour.residual_windows import Courses
from markermend.detection.published.steps import _detect_in_coordinates
from markermend.options.detection import StepsOptions
from markermend.options.published import PublishedStepsOptions
from markermend.prediction.scene import ResidualSource, Scene


def open_steps(
    course: Courses, found: Sequence[Event], *, markers: Sequence[str], rate: float, options: StepsOptions
) -> list[OpenStep]:
    """List the jumps that no event begins or ends with, by marker and frame."""
    used = {(event.marker, frame) for event in found for frame in range(event.start, event.stop + 1)}
    return [
        OpenStep(marker, edge.frame, float(np.linalg.norm(edge.jump)))
        for m, marker in enumerate(markers)
        for edge in edges.find(course, m, rate=rate, options=options)
        if (marker, edge.frame) not in used
    ]


def detect_steps(
    scene: Scene,
    *,
    markers: Sequence[str],
    earlier: np.ndarray,
    options: PublishedStepsOptions | StepsOptions,
    predictor: ResidualSource,
) -> tuple[list[Event], list[OpenStep]]:
    """Find the steps of a recording, and the jumps that remain without a counterpart.

    scene: positions (frames, markers, 3), mm, NaN = missing; nothing is found there. earlier: bool, like positions, what
    detectors before claimed. options: of one of the two detectors. predictor: source of the residuals, used by the
    detector against the neighbours alone.
    """
    if isinstance(options, PublishedStepsOptions):
        return _detect_in_coordinates(scene, markers=markers, earlier=earlier, options=options)
    rate = scene.rate
    maps, length = edges.central(rate, options)
    missing = ~scene.present
    clear = replace(
        options, single_jump_fraction=1.0
    )  # weak jumps are no ground to suspect several markers: motion makes many

    def judge(course: Courses, m: int, by: StepsOptions) -> list[Event]:
        return judge_steps(course, m, missing=missing, name=markers[m], rate=rate, options=by)

    found, course = residual_windows.detect(
        scene,
        markers=markers,
        earlier=earlier,
        options=options,
        maps=maps,
        length=length,
        predictor=predictor,
        judge=partial(judge, by=options),
        suspect=partial(judge, by=clear),
        open_at=lambda course, m: [edge.frame for edge in edges.find(course, m, rate=rate, options=options)],
    )
    # A jump may be lost to sight in a gap, or in what was claimed earlier: noise on a step often reaches to its end.
    unseen = missing | earlier.any(axis=2)
    for m, name in enumerate(markers):
        cut = cut_short(course, m, found, missing=unseen[:, m], name=name, rate=rate, options=options)
        found = events.tidy([*found, *cut])
    return found, open_steps(course, found, markers=markers, rate=rate, options=options)
