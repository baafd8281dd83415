"""Faults of the capture system: frames that all markers repeat, jumps of all markers at once, slips of whole segments.

Each is one finding about several markers: one event for each of them, with a common group.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from markermend.core.events import Event, main_axes
from markermend.detection import inputs
from markermend.detection.system.repeated_frames import RepeatedFrames
from markermend.detection.system.scene_jumps import DisplacedStretch, find_displaced_stretches
from markermend.detection.system.segment_slips import SegmentSlip, find_segment_slips
from markermend.options.detection.frames import FramesOptions
from markermend.prediction.scene import Scene

ALL = "all markers"
"""The group of findings about all markers."""


def detect_frames(
    scene: Scene, *, markers: Sequence[str], earlier: np.ndarray, options: FramesOptions, predictor: Any = None
) -> tuple[list[Event], list[str]]:
    """Find the faults of the capture system in a recording.

    Parameters
    ----------
    scene : Scene
        What is observed.
    markers : Sequence[str]
        Names of the markers.
    earlier : np.ndarray
        What earlier detectors claimed, bool, like the positions.
    options : FramesOptions
        Thresholds of repeated frames, jumps and slips.
    predictor : optional
        Not used: the motion of many markers at once is compared with itself.

    Returns
    -------
    found : list[Event]
        Sorted; those of one finding have the same kind and group.
    warnings : list[str]
        One sentence where frames are repeated regularly or often, which is no fault of single frames.
    """
    scene = inputs.without_claimed(scene, earlier)
    repeated = RepeatedFrames(scene.positions, scene.rate, options.repeats)
    if repeated.warning is not None:
        return [], [repeated.warning]
    found = [
        Event(markers[m], start, stop, 1.0, kind="repeat", group=ALL)
        for start, stop in repeated.spans
        for m in repeated.members(start, stop)
    ]
    scene = _without(scene, found, markers)
    stretches = find_displaced_stretches(scene.positions, scene.rate, options.jumps)
    found += [event for stretch in stretches for event in _displaced(stretch, scene, markers)]
    scene = _without(scene, [event for event in found if event.kind == "jump"], markers)
    found += [event for slip in find_segment_slips(scene, options.slips) for event in _slipped(slip, markers)]
    return sorted(found, key=lambda event: event.order), []


def _displaced(stretch: DisplacedStretch, scene: Scene, markers: Sequence[str]) -> list[Event]:
    """The events of a stretch over which all markers are displaced."""
    kind = "jump" if stretch.returns else "shift"
    axes = main_axes(stretch.displacement.after[None] - stretch.displacement.before)
    return [
        Event(
            markers[m], stretch.start, stretch.stop, stretch.score, axes, None, kind, ALL, round(stretch.amount_mm, 3)
        )
        for m in np.flatnonzero(scene.present[stretch.start : stretch.stop].any(axis=0)).tolist()
    ]


def _slipped(slip: SegmentSlip, markers: Sequence[str]) -> list[Event]:
    """The events of a slip."""
    axes = main_axes(slip.displacements)
    amount = round(float(np.median(np.linalg.norm(slip.displacements, axis=1))), 3)
    return [
        Event(markers[m], slip.start, slip.stop, slip.score, axes, None, "slip", slip.segment, amount)
        for m in slip.markers.tolist()
    ]


def _without(scene: Scene, found: Iterable[Event], markers: Sequence[str]) -> Scene:
    """The scene without the samples of findings."""
    index = {marker: m for m, marker in enumerate(markers)}
    claimed = np.zeros(scene.positions.shape, bool)
    for event in found:
        claimed[event.start : event.stop, index[event.marker]] = True
    return inputs.without_claimed(scene, claimed)
